"""The files of scripts/ are fronts of commands, and run.sh runs them by their names."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import signimit_envs.cli
from signimit_envs.cli import COMMANDS

SCRIPTS = Path(__file__).parents[2] / "scripts"
if not SCRIPTS.is_dir():
    pytest.skip("the scripts are not beside these tests", allow_module_level=True)
pytest.importorskip("tyro", reason="commands need tyro")
FRONTS = sorted(SCRIPTS.glob("*.py"))


def test_every_command_has_a_front_of_its_name() -> None:
    commands = {command.replace("-", "_") for command in COMMANDS}
    assert {front.stem for front in FRONTS} == commands | {"readme"}
    for front in FRONTS:
        found = re.findall(r'main\(\["([a-z-]+)"', front.read_text(encoding="utf-8"))
        assert found == ["results" if front.stem == "readme" else front.stem.replace("_", "-")]


def test_a_front_hands_its_arguments_over() -> None:
    done = subprocess.run(
        [sys.executable, SCRIPTS / "learn.py", "none.npz"], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (2, "", "learn: none.npz: No such file or directory.\n")


@pytest.fixture
def fresh_clone(tmp_path: Path) -> Path:
    """A copy of what run.sh may look at before anything is installed."""
    shutil.copytree(SCRIPTS, tmp_path / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
    commands = Path(signimit_envs.cli.__file__).parent
    shutil.copytree(commands, tmp_path / "envs" / "signimit_envs" / "cli", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "beginning"),
    [
        (["--help"], "Runs a program of this repository"),
        (["test", "-h"], "Runs a program of this repository"),
        (["study", "cells", "--help"], "usage: signimit study cells [options]\n"),
        (["make_demonstrations", "--noise", "1", "-h"], "usage: signimit make-demonstrations [options]\n"),
        (["readme", "--help"], "usage: signimit results readme [options]\n"),
        (["doctor", "-h"], "usage: signimit doctor\n"),
    ],
)
def test_in_a_fresh_clone_the_help_is_told_and_nothing_is_installed(
    arguments: list[str], beginning: str, fresh_clone: Path
) -> None:
    before = sorted(fresh_clone.rglob("*"))
    command = ["sh", str(fresh_clone / "scripts" / "run.sh"), *arguments]
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith(beginning)
    assert sorted(fresh_clone.rglob("*")) == before


@pytest.mark.parametrize("arguments", [[], ["guess"], ["../tests/conftest"]])
def test_run_sh_names_the_programs_there_are(arguments: list[str]) -> None:
    done = subprocess.run(["sh", SCRIPTS / "run.sh", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert all(f" {front.stem}" in done.stderr for front in FRONTS)
