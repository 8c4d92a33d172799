"""The command line: ``signimit COMMAND``, or ``python -m signimit COMMAND``; one module a command.

A module has a function ``main``, or ``SUBCOMMANDS``, functions by name. The signature of a function gives its options
and its docstring the help. Only the module of the command that was asked for is imported, so that an extra is missed
only where it is needed; a shell's completion alone needs them all.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Sequence

import signimit
from signimit.exceptions import UnknownNameError
from signimit_envs.cli.command_line import BAD_INPUT, call_with_options, exit_codes
from signimit_envs.cli.plain_help import plain_help

COMMANDS = {
    "reproduce": "the paper's experiment: watch, learn, and obey 36 commands with a simulated arm",
    "studio": "draw signs and movements in a browser, and watch the arm answer",
    "make-demonstrations": "demonstrations of synthetic or imported people, as input for learn",
    "import-strokes": "strokes of real people from UNIPEN, $1 or InkML files into one library",
    "learn": "demonstrations to a model",
    "render": "a model and signs to a video",
    "record": "a model obeys; every physics state is kept",
    "replay": "recorded episodes again, compared bit for bit, or from another camera",
    "convert": "demonstrations or recordings from one format to another",
    "sessions": "many sessions on the physics, each failing stage named",
    "benchmark": "the benchmark: run entries, make the leaderboard",
    "study": "learners and policies against their baselines",
    "train": "PPO of stable-baselines3 on the environments",
    "timing": "how long things take here, beside the plainest way: core, env, throughput, growth, studio",
    "soak": "millions of random and hostile control steps: are the environments sound, do they grow",
    "results": "the folder of results, measured anew, and the tables of README and docs",
    "fuzz": "faults on purpose: broken files, killed writers, full disks, hostile requests; nothing may be lost",
    "doctor": "what works on this machine, and the line that mends the rest",
}
_HELP = {"-h", "--help"}
_COMPLETION = {"--tyro-print-completion", "--tyro-write-completion"}


def main(argv: Sequence[str] | None = None) -> None:
    """Run a command; a process that cannot carry it out ends with a code other than 0.

    Args:
        argv: The command and its arguments; left out, those of the process.
    """
    name, *arguments = list(sys.argv[1:] if argv is None else argv) or [""]
    if name in (*_HELP, "--version"):
        with exit_codes("signimit", [name]):
            print(f"signimit {signimit.__version__}" if name == "--version" else _overview())
    elif name in _COMPLETION:
        with exit_codes("signimit", [name, *arguments]):
            call_with_options({command: _load(command) for command in COMMANDS}, [name, *arguments], "signimit")
    elif not name:
        sys.stderr.write(f"{_overview()}\n")
        sys.exit(BAD_INPUT)
    else:
        run_command(name.replace("_", "-"), arguments)


def run_command(name: str, arguments: Sequence[str]) -> None:
    """Import the module of a command, and call its function."""
    with exit_codes(name, arguments):
        if name not in COMMANDS:
            raise UnknownNameError("command", name, COMMANDS)
        try:
            command = _load(name)
            if _HELP & set(arguments):
                importlib.import_module("tyro")
        except ImportError:
            if not _HELP & set(arguments):
                raise
            print(plain_help(name, arguments), end="")  # what a command needs is not needed to say what it does
            return
        call_with_options(command, arguments, f"signimit {name}")


def _load(name: str) -> Callable[..., None] | dict[str, Callable[..., None]]:
    """Import the module of a command, and return its function, or its subcommands by name."""
    module = importlib.import_module(f"signimit_envs.cli.{name.replace('-', '_')}")
    found: Callable[..., None] | dict[str, Callable[..., None]] = getattr(module, "SUBCOMMANDS", None) or module.main
    return found


def _overview() -> str:
    commands = "\n".join(f"  {name:20s} {what}" for name, what in COMMANDS.items())
    usage = "usage: signimit COMMAND [options], or python -m signimit COMMAND [options]; COMMAND --help says more"
    completion = "signimit --tyro-print-completion bash (or zsh, fish, tcsh) prints what completes commands in a shell"
    return f"{usage}\n\n{commands}\n\n{completion}"
