"""Formats of stroke files, told by what a file holds: a name proves nothing, nor do its first bytes."""

from __future__ import annotations

import os
from pathlib import Path

from signimit.exceptions import FileFormatError
from signimit.io.archive import read_archive
from signimit.io.formats.dollar import GESTURE, holds_gestures
from signimit.io.formats.textfile import decode_text, is_binary, parse_xml, read_bytes, root_name
from signimit.io.formats.unipen import is_unipen
from signimit.strokes import KIND, VERSION

_ROOTS = {GESTURE: "dollar", "ink": "inkml"}  # by the name of the document's first element
_FIRST_ENTRY = b"signimit.npy"  # of our archives


def detect_format(path: str | os.PathLike[str]) -> str | None:
    """Tell which reader a file is for; none if for none.

    InkML and $1 logs are told by their first element, or by the suffix ``.inkml``, and other XML by the gestures that
    it holds if it is well-formed; UNIPEN by its keywords, wherever they stand; our libraries by their header.
    The rest of the file may still be broken.

    Raises:
        OSError: If the file cannot be read.
        FileFormatError: If it is too large to be looked at.
    """
    if is_binary(path):
        return "library" if is_library(path) else None
    suffix = "inkml" if Path(path).suffix.lower() == ".inkml" else None
    data = read_bytes(path)
    try:
        text, _ = decode_text(data, os.fspath(path))
    except FileFormatError:
        return suffix
    name = root_name(text)
    if name in _ROOTS or suffix or not name:
        return _ROOTS.get(name) or suffix or ("unipen" if is_unipen(text) else None)
    try:
        gestures = f"<{GESTURE}" in text and holds_gestures(parse_xml(data, os.fspath(path)).root)
    except FileFormatError:
        return None
    return "dollar" if gestures else None


def is_library(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file is one of our own stroke libraries, be it truncated or of a later version."""
    try:
        read_archive(path, KIND, VERSION)
    except FileFormatError as error:
        with open(path, "rb") as file:
            ours = _FIRST_ENTRY in file.read(64)
        return ours and error.found.startswith((KIND, "something unreadable"))
    return True
