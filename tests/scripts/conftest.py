"""Programs run in the tests' own process."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / "scripts"


class Programs:
    """Runs programs in this process."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
        self._monkeypatch, self._capsys = monkeypatch, capsys

    def __call__(self, name: str, *arguments: object) -> str:
        """Run a program to its end and return what it said, on both streams."""
        self._monkeypatch.setattr(sys, "argv", [str(SCRIPTS / f"{name}.py"), *map(str, arguments)])
        runpy.run_path(str(SCRIPTS / f"{name}.py"), run_name="__main__")
        return "".join(self._capsys.readouterr())

    def refusal(self, name: str, *arguments: object) -> str:
        """Run a program that must end with code 2, and return its complaint, one line."""
        with pytest.raises(SystemExit) as stop:
            self(name, *arguments)
        assert stop.value.code == 2
        said: str = self._capsys.readouterr().err
        assert said.count("\n") == 1
        return said


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Programs:
    return Programs(monkeypatch, capsys)
