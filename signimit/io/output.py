"""Folders of results that appear whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from signimit.exceptions import InvalidInputError


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
    try:
        draft = Path(tempfile.mkdtemp(dir=near, prefix=f".{target.name}.", suffix=".part"))
    except OSError as error:  # the user knows the target, not the folder beside it
        raise OSError(error.errno, error.strerror, str(target)) from None
    try:
        yield draft
        target.mkdir(parents=True, exist_ok=True)
        for file in sorted(draft.iterdir()):
            os.replace(file, target / file.name)
    finally:
        shutil.rmtree(draft)
