"""Reading InkML: from the traces of a drawing to points and time stamps."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.inkml.clocks import TimedPiece, TraceClock, find_times, read_clock
from signimit.io.formats.inkml.context import Contexts
from signimit.io.formats.inkml.document import InkDocument, identity, read_annotation, read_label
from signimit.io.formats.inkml.grouping import Drawing, find_drawings, find_places
from signimit.io.formats.inkml.mapping import map_channels
from signimit.io.formats.inkml.trace_data import read_trace_data
from signimit.io.formats.inkml.trace_format import Scale, TraceFormat
from signimit.io.formats.inkml.views import TraceRange
from signimit.io.formats.pen_recording import SAMPLE_TIME, PenFile, PenRecording, library_from_pen_file
from signimit.io.formats.xmlfile import read_xml
from signimit.strokes import StrokeLibrary

_TRACE_TYPES = ("penDown", "penUp", "indeterminate")


def read_inkml(path: str | os.PathLike[str], strict: bool = False) -> StrokeLibrary:
    """Read the drawings of an InkML document.

    Each group or view that holds traces, or views of traces, is one drawing; traces outside groups are another. The
    label is the nearest annotation of type label, truth or transcription, or the best guess of a recogniser (EMMA),
    else the file's name; the writer the nearest annotation ``"writer"``. Pen-up traces are left out.

    Points are y up, in steps of the file's first channel X: unequal resolutions, units and orientations, several trace
    formats and an affine canvasTransform are allowed for. Time is that of channel T (in ms where it does not say), else
    that of timeOffset, duration and sampleRate, else points are taken to be 10 ms apart.

    Args:
        path: The file.
        strict: Raise the error of the first drawing that would be left out.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If no drawing can be read. Names the file, the drawing, and what was expected there; also where
            X, Y or T are mapped by a table or MathML, and for traces in other files.
        MissingDependencyError: If defusedxml is not installed.
    """
    document = read_xml(path)
    return library_from_pen_file(path, parse_inkml(document.root, path), strict, document.findings, document.left_out)


def parse_inkml(root: Element, path: str | os.PathLike[str]) -> PenFile:
    """Find the drawings of a parsed file.

    Raises:
        FileFormatError: If it is no InkML, or has no traces.
    """
    reader = _InkReader(root, os.fspath(path))
    drawings = find_drawings(reader.document, reader.places)
    if not drawings:
        raise FileFormatError(reader.where, "traces, or views of them, outside definitions", "none")
    recordings, left_out = [], []
    for number, drawing in enumerate(drawings):
        try:
            recordings.append(reader.recording(number, drawing))
        except FileFormatError as error:
            left_out.append(error)
    return PenFile(recordings, f"InkML {os.path.basename(reader.where)}", reader.findings, left_out)


class _Samples(NamedTuple):
    """The points of a trace.

    Attributes:
        points: Shape (T, 2), y up, NaN where the pen's position was not reported.
        ticks: Values of channel T, shape (T,), NaN where not reported; none without such a channel.
        down: Shape (T,): whether the pen touched.
        clock: What the file says of their time.
    """

    points: NDArray[np.float64]
    ticks: NDArray[np.float64] | None
    down: NDArray[np.bool_]
    clock: TraceClock


class _Piece(NamedTuple):
    points: NDArray[np.float64]
    time: TimedPiece


class _InkReader:
    """A document, and what was found in it so far."""

    def __init__(self, root: Element, where: str) -> None:
        self.where = where
        self.document = InkDocument(root, where)
        self.contexts = Contexts(self.document)
        self.places = find_places(self.document, self.contexts)
        self.findings: list[Finding] = []
        self._label = read_label(root) or Path(where).stem
        self._writer = read_annotation(root, ("writer",)) or "unknown"
        self._samples: dict[Element, _Samples] = {}
        self._unit: Scale | None = None  # of the first channel that has one; all points are in it

    def recording(self, number: int, drawing: Drawing) -> PenRecording:
        """Read the traces of a drawing.

        Raises:
            FileFormatError: If it cannot be read.
        """
        place = f"{self.where}: drawing {number}" + (f" {drawing.label!r}" if drawing.label else "")
        parts: list[TraceRange] = []
        for held in drawing.parts:
            if isinstance(held, FileFormatError):
                raise FileFormatError(f"{place}: {held.where}", held.expected, held.found)
            parts += held
        pieces: list[_Piece] = []
        for i, part in enumerate(self._in_order(parts, place)):
            kind = part.trace.get("type", "penDown").strip()
            if kind != "penUp":
                try:
                    pieces += self._pieces(part, kind, place)
                except FileFormatError as error:
                    name = f"{place}: trace {identity(part.trace) or i}"
                    raise FileFormatError(f"{name}: {error.where}", error.expected, error.found) from None
        times = find_times([piece.time for piece in pieces])
        sample_time = pieces[0].time.clock.sample_time if pieces else SAMPLE_TIME
        if times.paced:
            what = f"no time stamps within traces: points taken to be {1000 * sample_time:g} ms apart"
            self.findings.append(Finding(place, what, kind="assumed"))
        return PenRecording(
            pieces=[piece.points for piece in pieces],
            stamps=times.stamps,
            label=drawing.label or self._label,
            writer=drawing.writer or self._writer,
            where=place,
            clock=times.clock,
            sample_time=sample_time,
        )

    def _in_order(self, parts: Sequence[TraceRange], place: str) -> list[TraceRange]:
        """Put traces that continue others behind them; streams of two pens or hands may alternate."""
        chains: list[list[TraceRange]] = []
        chain_of: dict[Element, list[TraceRange]] = {}
        for part in parts:
            chain: list[TraceRange] | None = None
            reference = part.trace.get("priorRef")
            if reference and part.trace.get("continuation") in ("middle", "end"):
                try:
                    chain = chain_of.get(self.document.find(reference, ("trace",), "priorRef"))
                except FileFormatError:
                    self.findings.append(Finding(place, "traces that continue none of the file: left where they stand"))
            if chain is None:
                chain = []
                chains.append(chain)
            chain.append(part)
            chain_of[part.trace] = chain
        return [part for chain in chains for part in chain]

    def _pieces(self, part: TraceRange, kind: str, place: str) -> list[_Piece]:
        """Return the points of a trace, or of a part of it, where the pen was down.

        Raises:
            FileFormatError: If the trace cannot be read, or has no such part.
        """
        if kind not in _TRACE_TYPES:
            raise FileFormatError("type", f"one of {', '.join(_TRACE_TYPES)}", repr(kind[:60]))
        if part.trace not in self._samples:
            self._samples[part.trace] = self._read(part.trace, place)
        points, ticks, down, clock = self._samples[part.trace]
        last = len(points) if part.last is None else part.last
        if last > len(points) or part.first > last:
            raise FileFormatError("view", f"from and to between 1 and {len(points)}", f"{part.first + 1} to {last}")
        steps = np.arange(part.first, last)
        steps = steps[~np.isnan(points[steps]).any(axis=1)]
        if len(steps) < last - part.first:
            what = "points without a reported position: left out"
            self.findings.append(Finding(place, what, last - part.first - len(steps)))
        runs = [steps]
        if kind == "indeterminate":  # else its type says already that the pen was down
            runs = np.split(steps, np.flatnonzero(np.diff(down[steps])) + 1)
            runs = [run for run in runs if len(run) and down[run[0]]]
        return [
            _Piece(points[run], TimedPiece(part.trace, clock, run, len(points), None if ticks is None else ticks[run]))
            for run in runs
            if len(run)
        ]

    def _read(self, trace: Element, place: str) -> _Samples:
        """Decode a trace, and turn its numbers into points of one unit, y up.

        Raises:
            FileFormatError: If its context or its numbers cannot be understood.
        """
        around = self.places[trace]
        context = self.contexts.of(around.context, around.stream)
        data = read_trace_data(trace.text or "", context.layout)
        if data.stray_commas:
            self.findings.append(Finding(place, "commas without a point behind them", data.stray_commas))
        columns = zip(context.layout.channels, data.values.T, strict=True)
        channels = map_channels(context.mappings, {channel.name: values for channel, values in columns})
        final = context.canvas or context.layout
        x, y = final.channel("X"), final.channel("Y")
        if x is None or y is None or not {"X", "Y"} <= set(channels):
            raise FileFormatError("trace format", "channels X and Y", ", ".join(channels))
        size = self._size(final)
        points = np.column_stack([channels["X"] * (x.sign * size), channels["Y"] * (-y.sign * size * final.aspect)])
        down = channels.get("S", np.ones(len(points))) != 0
        return _Samples(points, channels.get("T"), down, read_clock(trace, context, self.contexts))

    def _size(self, layout: TraceFormat) -> float:
        """Return the size of a step of X in that of the first channel of the file that has a size."""
        scale = layout.length("X") or layout.length("Y")
        self._unit = self._unit or scale
        same = scale is not None and self._unit is not None and scale.unit == self._unit.unit
        return scale.size / self._unit.size if same and scale and self._unit else 1.0
