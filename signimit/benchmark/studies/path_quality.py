"""Measures of how well a policy draws what was shown."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from signimit.evaluation import PathJudge
from signimit.paths import half_size, nearest_distances, nearest_points, resample_path, step_lengths
from signimit.policies.base import CONTROL_PERIOD, Array
from signimit.policies.closed_loop import Advance, count_steps, move_exactly

REACHED = 0.15  # half sizes from the drawing at which a detour ends
FAR = 0.5  # half sizes from the drawing that a detour begins at, at least
BACK = 0.25  # half sizes from the nearest drawn loop within which a shoved hand is back
CORNER_POINTS = 10  # farthest-out of 200 points of a loop


class PathQuality(NamedTuple):
    """Measures of one hand's path; NaN where a measure does not apply.

    Attributes:
        misfit: Path error of `signimit.evaluation`, in half sizes.
        corner_gap: Mean gap from the first loop's farthest-out points to the settled path, in half sizes.
        detour: Way travelled to the drawing over the straight way.
        speed_correlation: Between the hand's speed and the demonstrators' at the same places.
        speed_ratio: The hand's mean speed over the demonstrators' at the same places.
        draws: Whether the path counts as the movement for `signimit.performed`.
    """

    misfit: float
    corner_gap: float
    detour: float
    speed_correlation: float
    speed_ratio: float
    draws: bool


def shove_half_way(shove: Array, seconds: float) -> Advance:
    """Return how points move that do as they are told, but for one shove half way.

    Args:
        shove: What is then added to each hand, shape (B, 2), m.
        seconds: How long they move in all.
    """
    period, half_way = itertools.count(), count_steps(seconds) // 2

    def advance(hands: Array, velocities: Array) -> Array:
        moved = move_exactly(hands, velocities)
        return moved + shove if next(period) == half_way else moved

    return advance


def judge_path(path: Array, loops: Sequence[Array]) -> PathQuality:
    """Judge one hand's path, shape (n, 2), by the loops that were shown, each (T, 2), all in the object's frame."""
    performance = PathJudge([loops]).judge(path, np.zeros((1, 2)))
    if performance.movement < 0:
        return PathQuality(performance.misfit, np.nan, np.nan, np.nan, np.nan, False)
    settled = path[len(path) // 3 :]
    gap, way, speed = corner_gap(settled, loops[0]), detour(path, loops[0]), speed_agreement(settled, loops)
    return PathQuality(performance.misfit, gap, way, *speed, True)


def corner_gap(settled: Array, loop: Array) -> float:
    """Return how far the path stays from the loop's farthest-out points, in half sizes."""
    points = resample_path(loop, 200)
    corners = points[np.argsort(-np.hypot(*points.T))[:CORNER_POINTS]]
    return float(nearest_distances(corners, settled).mean() / half_size(loop))


def detour(path: Array, loop: Array) -> float:
    """Return the way to the loop over the straight way; NaN for a hand that began near it."""
    unit = half_size(loop)
    gaps = nearest_distances(path, resample_path(loop, 200))
    if gaps[0] <= FAR * unit:
        return float("nan")
    reached = gaps < REACHED * unit
    arrival = int(reached.argmax()) if reached.any() else len(path) - 1
    return float(step_lengths(path[: arrival + 1]).sum() / gaps[0])


def speed_agreement(settled: Array, loops: Sequence[Array]) -> tuple[float, float]:
    """Return correlation and ratio of the hand's speed and the demonstrators' mean speed at the same places."""
    speed = step_lengths(settled) / CONTROL_PERIOD
    theirs = np.zeros(len(speed))
    for loop in loops:
        pace = np.hypot(*np.gradient(loop, CONTROL_PERIOD, axis=0).T)
        theirs += pace[nearest_points(settled[:-1], loop)] / len(loops)
    if np.std(speed) == 0 or np.std(theirs) == 0:
        return float("nan"), float(speed.mean() / theirs.mean())
    return float(np.corrcoef(speed, theirs)[0, 1]), float(speed.mean() / theirs.mean())


def back_after_shove(path: Array, loops: Sequence[Array]) -> Array:
    """Return which hands, shoved half way, are on a drawn loop for the second after the next, shape (B,), 0 or 1."""
    begin = (len(path) - 1) // 2 + round(1.0 / CONTROL_PERIOD)
    window = path[begin : begin + round(1.0 / CONTROL_PERIOD)]
    gaps = nearest_distances(window.reshape(-1, 2), np.concatenate(loops)).reshape(window.shape[:-1])
    return np.asarray((gaps < BACK * half_size(loops[0])).all(axis=0), dtype=np.float64)


def arrives_and_stays(path: Array, goal: Array, tolerance: float) -> Array:
    """Return which hands are within ``tolerance`` metres of the goal for the last third, shape (B,), 0 or 1."""
    gaps: Array = np.hypot(*np.moveaxis(path[2 * len(path) // 3 :] - goal, -1, 0))
    return np.asarray((gaps < tolerance).all(axis=0), dtype=np.float64)
