"""The parts of a demonstrated path: the reach, the drawing, and the way home."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.paths import arc_lengths, half_size
from signimit.validation import finite_array

Array = NDArray[np.float64]

_SMOOTHED = 0.04  # s over which a speed is averaged: a hand's tremor is no stop
_TYPICAL = 0.75  # quantile of the speed that counts as that of a moving hand
_STOP = 0.4  # of that speed, or of the fastest since the last stop: a minimum below it is a stop
_STRAIGHT = 0.95  # of a way's length between its ends: a reach, or a way home, in one go
_BENT = 0.85  # the same of a reach that is a curve: the first stop of a path ends it
_HOME = 0.25  # half sizes between the path's ends, within which the hand went back to where it was
_SHORTEST_HOME = 0.1  # half sizes; less is the end of a stroke, not a way


def find_drawing(path: ArrayLike, times: ArrayLike) -> slice:
    """Find the drawing in a demonstrated path: what is left without the reach and the way home.

    A hand stops where a reach ends: its speed has a minimum there, far below that of a moving hand. What comes before
    the first stop is the reach if it is about straight. What comes after the last stop is the way home if it is
    straight and ends where the path began. If what is left is a straight line, nothing is taken away: the first and the
    last side of a triangle are straight as well.

    Args:
        path: Hand positions, shape (T, 2), any unit.
        times: Time stamps, shape (T,), s, strictly increasing.

    Returns:
        The samples of the drawing: at least two, and moving if the path moves.

    Raises:
        InvalidInputError: If the arrays are not finite, or of other shapes.
    """
    points = finite_array(path, "path", (None, 2))
    stamps = finite_array(times, "times", (len(points),))
    stops = find_stops(points, stamps)
    begin, end = 0, len(points)
    if not len(stops):
        return slice(begin, end)
    if _straightness(points[: stops[0] + 1]) > _BENT:
        begin = int(stops[0])
    unit = half_size(points[begin:])
    last = stops[stops > begin]
    if len(last) and np.linalg.norm(points[-1] - points[0]) < _HOME * unit:
        home = points[last[-1] :]
        if _straightness(home) > _STRAIGHT and arc_lengths(home)[-1] > _SHORTEST_HOME * unit:
            end = int(last[-1]) + 1
    left = points[begin:end]
    if len(left) < 3 or not np.ptp(left, axis=0).any() or _straightness(left) > _STRAIGHT:
        return slice(0, len(points))
    return slice(begin, end)


def find_stops(path: Array, times: Array) -> NDArray[np.intp]:
    """Find where a hand stops: minima of its smoothed speed far below the speed of a moving hand, or of the way before.

    Args:
        path: Hand positions, shape (T, 2), any unit.
        times: Time stamps, shape (T,), s.

    Returns:
        Indices, without the first and the last sample, shape (S,).
    """
    if len(path) < 3:
        return np.zeros(0, dtype=np.intp)
    speed = np.hypot(*np.gradient(path, times, axis=0).T)
    width = 2 * round(_SMOOTHED / float(np.median(np.diff(times))) / 2) + 1
    width = min(width, 2 * ((len(path) - 1) // 2) - 1)
    if width > 1:
        speed = np.convolve(np.pad(speed, width // 2, "edge"), np.full(width, 1 / width), "valid")
    low = _STOP * float(np.quantile(speed, _TYPICAL))
    dips = np.flatnonzero((speed[1:-1] <= speed[:-2]) & (speed[1:-1] < speed[2:])) + 1
    stops: list[int] = []
    for dip in dips:
        fastest = speed[stops[-1] if stops else 0 : dip].max()
        if speed[dip] < max(low, _STOP * fastest):
            stops.append(int(dip))
    return np.array(stops, dtype=np.intp)


def _straightness(path: Array) -> float:
    """Share of a way's length that lies between its ends; 0 for a way that does not move."""
    length = float(arc_lengths(path)[-1])
    return float(np.linalg.norm(path[-1] - path[0])) / length if length > 0 else 0.0
