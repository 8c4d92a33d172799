"""What all commands share: options from a function's signature, one sentence for bad input, and exit codes."""

from __future__ import annotations

import errno
import inspect
import os
import shlex
import signal
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from types import FrameType
from typing import Annotated, Any, Union

from signimit.exceptions import InvalidInputError, MissingDependencyError, SignimitError

BAD_INPUT = 2
PIPE_CLOSED = 141  # what a shell reports of a program that SIGPIPE ended
INTERRUPTED = 130  # and of one that SIGINT ended
_SCRIPT_PACKAGES = ("matplotlib", "tqdm", "tyro")
_EXTRAS = {"studio": "studio", "study": "study", "train": "scripts,rl"}  # with these packages, and more that is needed
_running: ContextVar[tuple[str, ...]] = ContextVar("_running", default=())


def command_text() -> str:
    """Return the command that runs, as one would type it, for files that say how they were made."""
    return shlex.join(["python", "-m", "signimit", *_running.get()])


@contextmanager
def exit_codes(name: str, argv: Sequence[str]) -> Iterator[None]:
    """End the process with the code that says why, if a command cannot be carried out.

    Input that cannot be used ends it with code 2 and one sentence on the error stream, without a traceback. SIGTERM
    leaves by way of every ``finally``, so that drafts of files are removed.

    Args:
        name: The command; its complaints begin with it.
        argv: Its arguments; `command_text` repeats them.
    """
    signal.signal(signal.SIGTERM, _exit_on_signal)
    token = _running.set((name, *argv))
    try:
        try:
            yield
        finally:  # also where tyro has printed a help and leaves
            sys.stdout.flush()
    except BrokenPipeError:  # the reader of the output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or Python complains when it flushes at exit
        sys.exit(PIPE_CLOSED)
    except (SignimitError, OSError, ModuleNotFoundError) as error:
        sys.stderr.write(f"{name}: {error_sentence(error, _EXTRAS.get(name, 'scripts'))}\n")
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.stderr.write("\nstopped\n")
        sys.exit(INTERRUPTED)
    finally:
        _running.reset(token)


def check_output_file(path: Path, *suffixes: str) -> None:
    """Refuse early what could not be written in the end.

    Args:
        path: A file to be written.
        suffixes: How its name may end, in any case.

    Raises:
        InvalidInputError: If it ends otherwise.
        OSError: If it is a folder, or is to be in a folder that is missing or not writable.
    """
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if path.suffix.lower() not in suffixes:
        raise InvalidInputError(str(path), f"a name that ends in {' or '.join(suffixes)}", f"{path.suffix!r}")
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path.parent))
    check_output_folder(path.parent)


def check_output_folder(folder: Path) -> None:
    """Refuse early a folder into which nothing could be written in the end.

    Raises:
        InvalidInputError: If it, or what is to hold it, is a file.
        OSError: If it is not writable.
    """
    near = next(place for place in (folder, *folder.absolute().parents) if place.exists())
    if not near.is_dir():
        raise InvalidInputError(str(near), "a folder, or nothing yet", "a file")
    if not os.access(near, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(near))


Command = Callable[..., None] | Mapping[str, "Command"]
"""A function, whose signature gives the options and whose docstring the help, or one for each subcommand."""


def call_with_options(command: Command, argv: Sequence[str], program: str) -> None:
    """Parse arguments into those of a function, and call it.

    Args:
        command: The function, or one for each subcommand.
        argv: Arguments as they were typed.
        program: What the help calls the program.
    """
    if callable(command) and not argv and not inspect.signature(command).parameters:
        command()  # without tyro: it may be what `doctor` has to report as missing
        return
    import tyro

    config = (tyro.conf.OmitArgPrefixes,)  # of a group of options only the options are typed
    tyro.cli(_parsed_as(command), args=argv, prog=program, config=config)


def _parsed_as(command: Command) -> Any:
    """Return what tyro parses into a call of a command: of several the one that is named."""
    import tyro

    if callable(command):
        return command
    choices: list[Any] = []
    for name, inner in command.items():
        if callable(inner):
            choices.append(Annotated[Any, tyro.conf.subcommand(name, constructor=inner)])
        else:
            choices.append(Annotated[_parsed_as(inner), tyro.conf.subcommand(name)])
    one_of: Any = Union
    return one_of[*choices, Annotated[None, tyro.conf.Suppress]]  # a union of one would not be a choice


def _exit_on_signal(number: int, frame: FrameType | None) -> None:
    sys.exit(128 + number)


def error_sentence(error: Exception, extra: str = "scripts") -> str:
    """Say in one sentence what was wrong; a missing package that is not ours to name is a bug, not bad input.

    Args:
        error: What was raised.
        extra: The extra that installs what every command needs.
    """
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}." if error.filename else f"{error.strerror}."
    if isinstance(error, ModuleNotFoundError) and not isinstance(error, SignimitError):
        package = (error.name or "").partition(".")[0]
        if package not in _SCRIPT_PACKAGES:
            raise error
        return str(MissingDependencyError(package, extra, "This program"))
    return str(error)
