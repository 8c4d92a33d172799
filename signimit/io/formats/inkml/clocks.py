"""When the points of a trace were drawn: channel T, time stamps, and what traces say of their start and duration.

InkML 1.1, sections 3.1.8 and 7: T counts from the time stamp that ``respectTo`` names, else from the beginning of its
trace; ``timeOffset`` and ``duration`` of a trace are in milliseconds, its offset counts from its context's time stamp.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal, NamedTuple
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from signimit.io.formats.inkml.context import Context, Contexts
from signimit.io.formats.inkml.trace_format import read_number
from signimit.io.formats.pen_clock import relative_seconds
from signimit.io.formats.pen_recording import SAMPLE_TIME

_NEARLY = 0.02  # s: a clock that begins this near its trace's offset counts from the same moment as the offset
Stamps = NDArray[np.float64]


class TraceClock(NamedTuple):
    """What a file says of the time of a trace.

    Attributes:
        seconds: Seconds in a step of T; none if T is missing or counts ticks of unknown length.
        origin: The moment from which T, or else the offset, counts, s; none if unknown.
        relative: Whether T counts from the beginning of the trace, as far as the file says.
        offset: When the trace began, s after the origin; none if it does not say.
        duration: How long it took, s; none if it does not say.
        sample_time: Seconds between points, where nothing else says it.
    """

    seconds: float | None
    origin: float | None
    relative: bool
    offset: float | None
    duration: float | None
    sample_time: float


class TimedPiece(NamedTuple):
    """Points of a trace, and what is known of their time.

    Attributes:
        trace: The trace.
        clock: What the file says of its time.
        steps: Numbers of the points in their trace, shape (T,), T > 0.
        length: How many points the trace has.
        ticks: Values of T, shape (T,), in steps of the clock, NaN where not reported; none without the channel.
    """

    trace: Element
    clock: TraceClock
    steps: NDArray[np.intp]
    length: int
    ticks: Stamps | None


class DrawingTimes(NamedTuple):
    """Time stamps of a drawing, as a `PenRecording` has them.

    Attributes:
        stamps: Of each piece, shape (T_i,), s, none where it has none; none if no piece has any.
        clock: ``"own"`` if each piece counts from its own beginning, and nothing says when that was.
        paced: Whether the pace within pieces is assumed.
    """

    stamps: Sequence[Stamps | None] | None
    clock: Literal["shared", "own"] = "shared"
    paced: bool = False


def read_clock(trace: Element, context: Context, contexts: Contexts) -> TraceClock:
    """Read what a trace and its context say of time.

    Raises:
        FileFormatError: If T has a unit that is not one of time.
    """
    channel = context.layout.channel("T")
    reference = None if channel is None else channel.respect_to
    offset, duration = (read_number(trace.get(name)) for name in ("timeOffset", "duration"))
    return TraceClock(
        seconds=None if channel is None else context.layout.seconds,
        origin=contexts.time(reference) if reference else context.start,
        relative=not reference,
        offset=None if offset is None else offset / 1000,
        duration=duration / 1000 if duration and duration > 0 else None,
        sample_time=context.sample_time or SAMPLE_TIME,
    )


def find_times(pieces: Sequence[TimedPiece]) -> DrawingTimes:
    """Put the pieces of a drawing on one clock, as far as the file says how."""
    ticks = [_filled(piece) for piece in pieces]
    ticking = [(piece, values) for piece, values in zip(pieces, ticks, strict=True) if values is not None]
    if not ticking:
        return _times_from_offsets(pieces)
    shifts, own = _tick_shifts(ticking)
    unit, waiting = ticking[0][0].clock.seconds or 1.0, iter(shifts)
    moved = [
        None if values is None else values * ((piece.clock.seconds or 1.0) / unit) + next(waiting) / unit
        for piece, values in zip(pieces, ticks, strict=True)
    ]
    return DrawingTimes(relative_seconds(moved, unit), "own" if own else "shared")


def _tick_shifts(ticking: Sequence[tuple[TimedPiece, Stamps]]) -> tuple[list[float], bool]:
    """Return how much later than the first each piece's clock begins, s, and whether that is unknown."""
    clocks = [piece.clock for piece, _ in ticking]
    starts, ends = ([(p.clock.seconds or 1.0) * float(ticks[i]) for p, ticks in ticking] for i in (0, -1))
    shifts = _origin_shifts(clocks)
    several = len({piece.trace for piece, _ in ticking}) > 1
    relative = all(clock.relative for clock in clocks)
    if not any(clock.offset for clock in clocks):
        return shifts, several and relative and not any(starts) and not any(shifts)
    counted = all(
        abs(start - clock.offset) <= _NEARLY for start, clock in zip(starts, clocks, strict=True) if clock.offset
    )
    placed = [(start + shift, end + shift) for start, end, shift in zip(starts, ends, shifts, strict=True)]
    anew = several and any(later < end for (_, end), (later, _) in pairwise(placed))
    if not counted and (relative or anew):
        shifts = [shift + (clock.offset or 0.0) for shift, clock in zip(shifts, clocks, strict=True)]
    return shifts, False


def _filled(piece: TimedPiece) -> Stamps | None:
    """Return values of T with those that were not reported put on the line between those that were."""
    if piece.ticks is None or piece.clock.seconds is None:
        return None
    known = np.flatnonzero(~np.isnan(piece.ticks))
    if len(known) == len(piece.ticks):
        return piece.ticks
    if not len(known):
        return None
    first, last = known[0], known[-1]
    pace = piece.clock.sample_time / piece.clock.seconds
    if last > first:
        pace = (piece.ticks[last] - piece.ticks[first]) / (piece.steps[last] - piece.steps[first])
    filled = np.interp(piece.steps, piece.steps[known], piece.ticks[known])
    before = np.minimum(piece.steps - piece.steps[first], 0)
    after = np.maximum(piece.steps - piece.steps[last], 0)
    return np.asarray(filled + pace * (before + after), dtype=np.float64)


def _origin_shifts(clocks: Sequence[TraceClock]) -> list[float]:
    """Return how much later than the first each clock's origin is, s; nothing if one is unknown."""
    origins = [clock.origin for clock in clocks if clock.origin is not None]
    if len(origins) < len(clocks):
        return [0.0] * len(clocks)
    return [origin - origins[0] for origin in origins]


def _times_from_offsets(pieces: Sequence[TimedPiece]) -> DrawingTimes:
    """Space the points of each trace evenly from when it began; at an assumed pace only if the traces then fit."""
    clocks = [piece.clock for piece in pieces]
    if all(clock.offset is None and clock.duration is None for clock in clocks):
        return DrawingTimes(None)
    shifts = _origin_shifts(clocks)
    stamps = list[Stamps]()
    for piece, shift in zip(pieces, shifts, strict=True):
        pace = piece.clock.sample_time
        if piece.clock.duration is not None and piece.length > 1:
            pace = piece.clock.duration / (piece.length - 1)
        start = (piece.clock.offset or 0.0) + shift
        stamps.append(start + pace * piece.steps.astype(np.float64))
    paced = any(clock.duration is None for clock in clocks)
    own = len({p.trace for p in pieces}) > 1 and all(clock.offset is None for clock in clocks)
    following = sorted(stamps, key=lambda piece: float(piece[0]))
    if paced and (own or any(later[0] <= earlier[-1] for earlier, later in pairwise(following))):
        return DrawingTimes(None)
    return DrawingTimes(stamps, "own" if own else "shared", paced)
