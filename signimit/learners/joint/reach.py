"""Where the reach ends and the drawing begins: a drawing comes back to where it was, a reach does not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.paths import arc_lengths, half_size, resample_path, step_lengths, unit_tangents

_SAMPLES = 200
_NEAR = 0.3  # half sizes; nearer than this, in the same direction, is a return
_APART = 2.0  # half sizes of way that must lie between a place and its return
_LONGEST_REACH = 0.7  # share of the way; a reach longer than this leaves too little to call a drawing


def find_drawing_start(path: NDArray[np.float64]) -> int:
    """Find the first sample of the drawing in a demonstrated path.

    Each point is marked that the path passes again, as near as 0.3 of the drawing's half size and in about the same
    direction; the drawing begins where marks become the rule. A path that never returns is all drawing: it may be a
    movement made once, and nothing tells its reach from it.

    Args:
        path: Hand positions, shape (T, 2), any unit, at least two of them different.

    Returns:
        Index of the first sample of the drawing, 0 if the whole path is drawing.
    """
    points = resample_path(path, _SAMPLES)
    returns = _returns(points, half_size(points[_SAMPLES // 3 :]))
    surplus = np.concatenate([[0], np.cumsum(np.where(returns, 1, -1))])
    start = int(np.argmin(surplus[: int(_LONGEST_REACH * _SAMPLES)]))
    if returns[start:].mean() < 0.5:
        return 0
    way = arc_lengths(path)
    first = int(np.searchsorted(way, start / _SAMPLES * way[-1]))
    return min(first, len(path) - 2)


def _returns(points: NDArray[np.float64], unit: float) -> NDArray[np.bool_]:
    """Mark the points, shape (n, 2), that the path comes back to; ``unit`` is the drawing's half size."""
    if unit == 0.0:
        return np.zeros(len(points), dtype=bool)
    state = np.column_stack([points / (_NEAR * unit), unit_tangents(points)])
    squares = (state * state).sum(axis=1)
    gaps = squares[:, None] - 2 * state @ state.T + squares
    step = step_lengths(points).sum() / len(points)
    number = np.arange(len(points))
    apart = np.abs(number[:, None] - number[None]) * step > _APART * unit
    return np.asarray(np.where(apart, gaps, np.inf).min(axis=1) < 1.0)
