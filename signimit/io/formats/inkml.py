"""W3C InkML, the Ink Markup Language (Recommendation of 20 September 2011, https://www.w3.org/TR/InkML)."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.formats.pen_clock import relative_seconds
from signimit.io.formats.pen_recording import PenFile, PenRecording, library_from_pen_file
from signimit.io.formats.textfile import local_name, read_xml
from signimit.io.safe_files import replaced_file
from signimit.strokes import Stroke, StrokeLibrary

LABEL_TYPES = ("label", "truth")
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
_NO_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_WRITTEN_CHANNELS = (
    {"name": "X", "type": "decimal"},
    {"name": "Y", "type": "decimal", "orientation": "-ve"},
    {"name": "T", "type": "decimal", "units": "s"},
)
_ID = "{http://www.w3.org/XML/1998/namespace}id"


class TraceFormat(NamedTuple):
    """Which number of a point is what.

    Attributes:
        x: Column of X.
        y: Column of Y.
        t: Column of T; none without time stamps.
        channels: How many numbers a point has at most.
        up: 1 if Y grows upwards, -1 if downwards.
        seconds: Seconds in a unit of T.
    """

    x: int = 0
    y: int = 1
    t: int | None = None
    channels: int = 2
    up: float = -1.0
    seconds: float = TIME_UNITS["ms"]


def read_inkml(path: str | os.PathLike[str], strict: bool = False) -> StrokeLibrary:
    """Read traces with channels X, Y and perhaps T.

    Each trace group that holds traces, or views of traces, is one drawing; without groups all traces of the file are.
    The label is the nearest ``<annotation type="label">`` or ``"truth"``, else the file's name; the writer the nearest
    ``"writer"``. Y grows downwards, as the standard has it, unless its channel says ``orientation="-ve"``. T is in
    milliseconds unless the channel says otherwise; without T points are taken to be 10 ms apart. Pen-up traces are
    left out.

    Args:
        path: The file.
        strict: Raise the error of the first drawing that would be left out.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If no drawing can be read. Names the file, the trace, and what was expected there; also for
            difference-encoded values and for several trace formats, which are not understood.
        MissingDependencyError: If defusedxml is not installed.
    """
    document = read_xml(path)
    return library_from_pen_file(path, parse_inkml(document.root, path), strict, document.findings)


def parse_inkml(root: Element, path: str | os.PathLike[str]) -> PenFile:
    """Find the drawings of a parsed file.

    Raises:
        FileFormatError: If it is no InkML.
    """
    where = os.fspath(path)
    if local_name(root) != "ink":
        raise FileFormatError(where, "an ink element", f"{local_name(root)!r}")
    layout = _trace_format(root, where)
    traces = {_identity(e): e for e in root.iter() if local_name(e) == "trace"}
    recordings, left_out = [], []
    for number, drawing in enumerate(_drawings(root)):
        place = f"{where}: drawing {number}"
        try:
            points = [_read_trace(trace, layout, place) for trace in _traces_of(drawing.element, traces, place)]
        except FileFormatError as error:
            left_out.append(error)
            continue
        pieces = [np.column_stack([p[:, layout.x], p[:, layout.y] * layout.up]) for p in points]
        stamps = None if layout.t is None else relative_seconds([p[:, layout.t] for p in points], layout.seconds)
        label = drawing.label or Path(where).stem
        recordings.append(PenRecording(pieces, stamps, label, drawing.writer or "unknown", place))
    return PenFile(recordings, f"InkML {os.path.basename(where)}", left_out=left_out)


class _Drawing(NamedTuple):
    """An element that holds traces, and what it or the nearest element around it is annotated with."""

    element: Element
    label: str | None
    writer: str | None


def _drawings(root: Element) -> list[_Drawing]:
    """Return the elements that are one drawing each, in the order of the file."""
    whole = _Drawing(root, _annotation(root, LABEL_TYPES), _annotation(root, ("writer",)))
    found, waiting = [], [whole]
    while waiting:
        drawing = waiting.pop()
        kinds = [local_name(child) for child in drawing.element]
        if drawing is not whole and ("trace" in kinds or "traceView" in kinds):
            found.append(drawing)
        groups = [child for child, kind in zip(drawing.element, kinds, strict=True) if kind == "traceGroup"]
        for group in reversed(groups):
            label, writer = _annotation(group, LABEL_TYPES), _annotation(group, ("writer",))
            waiting.append(_Drawing(group, label or drawing.label, writer or drawing.writer))
    return found or [whole]


def _traces_of(element: Element, traces: dict[str, Element], place: str) -> list[Element]:
    """Return the pen-down traces of a drawing; those it refers to are taken out of ``traces``.

    So a small file cannot refer to one large trace a million times.
    """
    members = []
    for child in element if local_name(element) == "traceGroup" else element.iter():
        if local_name(child) == "traceView" and local_name(element) == "traceGroup":
            name = child.get("traceDataRef", "").lstrip("#")
            if name not in traces:
                raise FileFormatError(place, "a traceView of a trace in this file, viewed once", repr(name))
            members.append(traces.pop(name))
        elif local_name(child) == "trace":
            members.append(child)
    return [trace for trace in members if trace.get("type", "penDown") != "penUp"]


def _identity(element: Element) -> str:
    return element.get(_ID) or element.get("id") or f"#{id(element)}"


def _annotation(element: Element, types: Sequence[str]) -> str | None:
    """Return the text of an element's first annotation of one of these types."""
    for child in element:
        if local_name(child) == "annotation" and child.get("type", "").lower() in types and child.text:
            return child.text.strip() or None
    return None


def _trace_format(root: Element, where: str) -> TraceFormat:
    """Read the document's only trace format, or return the standard's own: X and Y."""
    formats = [e for e in root.iter() if local_name(e) == "traceFormat"]
    layouts = {_layout(element, where) for element in formats}
    if len(layouts) > 1:
        raise FileFormatError(where, "one trace format", f"{len(layouts)} different ones")
    return layouts.pop() if layouts else TraceFormat()


def _layout(element: Element, where: str) -> TraceFormat:
    channels = {
        c.get("name", ""): (i, c) for i, c in enumerate(e for e in element.iter() if local_name(e) == "channel")
    }
    if not {"X", "Y"} <= set(channels):
        raise FileFormatError(where, "channels X and Y", ", ".join(channels) or "none")
    (x, _), (y, vertical) = channels["X"], channels["Y"]
    time, clock = channels.get("T", (None, None))
    unit = "ms" if clock is None else clock.get("units", "ms")
    if unit not in TIME_UNITS:
        raise FileFormatError(where, f"channel T in {', '.join(TIME_UNITS)}", repr(unit))
    up = 1.0 if vertical.get("orientation") == "-ve" else -1.0
    return TraceFormat(x, y, time, len(channels), up, TIME_UNITS[unit])


def _read_trace(trace: Element, layout: TraceFormat, place: str) -> NDArray[np.float64]:
    """Return the numbers of a trace, shape (T, channels); missing intermittent channels are 0."""
    needed = 1 + max(layout.x, layout.y, layout.t or 0)
    rows = []
    for number, point in enumerate((trace.text or "").split(",")):
        words = point.split()
        try:
            if not needed <= len(words) <= layout.channels:
                raise ValueError
            rows.append([float(word.removeprefix("!")) for word in words] + [0.0] * (layout.channels - len(words)))
        except ValueError:
            if not words and number == 0:
                break
            expected = f"{needed} plain numbers (differences, wildcards and hexadecimals are not understood)"
            raise FileFormatError(f"{place}: point {number}", expected, repr(point.strip()[:60])) from None
    return np.array(rows, dtype=np.float64).reshape(-1, layout.channels)


def write_inkml(path: str | os.PathLike[str], library: StrokeLibrary) -> None:
    """Write a library, whole or not at all: one trace group for each stroke, with its label and writer.

    Numbers are written so that `read_inkml` gives the same library back to the last bit, times from 0.

    Raises:
        InvalidInputError: If a label or writer has characters that XML cannot hold.
    """
    ink = Element("ink", {"xmlns": "http://www.w3.org/2003/InkML"})
    channels = SubElement(ink, "traceFormat")
    for channel in _WRITTEN_CHANNELS:
        SubElement(channels, "channel", channel)
    _annotate(ink, "source", library.source)
    for stroke, label, writer in zip(library.strokes, library.labels, library.writers, strict=True):
        group = SubElement(ink, "traceGroup")
        _annotate(group, "label", label)
        _annotate(group, "writer", writer)
        SubElement(group, "trace").text = _trace(stroke)
    indent(ink)
    with replaced_file(path) as file:
        file.write(tostring(ink, encoding="utf-8", xml_declaration=True))


def _annotate(element: Element, kind: str, text: str) -> None:
    if found := _NO_XML.search(text):
        raise InvalidInputError(kind, "characters that XML can hold", repr(found[0]))
    SubElement(element, "annotation", {"type": kind}).text = text


def _trace(stroke: Stroke) -> str:
    rows = zip(stroke.points.tolist(), stroke.times.tolist(), strict=True)
    return ", ".join(f"{x!r} {y!r} {t!r}" for (x, y), t in rows)
