"""Folders that hold one data set: there whole or not at all, and never replaced by accident."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from signimit.exceptions import InvalidInputError


@contextmanager
def whole_folder(path: str | os.PathLike[str], marker: str, overwrite: bool = False) -> Iterator[Path]:
    """Fill a hidden folder beside ``path``, and give it that name if all goes well.

    Args:
        path: The folder to make; those on the way there are made, too.
        marker: A file that every such data set has. A folder without it is somebody else's and never replaced.
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
    try:
        draft = Path(tempfile.mkdtemp(dir=target.parent, prefix=f".{target.name}.", suffix=".part"))
    except OSError as error:  # the user knows the target, not the folder beside it
        raise OSError(error.errno, error.strerror, str(target)) from None
    try:
        yield draft
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(draft, 0o777 & ~mask)  # mkdtemp's 0700 would hide the folder from the user's group
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


def _swap(draft: Path, target: Path) -> None:
    """Put the draft in the target's place; whatever was there is removed last."""
    if not os.path.lexists(target):
        os.rename(draft, target)
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
