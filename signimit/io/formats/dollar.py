"""Gesture logs of the $1 recogniser, in XML.

Source: J. O. Wobbrock, A. D. Wilson and Y. Li, Gestures without libraries, toolkits or training, UIST 2007
(doi:10.1145/1294211.1294238). The $N and $P recognisers' logs are the same with ``Stroke`` elements around the points.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from signimit.exceptions import FileFormatError
from signimit.io.formats.pen_clock import relative_seconds
from signimit.io.formats.pen_recording import PenFile, PenRecording, library_from_pen_file
from signimit.io.formats.textfile import local_name, read_xml
from signimit.strokes import StrokeLibrary

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element


def read_dollar(path: str | os.PathLike[str], strict: bool = False) -> StrokeLibrary:
    """Read one gesture.

    The label is the gesture's name without its running number, the writer its subject. Points are in screen
    coordinates, y down; they are mirrored. Time stamps are milliseconds.

    Args:
        path: The file.
        strict: Raise the error of the first drawing that would be left out; here there is only one, which is raised.

    Returns:
        A library of one stroke.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: Names the file, the point and what was expected.
        MissingDependencyError: If defusedxml is not installed.
    """
    document = read_xml(path)
    return library_from_pen_file(path, parse_dollar(document.root, path), strict, document.findings)


def parse_dollar(root: Element, path: str | os.PathLike[str]) -> PenFile:
    """Find the drawing of a parsed file.

    Raises:
        FileFormatError: If it is no gesture, or a point is none.
    """
    where = os.fspath(path)
    if local_name(root) != "Gesture":
        raise FileFormatError(where, "a Gesture element", f"{local_name(root)!r}")
    pieces = [e for e in root.iter() if local_name(e) == "Stroke"] or [root]
    rows = [_rows(piece, where) for piece in pieces]
    promised, count = root.get("NumPts"), sum(len(part) for part in rows)
    if promised is not None and promised.strip() != str(count):
        raise FileFormatError(where, f"{promised} points as NumPts says", f"{count}")
    label = root.get("Name", "").rstrip("0123456789").strip("~_- ") or root.get("Name", "unknown")
    recording = PenRecording(
        [part[:, :2] * (1.0, -1.0) for part in rows],
        relative_seconds([part[:, 2] for part in rows], 0.001),
        label,
        root.get("Subject", "unknown"),
        where,
    )
    return PenFile([recording], "$1 gesture logs")


def _rows(piece: Element, where: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Return x, y and t of the points of one piece, shape (T, 3)."""
    rows = []
    for number, point in enumerate(e for e in piece if local_name(e) == "Point"):
        try:
            rows.append([float(point.attrib[name]) for name in "XYT"])
        except (KeyError, ValueError):
            raise FileFormatError(f"{where}: point {number}", "numbers X, Y and T", f"{dict(point.attrib)}") from None
    return np.array(rows, dtype=np.float64).reshape(-1, 3)
