"""Recordings of pens, and strokes made of them: pieces of movement, joined where the pen was up."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.paths import step_lengths
from signimit.strokes import Stroke, StrokeLibrary
from signimit.validation import finite_array

MOST_STEPS = 1000  # of a bridge
SAMPLE_TIME = 0.01  # s, between points of recordings without time stamps


class PenRecording(NamedTuple):
    """One recorded drawing.

    Attributes:
        pieces: Where the pen was while down, each of shape (T_i, 2), y up.
        stamps: When, each of shape (T_i,), s; none if the device did not say.
        label: What was drawn.
        writer: Who drew it.
        where: File and place in it, for errors.
    """

    pieces: Sequence[NDArray[np.float64]]
    stamps: Sequence[NDArray[np.float64]] | None
    label: str
    writer: str
    where: str


def library_from_recordings(recordings: Sequence[PenRecording], source: str) -> StrokeLibrary:
    """Make each recording one stroke.

    Raises:
        FileFormatError: Names the recording that is no stroke.
    """
    strokes = tuple(stroke_from_recording(recording) for recording in recordings)
    return StrokeLibrary(strokes, tuple(r.label for r in recordings), tuple(r.writer for r in recordings), source)


def stroke_from_recording(recording: PenRecording) -> Stroke:
    """Join the pieces of a recording, with a straight line of about the median step where the pen was up.

    Points without time stamps, and those of the bridges between them, are taken to be 10 ms apart. With stamps, a
    bridge takes the time that the pen was up. Stamps that repeat, as coarse clocks do, share the time to the next one.

    Raises:
        FileFormatError: If the recording has no points, does not move, or its clock runs backwards.
    """
    try:
        pieces = [finite_array(piece, "points", (None, 2)) for piece in recording.pieces if len(piece)]
        if not pieces:
            raise InvalidInputError("points", "at least 2", "none")
        bridges = [_bridge_steps(pieces, i) for i in range(len(pieces) - 1)]
        points = _joined(pieces, bridges)
        if recording.stamps is None:
            times = SAMPLE_TIME * np.arange(len(points), dtype=np.float64)
        else:
            stamps = [np.asarray(stamp, dtype=np.float64)[:, None] for stamp in recording.stamps if len(stamp)]
            times = spread_ties(_joined(stamps, bridges)[:, 0])
        return Stroke(points, times - times[0])
    except InvalidInputError as error:
        raise FileFormatError(f"{recording.where}: {error.where}", error.expected, error.found) from None


def _bridge_steps(pieces: Sequence[NDArray[np.float64]], i: int) -> int:
    """Return in how many steps the gap after piece i is crossed."""
    steps = step_lengths(np.concatenate(pieces))
    median = float(np.median(steps)) or float(steps.max())
    gap = float(np.linalg.norm(pieces[i + 1][0] - pieces[i][-1]))
    return max(1, int(min(gap / median, MOST_STEPS)))


def _joined(pieces: Sequence[NDArray[np.float64]], bridges: Sequence[int]) -> NDArray[np.float64]:
    """Concatenate columns, interpolating ``bridges[i]`` - 1 rows between piece i and the next."""
    parts = [pieces[0]]
    for before, after, steps in zip(pieces[:-1], pieces[1:], bridges, strict=True):
        parts += [np.linspace(before[-1], after[0], steps + 1)[1:-1], after]
    return np.concatenate(parts)


def spread_ties(stamps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give equal time stamps, shape (T,), equal shares of the time to the next one, 1 ms for the last.

    Raises:
        InvalidInputError: If the clock runs backwards.
    """
    stamps = finite_array(stamps, "time stamps", (None,))
    back = np.flatnonzero(np.diff(stamps) < 0)
    if len(back):
        i = int(back[0])
        raise InvalidInputError("time stamps", "a clock that runs forward", f"{stamps[i]:g} s then {stamps[i + 1]:g} s")
    values, first, counts = np.unique(stamps, return_index=True, return_counts=True)
    gaps = np.append(np.diff(values), 0.001)
    rank = np.arange(len(stamps)) - np.repeat(first, counts)
    return np.asarray(stamps + rank * np.repeat(gaps / counts, counts), dtype=np.float64)
