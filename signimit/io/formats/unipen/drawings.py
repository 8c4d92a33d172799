"""Drawings of UNIPEN text: the segments of a level, with their pieces of pen-down movement, label and writer."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.pen_clock import relative_seconds
from signimit.io.formats.pen_recording import SAMPLE_TIME, PenFile, PenRecording, library_from_pen_file
from signimit.io.formats.textfile import read_any_text
from signimit.io.formats.unipen.pen_data import Component, PenReader
from signimit.io.formats.unipen.segments import (
    Segment,
    Slice,
    choose_level,
    choose_numbering,
    find_slices,
    read_segment,
    segments_of_level,
)
from signimit.io.formats.unipen.statements import StatementReader
from signimit.strokes import StrokeLibrary

TIME_UNIT = 1e-3  # s, of channel T
MOST_SEGMENTS = 100_000
_BY_PLACE = "numbers of components of a larger file: segments taken to be what follows them"
_LIPITK_NAME = re.compile(r"(?P<label>\d+)t\d+")  # 000004t01 is the first 000004
_UCI_COMMENT = re.compile(r"\s+(?P<label>\S+)\s+(?P<writer>\d+)\s+\d+\s*")


def read_unipen(path: str | os.PathLike[str], strict: bool = False, *, level: str | None = None) -> StrokeLibrary:
    """Read the segments of UNIPEN text, each as one stroke.

    A segment is the components that it names (``3-5,8``, or points ``2:10-4:20``), counted from 0, wherever it stands.
    One that names none (``.SEGMENT CHARACTER``, or ``?``) is those that follow it, and so are the segments of excerpts
    that keep the numbers of a larger file, as UCI's pendigits do. Components with the pen up count if they have points,
    and are left out of the drawing. A file without segments is one drawing.

    The label is the segment's; without labels, the file's name (of lipitk's 000004t01, 000004). The writer is what
    ``.WRITER_ID`` says, or the second word of UCI's ``.COMMENT``. Y grows upwards, and is told in units of X where the
    resolutions differ. Time is channel T, in milliseconds; else ``.POINTS_PER_SECOND``, with pauses as long as pen-up
    points or ``.DT`` say; else points are taken to be 10 ms apart, and ``.DT`` says nothing (in pendigits it is 100
    always, so that a digit would last 6 s). Other keywords are passed over, ``.START_BOX`` too: coordinates stay as
    they are written.

    Args:
        path: The file. What it includes is read from its own folder and below, see `StatementReader`.
        strict: Raise the error of the first drawing that would be left out.
        level: Level of the hierarchy, e.g. ``"WORD"``; left out, the innermost one that has labels.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: Names the file, the line and what was expected there.
        UnknownNameError: If the file has no segments of the level.
    """
    document = read_any_text(path)
    return library_from_pen_file(path, parse_unipen(document.text, path, level=level), strict, document.findings)


def parse_unipen(text: str, path: str | os.PathLike[str], *, level: str | None = None) -> PenFile:
    """Find the drawings of UNIPEN text as `read_unipen` does.

    Raises:
        FileFormatError: If there is no pen data, or more than a file can mean.
        UnknownNameError: If there are no segments of the level.
    """
    where = os.fspath(path)
    contents = _read_contents(text, where)
    findings, segments, components = list(contents.findings), contents.segments, contents.components
    if not components:
        missing = "".join(f" ({finding.where}: {finding.what})" for finding in findings[:1])
        raise FileFormatError(where, "UNIPEN text with .PEN_DOWN and points", f"none{missing}")
    if not segments:
        segments, level = [Segment("", None, "", where, 0)], None
        findings.append(Finding(where, "no .SEGMENT: the whole file taken as one drawing", kind="assumed"))
    levels = choose_level(segments, contents.hierarchy, level)
    chosen = segments_of_level(segments, levels, len(components))
    numbering = choose_numbering(chosen, components, where)
    if what := _BY_PLACE if numbering is None else numbering.what:
        findings.append(Finding(where, what, kind="assumed"))
    stem = Path(where).stem
    unlabelled = found["label"] if (found := _LIPITK_NAME.fullmatch(stem)) else stem
    labelled = any(placed.segment.label for placed in chosen)
    recordings, left_out, used = [], [], set[int]()
    for placed in chosen:
        segment = placed.segment
        try:
            slices = find_slices(placed, numbering, components)
            used.update(s.component for s in slices)
            if labelled and not segment.label:
                raise FileFormatError(segment.where, '.SEGMENT level first-last quality "label"', "no label")
            recordings.append(_recording(segment, slices, components, segment.label or unlabelled))
        except FileFormatError as error:
            left_out.append(error)
    unused = sum(component.down and n not in used for n, component in enumerate(components))
    if unused:
        findings.append(Finding(where, "pen-down components in no segment", unused, "assumed"))
    return PenFile(recordings, f"UNIPEN {os.path.basename(where)}", findings, left_out, contents.included)


class _Contents(NamedTuple):
    """What the statements of a file, and of those that it includes, come to."""

    components: Sequence[Component]
    segments: Sequence[Segment]
    hierarchy: Sequence[str]
    findings: Sequence[Finding]
    included: Sequence[Path]


def _read_contents(text: str, where: str) -> _Contents:
    statements, pen = StatementReader(where), PenReader()
    segments: list[Segment] = []
    hierarchy: list[str] = []
    base = 0
    for statement in statements.read(text):
        if statement.keyword == "SEGMENT":
            if len(segments) == MOST_SEGMENTS:
                raise FileFormatError(statement.where, f"at most {MOST_SEGMENTS} segments", "more")
            segments.append(read_segment(statement, len(pen.components), base))
        elif statement.keyword == "START_SET":
            base = len(pen.components)
        elif statement.keyword == "HIERARCHY":
            hierarchy = statement.body.split()
        elif statement.keyword == "COMMENT":
            found = _UCI_COMMENT.fullmatch(statement.body)
            if found and segments and found["label"] == segments[-1].label:
                pen.writer = found["writer"]
        else:
            pen.read(statement)
    pen.finish()
    return _Contents(
        pen.components, segments, hierarchy, [*statements.findings, *pen.findings], tuple(statements.included)
    )


def _recording(segment: Segment, slices: Sequence[Slice], components: Sequence[Component], label: str) -> PenRecording:
    """Join the pen-down slices of a segment.

    Raises:
        FileFormatError: If one of them is broken, or there is none.
    """
    for s in slices:
        if (error := components[s.component].error) is not None:
            raise error
    down = [(components[s.component], slice(s.start, s.stop)) for s in slices if components[s.component].down]
    if not down:
        raise FileFormatError(segment.where, f"a component of {label!r} with the pen down", "none")
    first = down[0][0]
    pieces = [component.points[part] for component, part in down]
    stamps: list[NDArray[np.float64] | None] | None = None
    if any(component.stamps is not None for component, _ in down):
        given = [None if component.stamps is None else component.stamps[part] for component, part in down]
        stamps = relative_seconds(given, TIME_UNIT)
    elif first.interval and all(component.run == first.run for component, _ in down):
        indices = [np.arange(part.start, part.stop, dtype=np.float64) for _, part in down]
        stamps = [c.start + (c.interval or 0.0) * index for (c, _), index in zip(down, indices, strict=True)]
    return PenRecording(pieces, stamps, label, first.writer, segment.where, sample_time=first.interval or SAMPLE_TIME)
