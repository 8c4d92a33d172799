"""Gesture logs of the $1 recogniser, in XML.

Source: J. O. Wobbrock, A. D. Wilson and Y. Li, Gestures without libraries, toolkits or training, UIST 2007
(doi:10.1145/1294211.1294238). The $N and $P recognisers' logs are the same with ``Stroke`` elements around the points.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.pen_clock import relative_seconds
from signimit.io.formats.pen_recording import PenFile, PenRecording, library_from_pen_file
from signimit.io.formats.xmlfile import local_name, read_xml
from signimit.strokes import StrokeLibrary

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

GESTURE, STROKE, POINT = "Gesture", "Stroke", "Point"
_TIME_UNIT = 0.001  # s


def read_dollar(path: str | os.PathLike[str], strict: bool = False) -> StrokeLibrary:
    """Read gestures: one, or all that an element of another name holds.

    The label is the gesture's name without its running number, the writer its subject. Points are in screen
    coordinates, y down; they are mirrored. Time stamps are milliseconds; a stroke may lack them.

    Args:
        path: The file.
        strict: Raise the error of the first drawing that would be left out.

    Returns:
        A library of one stroke a gesture.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: Names the file, the point and what was expected.
        MissingDependencyError: If defusedxml is not installed.
    """
    document = read_xml(path)
    return library_from_pen_file(path, parse_dollar(document.root, path), strict, document.findings, document.left_out)


def holds_gestures(root: Element) -> bool:
    """Tell whether an element is a gesture, or holds named ones with points."""
    named = (gesture for gesture in _gestures(root) if "Name" in gesture.attrib)
    return local_name(root) == GESTURE or any(local_name(e) == POINT for gesture in named for e in gesture.iter())


def _gestures(root: Element) -> list[Element]:
    """Return the gestures of a document that are in no other, so that none of their points is met twice."""
    found, waiting = [], [root]
    while waiting:
        element = waiting.pop()
        if local_name(element) == GESTURE:
            found.append(element)
        else:
            waiting.extend(reversed(element))
    return found


def parse_dollar(root: Element, path: str | os.PathLike[str]) -> PenFile:
    """Find the gestures of a parsed file.

    Raises:
        FileFormatError: If there is none.
    """
    where = os.fspath(path)
    gestures = _gestures(root)
    if not gestures:
        raise FileFormatError(where, "a Gesture element", f"{local_name(root)!r}")
    recordings, findings, left_out = [], [], []
    for number, gesture in enumerate(gestures):
        place = where if len(gestures) == 1 else f"{where}: drawing {number}"
        try:
            parsed = _parse_gesture(gesture, place)
        except FileFormatError as error:
            left_out.append(error)
        else:
            recordings.append(parsed.recording)
            findings += parsed.findings
    return PenFile(recordings, "$1 gesture logs", findings, left_out)


class _Gesture(NamedTuple):
    recording: PenRecording
    findings: list[Finding]


def _parse_gesture(gesture: Element, where: str) -> _Gesture:
    strokes = [element for element in gesture.iter() if local_name(element) == STROKE]
    if strokes:
        rows = [_parse_points(stroke, f"{where}: stroke {number}") for number, stroke in enumerate(strokes)]
    else:
        rows = [_parse_points(gesture, where)]
    promised, count = gesture.get("NumPts"), sum(len(part.numbers) for part in rows)
    if promised is not None and promised.strip() != str(count):
        raise FileFormatError(where, f"{promised} points as NumPts says", f"{count}")
    commas = sum(part.commas for part in rows)
    findings = [Finding(where, "commas as decimal points: read so", commas)] if commas else []
    name = gesture.get("Name", "unknown")
    label = name.rstrip("0123456789").strip("~_- ") or name
    pieces = [part.numbers[:, :2] * (1.0, -1.0) for part in rows]
    stamps = [part.numbers[:, 2] if part.stamped else None for part in rows]
    writer = gesture.get("Subject", "unknown")
    return _Gesture(PenRecording(pieces, relative_seconds(stamps, _TIME_UNIT), label, writer, where), findings)


class _Points(NamedTuple):
    """Points of one piece: x, y and t, shape (T, 3); whether all have stamps; how many numbers had decimal commas."""

    numbers: NDArray[np.float64]
    stamped: bool
    commas: int


def _parse_points(piece: Element, where: str) -> _Points:
    points = [element for element in piece if local_name(element) == POINT]
    stamped = all(point.get("T", "").strip() for point in points)
    rows, commas = [], 0
    for number, point in enumerate(points):
        try:
            words = [point.attrib["X"], point.attrib["Y"], point.attrib["T"] if stamped else "0"]
            rows.append([float(word.replace(",", ".")) for word in words])
        except (KeyError, ValueError):
            raise FileFormatError(f"{where}: point {number}", "numbers X, Y and T", f"{dict(point.attrib)}") from None
        commas += sum("," in word for word in words)
    return _Points(np.array(rows, dtype=np.float64).reshape(-1, 3), stamped, commas)
