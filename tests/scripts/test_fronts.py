"""The files of scripts/ are fronts of commands, and run.sh runs them by their names."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

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


@pytest.mark.parametrize("arguments", [[], ["guess"], ["../tests/conftest"]])
def test_run_sh_names_the_programs_there_are(arguments: list[str]) -> None:
    done = subprocess.run(["sh", SCRIPTS / "run.sh", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert all(f" {front.stem}" in done.stderr for front in FRONTS)
