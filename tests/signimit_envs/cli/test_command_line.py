"""What cannot be carried out ends a command with one sentence and a code; options come from signatures."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from signimit.exceptions import InvalidInputError
from signimit_envs.cli.command_line import (
    INTERRUPTED,
    PIPE_CLOSED,
    call_with_options,
    check_output_file,
    check_output_folder,
    command_text,
    exit_codes,
)

pytest.importorskip("tyro", reason="commands need signimit[scripts]")


def complaint(command: Callable[[], None], capsys: pytest.CaptureFixture[str]) -> str:
    with pytest.raises(SystemExit) as stop, exit_codes("name", []):
        command()
    assert stop.value.code == 2
    said: str = capsys.readouterr().err
    return said


def test_a_refusal_is_told_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    def command() -> None:
        raise InvalidInputError("seed", "zero or more", "-1")

    assert complaint(command, capsys) == "name: seed: expected zero or more, found -1.\n"


def test_a_missing_file_is_named(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    def command() -> None:
        (tmp_path / "none").read_bytes()

    assert complaint(command, capsys) == f"name: {tmp_path / 'none'}: No such file or directory.\n"


@pytest.mark.parametrize("module", ["tqdm", "matplotlib.figure"])
def test_a_missing_package_comes_with_the_line_that_installs_it(
    module: str, capsys: pytest.CaptureFixture[str]
) -> None:
    def command() -> None:
        raise ModuleNotFoundError("no", name=module)

    package, hint = module.partition(".")[0], shlex.join([sys.executable, "-m", "pip", "install", "signimit[scripts]"])
    assert complaint(command, capsys) == f"name: This program needs {package}: {hint}.\n"


def test_the_line_that_installs_names_all_that_the_command_needs(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit), exit_codes("studio", []):
        raise ModuleNotFoundError("no", name="tyro")
    assert "pip install 'signimit[studio]'" in capsys.readouterr().err


def test_a_bug_is_not_taken_for_bad_input() -> None:
    with pytest.raises(ModuleNotFoundError), exit_codes("name", []):
        raise ModuleNotFoundError("no", name="signimit.nonsense")


def test_the_signature_gives_the_options() -> None:
    got = []

    def command(word: str = "a", number: int = 1) -> None:
        got.append((word, number))

    call_with_options(command, ["--number", "3"], "name")
    assert got == [("a", 3)]


def test_options_belong_to_their_subcommand(capsys: pytest.CaptureFixture[str]) -> None:
    got = []

    def first(word: str = "a") -> None:
        got.append(word)

    def second(number: int = 1) -> None:
        got.append(str(number))

    commands: dict[str, Callable[..., None]] = {"one": first, "two": second}
    call_with_options(commands, ["two", "--number", "3"], "name")
    assert got == ["3"]
    with pytest.raises(SystemExit) as stop:
        call_with_options(commands, ["one", "--number", "3"], "name")
    assert stop.value.code == 2
    assert "--number" in capsys.readouterr().err


def test_a_command_without_options_does_not_need_tyro(monkeypatch: pytest.MonkeyPatch) -> None:
    got = []
    monkeypatch.setitem(sys.modules, "tyro", None)
    call_with_options(lambda: got.append("called"), [], "name")
    assert got == ["called"]


def test_the_help_does_not_repeat_the_arguments(capsys: pytest.CaptureFixture[str]) -> None:
    def command(word: str = "a") -> None:
        """Say a word.

        Args:
            word: What to say.
        """

    with pytest.raises(SystemExit):
        call_with_options(command, ["--help"], "name")
    said = capsys.readouterr().out
    assert "Say a word." in said
    assert "What to say." in said
    assert "Args:" not in said


def test_files_can_say_by_which_command_they_were_made() -> None:
    with exit_codes("learn", ["my file.npz", "--seed", "3"]):
        assert command_text() == "python -m signimit learn 'my file.npz' --seed 3"


def test_a_reader_who_has_seen_enough_ends_a_command_quietly() -> None:
    ours = "from signimit_envs.cli.command_line import exit_codes\n"
    script = f"{ours}with exit_codes('name', []):\n    print('x' * 2**20)\n"
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
        assert program.stdout is not None
        assert program.stderr is not None
        program.stdout.close()
        assert program.stderr.read() == b""
    assert program.returncode == PIPE_CLOSED


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["learn", "--help"], ["doctor"]])
def test_whatever_is_printed_may_be_cut_off(arguments: list[str]) -> None:
    command = [sys.executable, "-m", "signimit", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
        assert program.stdout is not None
        assert program.stderr is not None
        program.stdout.close()
        assert program.stderr.read() == b""
    assert program.returncode == PIPE_CLOSED


def test_an_interrupt_ends_a_command_in_one_word(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop, exit_codes("name", []):
        raise KeyboardInterrupt
    assert stop.value.code == INTERRUPTED
    assert capsys.readouterr().err == "\nstopped\n"


def test_an_interrupt_of_imports_does_too() -> None:
    """Where Python would tell which module it was in, or take it for a broken installation."""
    script = (
        "import os, signal, sys\n"
        "class Finder:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'mujoco':\n"
        "            os.kill(os.getpid(), signal.SIGINT)\n"
        "from signimit.__main__ import main\n"
        "sys.meta_path.insert(0, Finder())\n"
        "main(['doctor'])\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (INTERRUPTED, "", "\nstopped\n")


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("out.txt", "out.txt: expected a name that ends in .npz or .mp4, found '.txt'."),
        ("out", "out: expected a name that ends in .npz or .mp4, found ''."),
        ("folder", "Is a directory"),
        ("none/out.npz", "none"),
        ("file/out.npz", "No such file or directory"),
    ],
)
def test_a_file_that_could_not_be_written_is_refused_before_the_work(
    path: str, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    Path("file").touch()
    with pytest.raises((InvalidInputError, OSError), match=re.escape(sentence)):
        check_output_file(Path(path), ".npz", ".mp4")
    check_output_file(Path("Out.NPZ"), ".npz", ".mp4")


def test_a_folder_that_could_not_be_made_is_refused_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    for place in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(InvalidInputError, match="file: expected a folder, or nothing yet, found a file"):
            check_output_folder(place)
    check_output_folder(tmp_path / "new" / "below")
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write everywhere
    with pytest.raises(PermissionError, match=re.escape(str(tmp_path))):
        check_output_folder(tmp_path / "new" / "below")


def test_a_command_that_is_terminated_removes_its_drafts(tmp_path: Path) -> None:
    ours = "from signimit_envs.cli.command_line import exit_codes\nfrom signimit.io.safe_files import whole_files\n"
    body = "with exit_codes('name', []), whole_files('out'):\n    os.kill(os.getpid(), signal.SIGTERM)\n"
    done = subprocess.run([sys.executable, "-c", f"import os, signal\n{ours}{body}"], cwd=tmp_path, check=False)
    assert done.returncode == 128 + signal.SIGTERM
    assert list(tmp_path.iterdir()) == []
