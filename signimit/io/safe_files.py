"""Safe writing: files and folders that are there whole or not at all, and files that grow by whole lines.

What is not whole yet stands beside its place under a hidden name. A line without an end, all that a killed process can
leave of a file that grows, counts as never written: readers skip it, the next line that is appended replaces it.
"""

from __future__ import annotations

import ctypes
import errno
import json
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

from signimit.exceptions import FileFormatError, InvalidInputError

_HERE, _EXCHANGE = -100, 2  # AT_FDCWD, and RENAME_EXCHANGE of Linux as RENAME_SWAP of macOS
MAX_RECORD_BYTES = 512 * 2**20  # of a whole file of records; a larger one is taken for hostile
Record = dict[str, Any]


@contextmanager
def replaced_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Open a file beside ``path`` for writing, and rename it to ``path`` if all goes well.

    Args:
        path: File to make or replace; missing folders are not made.

    Yields:
        The file to write to.

    Raises:
        OSError: If the file cannot be written; what was there before is then untouched.
    """
    with replaced_path(path) as beside, open(beside, "wb") as file:
        yield file


@contextmanager
def replaced_path(path: str | os.PathLike[str], suffix: str = ".part") -> Iterator[Path]:
    """Name a file beside ``path`` that another program may write, and rename it to ``path`` if all goes well.

    Args:
        path: File to make or replace; missing folders are not made.
        suffix: How the other name ends.

    Yields:
        Path of an empty file.

    Raises:
        OSError: If the file cannot be written; what was there before is then untouched.
    """
    target = Path(path)
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(target))
    with _told_of(target):
        handle, beside = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.", suffix=suffix)
    os.close(handle)
    try:
        with _told_of(target, Path(beside)):
            yield Path(beside)
            _grant_usual_access(beside, 0o666)
            os.replace(beside, target)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise


@contextmanager
def whole_files(folder: str | os.PathLike[str]) -> Iterator[Path]:
    """Write files into a hidden folder beside ``folder``, and move them there once all are done.

    Files of the same names are replaced, others stay. Folders on the way there are made at the end, too.

    Args:
        folder: Where the files shall be; made if it is missing.

    Yields:
        The folder to write to.

    Raises:
        InvalidInputError: If ``folder`` is a file.
        OSError: If it cannot be made.
    """
    target = Path(folder)
    if target.exists() and not target.is_dir():
        raise InvalidInputError(str(target), "a folder, or nothing yet", "a file")
    near = next(place for place in target.absolute().parents if place.exists())
    with _told_of(target):
        draft = Path(tempfile.mkdtemp(dir=near, prefix=f".{target.name}.", suffix=".part"))
    try:
        with _told_of(target, draft):
            yield draft
            target.mkdir(parents=True, exist_ok=True)
            for file in sorted(draft.iterdir()):
                os.replace(file, target / file.name)
    finally:
        shutil.rmtree(draft)


@contextmanager
def whole_folder(path: str | os.PathLike[str], marker: str, overwrite: bool = False) -> Iterator[Path]:
    """Fill a hidden folder beside ``path`` with one data set, and give it that name if all goes well.

    Args:
        path: The folder to make; those on the way there are made, too.
        marker: A file that every such data set has. A folder without it is something else and never replaced.
        overwrite: Replace a data set that is there; it stays until the new one is complete.

    Yields:
        The folder to fill.

    Raises:
        InvalidInputError: If there is something under the name that must not be replaced.
        OSError: If the folder cannot be made.
    """
    target = Path(path).absolute()
    check_vacant(target, marker, overwrite)
    target.parent.mkdir(parents=True, exist_ok=True)
    with _told_of(target):
        draft = Path(tempfile.mkdtemp(dir=target.parent, prefix=f".{target.name}.", suffix=".part"))
    try:
        with _told_of(target, draft):
            yield draft
            _grant_usual_access(draft, 0o777)
            check_vacant(target, marker, overwrite)
            _swap(draft, target)
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def check_vacant(path: str | os.PathLike[str], marker: str, overwrite: bool) -> None:
    """Refuse a place that is taken, unless by a data set of the same kind that may be replaced.

    Raises:
        InvalidInputError: Names the place and what is there.
    """
    target = Path(path)
    if not os.path.lexists(target):
        return
    if not (target / marker).is_file():
        raise InvalidInputError(str(target), "nothing of that name yet", "something that is no such data set")
    if not overwrite:
        raise InvalidInputError(str(target), "no data set of that name yet (overwrite replaces it)", "one")


def append_record(path: Path, record: Mapping[str, Any]) -> None:
    """Append a line of JSON and wait until it is on the disk; one process at a time may append.

    Args:
        path: File to append to; it and missing folders are made.
        record: Anything JSON can say.

    Raises:
        OSError: If it cannot be written; all lines before it stay.
        ValueError: If it has a number that JSON cannot say; nothing is written.
    """
    line = json.dumps(record, separators=(",", ":"), allow_nan=False).encode() + b"\n"
    path.parent.mkdir(parents=True, exist_ok=True)
    # Without a buffer: what a full disk did not take would be written when a buffered file is closed.
    with _told_of(path), open(path, "a+b", buffering=0) as file:
        whole = _end_of_last_line(file)
        try:
            file.truncate(whole)
            written = 0
            while written < len(line):
                written += file.write(line[written:])
            os.fsync(file.fileno())
        except OSError:  # the part that was written must not be taken for more than that
            file.truncate(whole)
            raise


def read_records(path: Path) -> list[Record]:
    """Read all whole lines that `append_record` wrote; a file that is not there has none.

    Raises:
        FileFormatError: Names the file and the line that is no JSON object, or says that the file is too large.
    """
    if not path.exists():
        return []
    if path.stat().st_size > MAX_RECORD_BYTES:
        raise FileFormatError(str(path), f"at most {MAX_RECORD_BYTES} bytes", f"{path.stat().st_size}")
    records = []
    with open(path, "rb") as file:
        for number, line in enumerate(file, 1):
            if not line.endswith(b"\n"):
                break
            try:
                record = json.loads(line)
            except (ValueError, RecursionError):
                record = None
            if not isinstance(record, dict):
                found = repr(line.rstrip(b"\n")[:40].decode(errors="replace"))
                raise FileFormatError(f"{path}: line {number}", "a JSON object", found)
            records.append(record)
    return records


def _end_of_last_line(file: BinaryIO) -> int:
    """Return where the last whole line ends, bytes from the beginning, whatever length follows it."""
    end = file.seek(0, os.SEEK_END)
    while end:
        start = max(0, end - 2**16)
        file.seek(start)
        cut = file.read(end - start).rfind(b"\n")
        if cut >= 0:
            return start + cut + 1
        end = start
    return 0


@contextmanager
def _told_of(target: Path, draft: Path | None = None) -> Iterator[None]:
    """Let an error name the target, if it names the draft beside it or nothing: its user does not know what is made.

    Args:
        target: The file or folder that is being made.
        draft: What is made beside it; left out, every error is about the target.
    """
    try:
        yield
    except OSError as error:
        named = error.filename
        if error.errno is None or not (draft is None or named is None or Path(str(named)).is_relative_to(draft)):
            raise
        raise OSError(error.errno, os.strerror(error.errno), str(target)) from None


def _grant_usual_access(path: str | os.PathLike[str], mode: int) -> None:
    """Give a file or folder the access it would have had: what tempfile makes is hidden from the user's group."""
    mask = os.umask(0)
    os.umask(mask)
    os.chmod(path, mode & ~mask)


def _swap(draft: Path, target: Path) -> None:
    """Put the draft in the target's place; whatever was there is then in the draft's, or removed.

    There is no moment without a target, even for a process that is killed, where the system can exchange two folders.
    """
    if not os.path.lexists(target):
        os.rename(draft, target)
        return
    if _exchanged(draft, target):
        return
    old = Path(tempfile.mkdtemp(dir=target.parent, prefix=f".{target.name}.", suffix=".old"))
    os.rename(target, old / target.name)
    try:
        os.rename(draft, target)
    except BaseException:
        os.rename(old / target.name, target)
        raise
    finally:
        shutil.rmtree(old)


def _exchanged(first: Path, second: Path) -> bool:
    """Let two folders exchange their names at once; false where the system or its disk cannot."""
    names = os.fsencode(first), os.fsencode(second)
    try:
        libc = ctypes.CDLL(None)
        if sys.platform == "darwin":
            return not libc.renamex_np(*names, _EXCHANGE)
        return not libc.renameat2(_HERE, names[0], _HERE, names[1], _EXCHANGE)
    except (OSError, AttributeError, TypeError):  # another C library, or Windows
        return False
