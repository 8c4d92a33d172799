"""Writers without room or rights: a full disk and a folder that is not theirs; one sentence, and nothing half."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

from signimit.exceptions import SignimitError
from signimit_envs.cli.command_line import error_sentence
from signimit_envs.robustness.killing import WRITERS
from signimit_envs.robustness.processes import PROCESSES

DISK = 2**22  # bytes of the small disk
LEFT = (0.0, 0.5)  # of what the first version takes, the room that is left for the second
MOST_VERSIONS = 5000  # that a writer of short lines may find room for
LARGEST_FILE = 64  # bytes, where no disk can be mounted
NOBODY = 65534  # user id of "nobody"


class Trial(NamedTuple):
    """A write that cannot succeed.

    Attributes:
        what: Why it cannot.
        good: Whether it failed in one sentence, and what was there before is there, and nothing else.
        said: The sentence, or what went wrong.
    """

    what: str
    good: bool
    said: str


def try_without_room(name: str) -> Iterator[Trial]:
    """Let a writer of `WRITERS` write further versions until it cannot; its first was saved before."""
    with tempfile.TemporaryDirectory() as place:
        os.chmod(place, 0o755)  # "nobody" has to get that far
        disk = Path(place) / "disk"
        disk.mkdir()
        for left in LEFT:
            with _small_disk(disk) as mounted:
                WRITERS[name].write(disk, 0)
                room = int(left * shutil.disk_usage(disk).used)
                what = f"disk with {room} bytes left" if mounted else f"files of at most {LARGEST_FILE} bytes"
                yield _try_to_write(name, disk, what, partial(_limit_files, room))
            if not mounted:
                break
        rightless = Path(place) / "rightless"
        rightless.mkdir()
        WRITERS[name].write(rightless, 0)
        for path in (rightless, *rightless.rglob("*")):
            path.chmod(0o555 if path.is_dir() else 0o444)
        yield _try_to_write(name, rightless, "folder without rights", _become_nobody)
        for path in (rightless, *rightless.rglob("*")):
            path.chmod(0o755 if path.is_dir() else 0o644)


def _try_to_write(name: str, folder: Path, what: str, prepare: Callable[[Path], None]) -> Trial:
    """Write the second version in a process that was prepared, and look at what is there afterwards."""
    before = {str(path) for path in folder.rglob("*")}
    ours, theirs = PROCESSES.Pipe(duplex=False)
    process = PROCESSES.Process(target=_write, args=(name, folder, prepare, theirs))
    process.start()
    theirs.close()
    good, said, saved = False, "the process died", 0
    with suppress(EOFError):
        good, said, saved = ours.recv()
    process.join()
    (folder / _FILLER).unlink(missing_ok=True)
    left = sorted({str(path) for path in folder.rglob("*")} - before)
    if left:
        return Trial(what, False, f"{said} But there is now {', '.join(left):.200}")
    try:
        found = WRITERS[name].version(folder)
    except (SignimitError, OSError) as error:
        return Trial(what, False, f"{said} But what was saved cannot be read: {error}")
    if found != saved:
        return Trial(what, False, f"{said} But version {found} is there, and {saved} was saved")
    return Trial(what, good, said)


def _write(name: str, folder: Path, prepare: Callable[[Path], None], out: Connection) -> None:
    """Write versions until one fails; tells whether it did in one sentence, which, and the last that was saved."""
    saved = 0
    try:
        prepare(folder)
        for version in range(1, MOST_VERSIONS):
            WRITERS[name].write(folder, version)
            saved = version
        out.send((False, "there was room", saved))
    except (SignimitError, OSError) as error:
        said = error_sentence(error)
        out.send(("\n" not in said and len(said) < 400 and str(folder) in said, said, saved))
    except BaseException as error:
        out.send((False, f"{type(error).__name__}: {error}", saved))


_FILLER = "filler"


def _limit_files(left: int, folder: Path) -> None:
    """Fill the disk but for some bytes if it is a small one, else let no file of this process grow beyond a size."""
    if shutil.disk_usage(folder).total <= DISK:
        (folder / _FILLER).write_bytes(bytes(max(0, shutil.disk_usage(folder).free - left)))
        return
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_FILE, LARGEST_FILE))


def _become_nobody(folder: Path) -> None:
    """As root, who may write everywhere, become a user who may not."""
    if hasattr(os, "geteuid") and not os.geteuid():
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)


@contextmanager
def _small_disk(folder: Path) -> Iterator[bool]:
    """Mount a small disk in memory on a folder, if this process may."""
    command = ["mount", "-t", "tmpfs", "-o", f"size={DISK}", "tmpfs", str(folder)]
    mounted = shutil.which("mount") is not None and not subprocess.run(command, capture_output=True).returncode
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(["umount", "--lazy", str(folder)], check=True)
