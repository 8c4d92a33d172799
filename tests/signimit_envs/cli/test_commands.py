"""The commands: one module each, named and summarised in one place."""

from __future__ import annotations

import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import signimit_envs.cli
from signimit_envs.cli import COMMANDS, main

pytest.importorskip("tyro", reason="commands need signimit[scripts]")


def test_every_module_is_a_command() -> None:
    folder = Path(signimit_envs.cli.__file__).parent
    modules = {file.stem.replace("_", "-") for file in folder.glob("*.py")}
    assert set(COMMANDS) == modules - {
        "--init--",
        "command-line",
        "result-tables",
        "study-judge",
        "study-paper",
        "study-policies",
    }


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_a_help_for_each_of_its_options(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    module = importlib.import_module(f"signimit_envs.cli.{name.replace('-', '_')}")
    for subcommand in getattr(module, "SUBCOMMANDS", [None]):
        with pytest.raises(SystemExit) as stop:
            main([name, *([subcommand] if subcommand else []), "--help"])
        assert stop.value.code == 0
        said = capsys.readouterr().out
        assert said.startswith(f"usage: signimit {name} {subcommand or ''}".rstrip())
        functions = getattr(module, "SUBCOMMANDS", {None: getattr(module, "main", None)})
        options = functions[subcommand].__annotations__.keys() - {"return"}
        documented = functions[subcommand].__doc__.partition("Args:")[2]
        assert all(f"{option}: " in documented for option in options), (options, documented)


def test_without_a_command_all_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    main(["--help"])
    listed = capsys.readouterr().out
    assert all(f"  {name} " in listed for name in COMMANDS)
    with pytest.raises(SystemExit) as stop:
        main([])
    assert stop.value.code == 2
    assert capsys.readouterr().err == listed


def test_an_unknown_command_gets_the_known_ones(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["obey"])
    assert stop.value.code == 2
    assert capsys.readouterr().err.startswith("obey: Unknown command 'obey'; known are reproduce, ")


def test_the_package_is_a_program() -> None:
    done = subprocess.run([sys.executable, "-m", "signimit", "--help"], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "python -m signimit COMMAND" in done.stdout
    assert done.stderr == ""


def test_an_extra_is_missed_only_by_the_commands_that_need_it() -> None:
    """Only the module of `study` needs more than tyro and tqdm to be imported; the others import what they use."""
    extras = ("sklearn", "matplotlib", "fastapi", "uvicorn", "websockets", "stable_baselines3", "distributed")
    script = (
        f"import importlib, sys; sys.modules.update(dict.fromkeys({extras}))\n"
        "import signimit_envs.cli as cli\n"
        "for name in set(cli.COMMANDS) - {'study'}:\n"
        "    importlib.import_module('signimit_envs.cli.' + name.replace('-', '_'))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
