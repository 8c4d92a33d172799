"""Files that are written whole or not at all."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO


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
    try:
        handle, beside = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.", suffix=suffix)
    except OSError as error:  # the user knows the target, not the file beside it
        raise OSError(error.errno, error.strerror, str(target)) from None
    os.close(handle)
    try:
        yield Path(beside)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, 0o666 & ~mask)  # mkstemp's 0600 would hide the file from the user's group
        os.replace(beside, target)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise
