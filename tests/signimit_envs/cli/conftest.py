"""Commands that run in the tests' own process, and what two of them make."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from signimit_envs.cli import main


class Commands:
    """Runs commands in this process."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys

    def __call__(self, *argv: object) -> str:
        """Run a command to its end and return what it said, on both streams."""
        main(list(map(str, argv)))
        return "".join(self._capsys.readouterr())

    def refusal(self, *argv: object) -> str:
        """Run a command that must end with code 2, and return its complaint, one line."""
        _, said = self._end(2, argv)
        assert said.count("\n") == 1
        return said

    def incomplete(self, *argv: object) -> str:
        """Run a command that must end with code 3, having left something out, and return what it printed."""
        return self._end(3, argv)[0]

    def _end(self, code: int, argv: Sequence[object]) -> tuple[str, str]:
        with pytest.raises(SystemExit) as stop:
            self(*argv)
        assert stop.value.code == code
        out, err = self._capsys.readouterr()
        return out, err


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Commands:
    return Commands(capsys)


@pytest.fixture(scope="session")
def demonstrations(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder that ``make-demonstrations`` wrote; tests only read it."""
    folder = tmp_path_factory.mktemp("demonstrations")
    main(["make-demonstrations", "--out", str(folder)])
    return folder


@pytest.fixture(scope="session")
def model(demonstrations: Path) -> Path:
    """Return the model that ``learn`` wrote from these demonstrations."""
    file = demonstrations / "model.npz"
    prototypes = str(demonstrations / "prototypes.npz")
    main(["learn", str(demonstrations / "demonstrations.npz"), "--prototypes", prototypes, "--out", str(file)])
    return file
