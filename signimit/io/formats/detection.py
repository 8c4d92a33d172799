"""Formats of stroke files, told by what a file holds: a name proves nothing, nor do its first bytes."""

from __future__ import annotations

import os
import re
from pathlib import Path

from signimit.exceptions import FileFormatError
from signimit.io.archive import read_archive
from signimit.io.formats.dollar import GESTURE, holds_gestures
from signimit.io.formats.textfile import decode_text, is_binary, read_bytes
from signimit.io.formats.unipen import is_unipen
from signimit.io.formats.xmlfile import parse_xml, root_name
from signimit.strokes import KIND, VERSION

_ROOTS = {GESTURE: "dollar", "ink": "inkml"}  # by the name of the document's first element
_INK = re.compile(r"<(?:\w+:)?(?:Point\s[^<>]*\bX\s*=|trace\b[^<>]*>[^<]*\d)")  # a point of a gesture or trace
_KIND = re.compile(r"(.+) version \d+")  # what `read_archive` says that it found
_FIRST_ENTRY = b"signimit.npy"  # of our archives


def detect_format(path: str | os.PathLike[str]) -> str | None:
    """Tell which reader a file is for; none if for none.

    InkML and $1 logs are told by their first element, other XML by the gestures that it holds; UNIPEN by its keywords,
    wherever they stand; our libraries by their header. A file that is broken counts if there is ink in it, or if its
    suffix says that there should be.

    Raises:
        OSError: If the file cannot be read.
        FileFormatError: If it is too large to be looked at.
    """
    if is_binary(path):
        return "library" if is_library(path) else None
    data, suffix = read_bytes(path), Path(path).suffix.lower()
    supposed = "inkml" if suffix == ".inkml" else None
    try:
        text, _ = decode_text(data, os.fspath(path))
    except FileFormatError:
        return supposed
    name = root_name(text)
    if not name:
        return supposed or ("unipen" if is_unipen(text) else None)
    named = _ROOTS.get(name, supposed)
    if named and (suffix in (".xml", ".inkml") or _INK.search(text)):
        return named
    if not named and f"{GESTURE} " not in text:
        return None
    try:
        root = parse_xml(data, os.fspath(path)).root
    except FileFormatError:
        return None
    return named or ("dollar" if holds_gestures(root) else None)


def is_library(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file is one of our own stroke libraries, be it broken or of a later version.

    An archive of ours that is too broken to say what it is might be one.
    """
    try:
        read_archive(path, KIND, VERSION)
    except FileFormatError as error:
        with open(path, "rb") as file:
            ours = _FIRST_ENTRY in file.read(64)
        other = _KIND.fullmatch(error.found)
        return ours and (other is None or other[1] == KIND)
    return True
