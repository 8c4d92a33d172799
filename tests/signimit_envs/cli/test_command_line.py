"""Bad input ends a program with one sentence and code 2."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from signimit.exceptions import InvalidInputError
from signimit_envs.cli.command_line import PIPE_CLOSED, run_program

pytest.importorskip("tyro")


def complaint(program: Callable[..., None], capsys: pytest.CaptureFixture[str]) -> str:
    with pytest.raises(SystemExit) as stop:
        run_program(program)
    assert stop.value.code == 2
    said: str = capsys.readouterr().err
    return said


@pytest.fixture(autouse=True)
def no_arguments(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["/somewhere/name.py"])


def test_a_refusal_is_told_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    def program() -> None:
        raise InvalidInputError("seed", "zero or more", "-1")

    assert complaint(program, capsys) == "name: seed: expected zero or more, found -1.\n"


def test_a_missing_file_is_named(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    def program() -> None:
        (tmp_path / "none").read_bytes()

    assert complaint(program, capsys) == f"name: {tmp_path / 'none'}: No such file or directory.\n"


def test_a_missing_package_comes_with_the_line_that_installs_it(capsys: pytest.CaptureFixture[str]) -> None:
    def program() -> None:
        raise ModuleNotFoundError("no", name="tqdm")

    assert "pip install 'signimit[scripts]'" in complaint(program, capsys)


def test_a_bug_is_not_taken_for_bad_input() -> None:
    def program() -> None:
        raise ModuleNotFoundError("no", name="signimit.nonsense")

    with pytest.raises(ModuleNotFoundError):
        run_program(program)


def test_the_signature_gives_the_options(monkeypatch: pytest.MonkeyPatch) -> None:
    got = []

    def program(word: str = "a", number: int = 1) -> None:
        got.append((word, number))

    monkeypatch.setattr(sys, "argv", ["name.py", "--number", "3"])
    run_program(program)
    assert got == [("a", 3)]


def test_the_help_does_not_repeat_the_arguments(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def program(word: str = "a") -> None:
        """Say a word.

        Args:
            word: What to say.
        """

    monkeypatch.setattr(sys, "argv", ["name.py", "--help"])
    with pytest.raises(SystemExit):
        run_program(program)
    said = capsys.readouterr().out
    assert "Say a word." in said
    assert "What to say." in said
    assert "Args:" not in said


def test_a_reader_who_has_seen_enough_ends_a_program_quietly() -> None:
    body = "def main() -> None:\n    print('x' * 2**20)\n"
    script = f"from signimit_envs.cli.command_line import run_program\n{body}run_program(main)"
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
        assert program.stdout is not None
        assert program.stderr is not None
        program.stdout.close()
        assert program.stderr.read() == b""
    assert program.returncode == PIPE_CLOSED


def test_a_program_that_is_terminated_removes_its_drafts(tmp_path: Path) -> None:
    body = "def main() -> None:\n    with whole_files('out'):\n        os.kill(os.getpid(), signal.SIGTERM)\n"
    ours = "from signimit_envs.cli.command_line import run_program\nfrom signimit.io.safe_files import whole_files\n"
    script = f"import os, signal\n{ours}{body}run_program(main)"
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=False)
    assert done.returncode == 128 + signal.SIGTERM
    assert list(tmp_path.iterdir()) == []
