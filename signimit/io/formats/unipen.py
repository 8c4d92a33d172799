"""UNIPEN text, in the dialect of the UCI Pen-Based Recognition of Handwritten Digits data set (``pendigits-orig``).

Format: I. Guyon et al., UNIPEN project of on-line data exchange and recognizer benchmarks, ICPR 1994
(doi:10.1109/ICPR.1994.576870). Data set: E. Alpaydin and F. Alimoglu, 1998 (doi:10.24432/C5MG6K).
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from signimit.exceptions import FileFormatError
from signimit.io.formats.pen_recording import PenFile, PenRecording, library_from_pen_file
from signimit.io.formats.textfile import read_any_text
from signimit.strokes import StrokeLibrary

_SEGMENT = re.compile(r'\.SEGMENT\s+\S+\s+(?P<first>\d{1,9})(?:-(?P<last>\d{1,9}))?\s+\S+\s+"(?P<label>[^"]*)"\s*$')
_COMMENT = re.compile(r"\.COMMENT\s+\S+\s+(?P<writer>\d+)\s+\d+\s*$")
_WRITER = re.compile(r"\.WRITER_ID\s+(?P<writer>\S+)\s*$")


@dataclass
class _Segment:
    """A ``.SEGMENT`` and the pen-down pieces that follow it."""

    label: str
    promised: int
    line: int
    writer: str
    pieces: list[list[tuple[float, float]]] = field(default_factory=list)


def read_unipen(path: str | os.PathLike[str], strict: bool = False) -> StrokeLibrary:
    """Read UNIPEN text whose points follow the ``.SEGMENT`` that names them.

    The label is the segment's, the writer the second word of its ``.COMMENT`` (UCI) or what ``.WRITER_ID`` says.
    Coordinates are y up already. There are no time stamps: points are equidistant, and taken to be 10 ms apart
    (``.DT 100`` is a constant in these files; 100 ms would make a digit last 6 s). Other keywords are passed over.

    Args:
        path: The file.
        strict: Raise the error of the first drawing that would be left out.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: Names the file, the line and what was expected there.
    """
    text, findings = read_any_text(path)
    return library_from_pen_file(path, parse_unipen(text, path), strict, findings)


def is_unipen(text: str) -> bool:
    """Tell whether the first line is one of UNIPEN, and the pen is put down in a later one."""
    return text.lstrip().startswith(".") and re.search(r"^\s*\.PEN_DOWN\b", text, re.MULTILINE) is not None


def parse_unipen(text: str, path: str | os.PathLike[str]) -> PenFile:
    """Find the drawings of a text.

    Raises:
        FileFormatError: Names the file, the line and what was expected there.
    """
    where = os.fspath(path)
    recordings = []
    for segment in _segments(text, where):
        place = f"{where}: line {segment.line}"
        if len(segment.pieces) != segment.promised:
            raise FileFormatError(
                place, f"{segment.promised} pen-down pieces of {segment.label!r}", f"{len(segment.pieces)}"
            )
        pieces = [np.array(piece, dtype=np.float64).reshape(-1, 2) for piece in segment.pieces]
        recordings.append(PenRecording(pieces, None, segment.label, segment.writer, place))
    if not recordings:
        raise FileFormatError(where, 'UNIPEN text with .SEGMENT ... "label"', "no segment")
    return PenFile(recordings, f"UNIPEN {os.path.basename(where)}")


def _segments(text: str, where: str) -> Iterator[_Segment]:
    """Go through the lines, giving out each segment when the next begins."""
    segment: _Segment | None = None
    writer, down = "unknown", False
    for number, line in enumerate(text.splitlines(), 1):
        place = f"{where}: line {number}"
        if line.startswith(".SEGMENT"):
            if down:
                raise FileFormatError(place, ".PEN_UP before the next .SEGMENT", "none")
            if segment is not None:
                yield segment
            segment = _read_segment(line, number, place, writer)
        elif line.startswith((".PEN_DOWN", ".PEN_UP")):
            down = _switch(line, down, segment, place)
        elif line.startswith("."):
            if found := _COMMENT.match(line) or _WRITER.match(line):
                writer = found["writer"]
                if segment is not None and not segment.pieces:
                    segment.writer = writer
        elif line.strip() and down and segment is not None:
            segment.pieces[-1].append(_read_point(line, place))
    if down:
        raise FileFormatError(where, ".PEN_UP after the last .PEN_DOWN", "the end of the file")
    if segment is not None:
        yield segment


def _read_segment(line: str, number: int, place: str, writer: str) -> _Segment:
    found = _SEGMENT.match(line)
    if not found:
        raise FileFormatError(place, '.SEGMENT level first-last quality "label"', repr(line.strip()[:60]))
    promised = int(found["last"] or found["first"]) - int(found["first"]) + 1
    return _Segment(found["label"], promised, number, writer)


def _switch(line: str, down: bool, segment: _Segment | None, place: str) -> bool:
    """Put the pen down or take it up; return whether it is down."""
    if line.startswith(".PEN_UP"):
        return False
    if segment is None:
        raise FileFormatError(place, ".SEGMENT before the first .PEN_DOWN", "none")
    if down:
        raise FileFormatError(place, ".PEN_UP before the next .PEN_DOWN", "none")
    segment.pieces.append([])
    return True


def _read_point(line: str, place: str) -> tuple[float, float]:
    words = line.split()
    try:
        x, y = (float(word) for word in words)
    except ValueError:
        raise FileFormatError(place, "two numbers", repr(line.strip()[:60])) from None
    return x, y
