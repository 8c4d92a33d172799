"""Recordings of pens, and strokes made of them: pieces of movement, joined where the pen was up."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.formats.import_report import FileReport, Finding, ImportReport, StrokeImportWarning
from signimit.io.formats.pen_clock import mean_interval, piece_times, place_pieces, spread_ties
from signimit.paths import step_lengths
from signimit.strokes import Stroke, StrokeLibrary
from signimit.validation import finite_array

MOST_STEPS, MOST_BRIDGED = 1000, 1_000_000  # of a bridge, of all bridges of a drawing
SAMPLE_TIME = 0.01  # s, between points of recordings without time stamps
Points = NDArray[np.float64]
Times = NDArray[np.float64]


class PenRecording(NamedTuple):
    """One recorded drawing.

    Attributes:
        pieces: Where the pen was while down, each of shape (T_i, 2), y up.
        stamps: When, each of shape (T_i,), s, or none where a piece has none; none if the device did not say.
        label: What was drawn.
        writer: Who drew it.
        where: File and place in it, for errors.
        clock: ``"own"`` if the stamps of each piece are known to begin anew, ``"shared"`` if they need not.
        sample_time: Time between points that have no usable stamps, s.
    """

    pieces: Sequence[Points]
    stamps: Sequence[Times | None] | None
    label: str
    writer: str
    where: str
    clock: Literal["shared", "own"] = "shared"
    sample_time: float = SAMPLE_TIME


class PenFile(NamedTuple):
    """What the parser of a format found in a file.

    Attributes:
        recordings: The drawings.
        source: What the file is, in words.
        findings: What was repaired or assumed in parsing.
        left_out: For each drawing that could not be parsed, the error that says why.
        includes: Other files that were read for this one.
    """

    recordings: Sequence[PenRecording]
    source: str
    findings: Sequence[Finding] = ()
    left_out: Sequence[FileFormatError] = ()
    includes: Sequence[Path] = ()


class MendedStroke(NamedTuple):
    """A stroke, and what was repaired or assumed to make it one."""

    stroke: Stroke
    findings: tuple[Finding, ...]


def library_from_pen_file(
    path: str | os.PathLike[str],
    pen_file: PenFile,
    strict: bool = False,
    findings: Sequence[Finding] = (),
    left_out: Sequence[FileFormatError] = (),
) -> StrokeLibrary:
    """Make each recording of a file one stroke, and warn of what was repaired or left out.

    Args:
        path: The file.
        pen_file: What was found in it.
        strict: Raise the error of the first drawing that would be left out.
        findings: What was repaired before the file was parsed.
        left_out: Why a part of the file was left out before it was parsed.

    Raises:
        FileFormatError: Names the recording that is no stroke, if it is to be strict or none is left.
    """
    library, file = import_pen_file(path, "", pen_file, findings, left_out)
    report = ImportReport((file,))
    if report.left_out and (strict or not len(library)):
        raise report.left_out[0]
    if not report.flawless:
        warnings.warn(report.summary(), StrokeImportWarning, stacklevel=3)
    return library


def import_pen_file(
    path: str | os.PathLike[str],
    format: str,
    pen_file: PenFile,
    findings: Sequence[Finding] = (),
    left_out: Sequence[FileFormatError] = (),
) -> tuple[StrokeLibrary, FileReport]:
    """Make each recording of a file one stroke, and report what was repaired or left out.

    Args:
        path: The file.
        format: Its format, for the report.
        pen_file: What was found in it.
        findings: What was repaired before the file was parsed.
        left_out: Why a part of the file was left out before it was parsed.
    """
    strokes, kept, omitted, found = [], [], [*pen_file.left_out, *left_out], [*findings, *pen_file.findings]
    for recording in pen_file.recordings:
        try:
            mended = mend_recording(recording)
        except FileFormatError as error:
            omitted.append(error)
        else:
            kept.append(recording)
            strokes.append(mended.stroke)
            found += mended.findings
    if not strokes and not omitted:
        omitted.append(FileFormatError(os.fspath(path), "strokes", "none"))
    labels, writers = tuple(r.label for r in kept), tuple(r.writer for r in kept)
    library = StrokeLibrary(tuple(strokes), labels, writers, pen_file.source)
    report = FileReport(Path(path), format, len(strokes), tuple(found), tuple(omitted), tuple(pen_file.includes))
    return library, report


def stroke_from_recording(recording: PenRecording) -> Stroke:
    """Join the pieces of a recording as `mend_recording` does, without saying what was repaired.

    Raises:
        FileFormatError: If the recording has no points, does not move, or its clock runs backwards.
    """
    return mend_recording(recording).stroke


def mend_recording(recording: PenRecording) -> MendedStroke:
    """Join the pieces of a recording, with a straight line of about the median step where the pen was up.

    Points without usable time stamps, and those of the bridges between them, are ``recording.sample_time`` apart. With
    stamps, a bridge takes the time that the pen was up. Pieces that are not in the order of their clock are put in
    order; one that overlaps in time with the one before it, or has a clock of its own, is put behind it, and the bridge
    to it is crossed at the mean pace. Stamps that step back by up to 16 ms are lifted to the latest before them, and
    stamps that repeat, as coarse clocks do, share the time to the next one.

    Raises:
        FileFormatError: If the recording has no points, does not move, or its clock runs backwards.
    """
    try:
        filled = [i for i, piece in enumerate(recording.pieces) if len(piece)]
        pieces = [finite_array(recording.pieces[i], "points", (None, 2)) for i in filled]
        if not pieces:
            raise InvalidInputError("points", "at least 2", "none")
        stamps = [None if recording.stamps is None else recording.stamps[i] for i in filled]
        counts, own = [len(piece) for piece in pieces], recording.clock == "own"
        timing = piece_times(stamps, counts, own, recording.sample_time, recording.where)
        findings = list(timing.findings)
        pieces = [pieces[i] for i in timing.order]
        bridges = _bridge_steps(pieces)
        points = _joined(pieces, bridges)
        if timing.stamps is None:
            times = recording.sample_time * np.arange(len(points), dtype=np.float64)
        else:
            interval = mean_interval(timing.stamps) or recording.sample_time
            gaps = [interval * steps for steps in bridges]
            clocked, more = place_pieces(timing.stamps, timing.own, gaps, recording.where)
            findings += [finding._replace(kind="assumed") for finding in more] if own else more
            times = spread_ties(_joined([piece[:, None] for piece in clocked], bridges)[:, 0])
        return MendedStroke(Stroke(points, times - times[0]), tuple(findings))
    except InvalidInputError as error:
        raise FileFormatError(f"{recording.where}: {error.where}", error.expected, error.found) from None


def _bridge_steps(pieces: Sequence[Points]) -> list[int]:
    """Return in how many steps the gap after each piece but the last is crossed."""
    steps = step_lengths(np.concatenate(pieces))
    median = (float(np.median(steps)) or float(steps.max())) if len(steps) else 0.0
    most = min(MOST_STEPS, MOST_BRIDGED // len(pieces))
    gaps = [float(np.linalg.norm(after[0] - before[-1])) for before, after in pairwise(pieces)]
    return [max(1, int(min(gap / median, most))) if median else 1 for gap in gaps]


def _joined(pieces: Sequence[Points], bridges: Sequence[int]) -> Points:
    """Concatenate columns, interpolating ``bridges[i]`` - 1 rows between piece i and the next."""
    parts = [pieces[0]]
    for before, after, steps in zip(pieces[:-1], pieces[1:], bridges, strict=True):
        parts += [np.linspace(before[-1], after[0], steps + 1)[1:-1], after]
    return np.concatenate(parts)
