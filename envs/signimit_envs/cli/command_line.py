"""What all command-line programs share: arguments from a function's signature, and one sentence for bad input."""

from __future__ import annotations

import inspect
import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType

from signimit.exceptions import MissingDependencyError, SignimitError

BAD_INPUT = 2
PIPE_CLOSED = 141  # what a shell reports of a program that SIGPIPE ended
_SCRIPT_PACKAGES = ("matplotlib", "tqdm", "tyro")


def run_program(program: Callable[..., None]) -> None:
    """Parse the command line into the arguments of a function, call it, and end the process.

    Input that cannot be used ends it with code 2 and one sentence on the error stream, without a traceback.

    Args:
        program: Its signature gives the options, its docstring the help.
    """
    signal.signal(signal.SIGTERM, _stop)
    try:
        import tyro

        help_text = (inspect.getdoc(program) or "").partition("\nArgs:")[0]  # tyro puts these beside the options
        tyro.cli(program, description=help_text.strip())
        sys.stdout.flush()
    except BrokenPipeError:  # whoever read the output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or Python complains when it flushes at exit
        sys.exit(PIPE_CLOSED)
    except (SignimitError, OSError, ModuleNotFoundError) as error:
        sys.stderr.write(f"{Path(sys.argv[0]).stem}: {_sentence(error)}\n")
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.stderr.write("\nstopped\n")
        sys.exit(130)


def _stop(number: int, frame: FrameType | None) -> None:
    """Leave by way of every ``finally``, so that drafts of files are removed."""
    sys.exit(128 + number)


def _sentence(error: Exception) -> str:
    """Say in one sentence what was wrong; a missing package that is not ours to name is a bug, not bad input."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}." if error.filename else f"{error.strerror}."
    if isinstance(error, ModuleNotFoundError) and not isinstance(error, SignimitError):
        if error.name not in _SCRIPT_PACKAGES:
            raise error
        return str(MissingDependencyError(error.name, "scripts", "This program"))
    return str(error)
