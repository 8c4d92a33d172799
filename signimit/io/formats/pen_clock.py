"""Clocks of pen recordings: stamps are made relative, steps back are repaired, and a clock that cannot be one is known.

A device's clock is read in two places or corrected while it runs, traces have clocks of their own, and files say
milliseconds where they mean seconds. What is sane is judged against what a hand can do and a pen is sampled at.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.io.formats.import_report import Finding
from signimit.validation import LEAST_STEP, finite_array, told_apart

MAX_STEP_BACK = 0.016  # s: one tick of the coarsest clock in use, the 64 Hz timer of Windows; more is no jitter
LEAST_DURATION = 0.01  # s: no hand draws anything in less,
LEAST_INTERVAL = 0.0005  # s, mean: nor is it sampled more often (mice up to 1 kHz, pens up to 400 Hz),
FAST_DURATION = 0.1  # s: nor draws it anything in less that is sampled more often than once in
FAST_INTERVAL = 0.004  # s, mean
SLOW_DURATION = 120.0  # s with the pen down: nor draws it for longer if it is sampled less often than once in
SLOW_INTERVAL = 0.2  # s, mean
_ROUNDING = 1e-6  # s, by which stamps may miss a bound: milliseconds since 1970 as a float of seconds are as coarse
_STEP_BACK = f"time stamps that step back by {1000 * MAX_STEP_BACK:g} ms or less: lifted to the one before"
_OVERLAP = "pieces whose clock begins anew or overlaps: put behind the one before"
Stamps = NDArray[np.float64]


class PieceTimes(NamedTuple):
    """When the pieces of a drawing were drawn.

    Attributes:
        order: Numbers of the pieces, in the order in which they were drawn.
        stamps: Time stamps of each piece in that order, shape (T_i,), s, that do not run backwards within a piece; none
            if there is no usable clock.
        own: Whether each piece has a clock of its own.
        findings: What was repaired or assumed.
    """

    order: Sequence[int]
    stamps: Sequence[Stamps] | None
    own: bool = False
    findings: Sequence[Finding] = ()


def relative_seconds(stamps: Sequence[Stamps | None], unit: float) -> list[Stamps | None]:
    """Turn the stamps of a drawing's pieces into seconds since the first of them.

    Done before anything is multiplied: milliseconds since 1970 leave a float little room for what is between them.

    Args:
        stamps: Time stamps of each piece, shape (T_i,), as the file has them; none where a piece has none.
        unit: Seconds in a unit of them.
    """
    arrays = [None if piece is None else np.asarray(piece, dtype=np.float64) for piece in stamps]
    start = next((piece[0] for piece in arrays if piece is not None and len(piece)), 0.0)
    with np.errstate(all="ignore"):  # what is not finite is refused with its drawing's name
        return [None if piece is None else (piece - start) * unit for piece in arrays]


def piece_times(
    stamps: Sequence[Stamps | None], counts: Sequence[int], own: bool, sample_time: float, where: str
) -> PieceTimes:
    """Find out what the stamps of a drawing's pieces are worth.

    Args:
        stamps: Time stamps of each piece, shape (T_i,), s; none where it has none.
        counts: How many points each piece has, at least one.
        own: Whether it is known that each piece has a clock of its own.
        sample_time: Time between points without stamps, s.
        where: File and drawing, for what is found.

    Raises:
        InvalidInputError: If a stamp is not finite, the clock steps back by more than jitter, or stamps are missing.
    """
    given_order = list(range(len(counts)))
    pace = f"points taken to be {1000 * sample_time:g} ms apart"
    if all(piece is None for piece in stamps):
        return PieceTimes(given_order, None, findings=[Finding(where, f"no time stamps: {pace}", kind="assumed")])
    findings = []
    raw, lifted = list[Stamps](), list[Stamps]()
    for piece, count in zip(relative_seconds(stamps, 1.0), counts, strict=True):
        if piece is None:
            own, piece = True, sample_time * np.arange(count, dtype=np.float64)
            findings.append(Finding(where, f"a piece without time stamps: {pace}", kind="assumed"))
        elif len(piece) != count:
            raise InvalidInputError("time stamps", f"as many as points, {count}", f"{len(piece)}")
        raw.append(piece)
        lifted.append(_lifted(piece))
    if why := _why_no_clock(lifted):
        return PieceTimes(given_order, None, findings=[Finding(where, f"{why}: {pace}")])
    if moved := sum(int((before != after).sum()) for before, after in zip(raw, lifted, strict=True)):
        findings.append(Finding(where, _STEP_BACK, moved))
    order = given_order if own else _order_in_time(lifted)
    if order != given_order:
        findings.append(Finding(where, "pieces that were out of order: put in the order of their clock"))
    own = own or (len(lifted) > 1 and len({float(piece[0]) for piece in lifted}) == 1)
    return PieceTimes(order, [lifted[i] for i in order], own, findings)


def place_pieces(
    stamps: Sequence[Stamps], own: bool, gaps: Sequence[float], where: str
) -> tuple[list[Stamps], list[Finding]]:
    """Shift each piece that begins before the one before it ended, or all if each has a clock of its own.

    A piece that begins less than 16 ms early is not shifted: its first stamps are lifted.

    Args:
        stamps: Time stamps of each piece, shape (T_i,), T_i > 0, that do not run backwards within it, s.
        own: Whether each piece has a clock of its own.
        gaps: Time to leave before each piece but the first if it is shifted, s.
        where: File and drawing, for what is found.
    """
    placed, shifted, lifted = [stamps[0]], 0, 0
    for piece, gap in zip(stamps[1:], gaps, strict=True):
        end = float(placed[-1][-1])
        if own or end - piece[0] > MAX_STEP_BACK + _ROUNDING:
            placed.append(piece - piece[0] + end + gap)
            shifted += 1
        else:
            placed.append(np.maximum(piece, end))
            lifted += int((piece < end).sum())
    findings = [Finding(where, _OVERLAP, shifted)] if shifted else []
    return placed, findings + ([Finding(where, _STEP_BACK, lifted)] if lifted else [])


def mean_interval(stamps: Sequence[Stamps]) -> float:
    """Return the mean time between two points of the same piece, s; 0 if no piece has two.

    Args:
        stamps: Time stamps of each piece, shape (T_i,), T_i > 0, that do not run backwards.
    """
    steps = sum(len(piece) - 1 for piece in stamps)
    return float(sum(piece[-1] - piece[0] for piece in stamps)) / max(steps, 1)


def _lifted(stamps: Stamps) -> Stamps:
    """Lift stamps that step back a little to the latest one before them."""
    stamps = finite_array(stamps, "time stamps", (None,))
    latest = np.maximum.accumulate(stamps)
    back = np.flatnonzero(latest - stamps > MAX_STEP_BACK + _ROUNDING)
    if len(back):
        i = int(back[0])
        expected = f"a clock that runs forward, or at most {1000 * MAX_STEP_BACK:g} ms back (or no time stamps at all)"
        found = f"{latest[i]:.3f} s and then {stamps[i]:.3f} s after the first, at point {i}"
        raise InvalidInputError("time stamps", expected, found)
    return latest


def _order_in_time(stamps: Sequence[Stamps]) -> list[int]:
    """Return the order in which pieces follow each other on one clock, or the given one if they overlap in either."""
    given = list(range(len(stamps)))
    for order in (given, sorted(given, key=lambda i: float(stamps[i][0]))):
        if all(stamps[b][0] >= stamps[a][-1] - MAX_STEP_BACK - _ROUNDING for a, b in pairwise(order)):
            return order
    return given


def _why_no_clock(stamps: Sequence[Stamps]) -> str:
    """Say why stamps cannot be those of a hand that drew, as far as durations tell; nothing if they can."""
    if all(len(piece) == 1 for piece in stamps):
        stamps = [np.sort(np.concatenate(stamps))]
    interval = mean_interval(stamps)
    duration = interval * sum(len(piece) - 1 for piece in stamps)
    if duration == 0:
        return "a clock that stands still"
    if (
        duration < LEAST_DURATION - _ROUNDING
        or interval < LEAST_INTERVAL - _ROUNDING
        or (duration < FAST_DURATION - _ROUNDING and interval < FAST_INTERVAL - _ROUNDING)
    ):
        return "a clock too fast for a hand, as of seconds read as milliseconds"
    if duration > SLOW_DURATION and interval > SLOW_INTERVAL:
        return "a clock too slow for a hand, as of nanoseconds read as milliseconds"
    return ""


def spread_ties(stamps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give equal time stamps, shape (T,), equal shares of the time to the next one, 1 ms for the last.

    Stamps less than a nanosecond apart are equal: what differs there is rounding.

    Raises:
        InvalidInputError: If the clock runs backwards.
    """
    stamps = finite_array(stamps, "time stamps", (None,))
    back = np.flatnonzero(np.diff(stamps) < 0)
    if len(back):
        i = int(back[0])
        first, second = told_apart(stamps[i], stamps[i + 1])
        raise InvalidInputError("time stamps", "a clock that runs forward", f"{first} s then {second} s")
    apart = np.diff(stamps, prepend=-np.inf) >= LEAST_STEP
    stamps = np.maximum.accumulate(np.where(apart, stamps, -np.inf))
    values, starts, counts = np.unique(stamps, return_index=True, return_counts=True)
    gaps = np.append(np.diff(values), 0.001)
    rank = np.arange(len(stamps)) - np.repeat(starts, counts)
    return np.asarray(stamps + rank * np.repeat(gaps / counts, counts), dtype=np.float64)
