"""Formats of stroke files, told by what a file holds: a name proves nothing, nor do its first bytes."""

from __future__ import annotations

import os
from pathlib import Path

from signimit.exceptions import FileFormatError
from signimit.io.archive import read_archive
from signimit.io.formats.textfile import decode_text, is_binary, read_bytes, root_name
from signimit.io.formats.unipen import is_unipen
from signimit.strokes import KIND, VERSION

_ROOTS = {"Gesture": "dollar", "ink": "inkml"}  # by the name of the document's first element
_FIRST_ENTRY = b"signimit.npy"  # of our archives


def detect_format(path: str | os.PathLike[str]) -> str | None:
    """Tell which reader a file is for; none if for none.

    XML is told by its first element, or by the suffix ``.inkml``; UNIPEN by its keywords, wherever they stand; our
    libraries by their header. The rest of the file may still be broken.

    Raises:
        OSError: If the file cannot be read.
        FileFormatError: If it is too large to be looked at.
    """
    if is_binary(path):
        return "library" if is_library(path) else None
    suffix = "inkml" if Path(path).suffix.lower() == ".inkml" else None
    try:
        text, _ = decode_text(read_bytes(path), os.fspath(path))
    except FileFormatError:
        return suffix
    return _ROOTS.get(root_name(text)) or suffix or ("unipen" if is_unipen(text) else None)


def is_library(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file is one of our own stroke libraries, be it truncated or of a later version."""
    try:
        read_archive(path, KIND, VERSION)
    except FileFormatError as error:
        with open(path, "rb") as file:
            ours = _FIRST_ENTRY in file.read(64)
        return ours and error.found.startswith((KIND, "something unreadable"))
    return True
