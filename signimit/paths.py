"""Geometry of paths in the plane: lengths, resampling, directions, sizes, nearest points and angles.

A path is an array of positions in order, shape (T, 2), T at least 1, in any one unit of length; results are in the same
unit. Nothing here looks at time, except `space_timed_path`, and nothing writes to its arguments.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_BLOCK = 2**16  # numbers of a distance block: small enough for the second-level cache
_AT_REST = 1e-12  # added to a step's length before it is divided by: a resting hand has no direction, not NaN
_STILL = 1e-9  # share of a path's length below which a step is a pause
_FEWEST_STEPS, _MOST_STEPS = 4, 10_000  # that a path is cut into by spacing


class TimedPath(NamedTuple):
    """A path and when each of its points was passed.

    Attributes:
        points: Positions, shape (n, 2), m.
        times: When the hand passed them, shape (n,), s.
    """

    points: Array
    times: Array


def step_lengths(points: Array) -> Array:
    """Compute the distance from each point of a path, shape (T, 2), to the next, shape (T - 1,)."""
    return np.asarray(np.hypot(*np.diff(points, axis=0).T))


def arc_lengths(points: Array) -> Array:
    """Compute the length of a path, shape (T, 2), up to each of its points, shape (T,); the first is 0."""
    return np.concatenate([[0.0], np.cumsum(step_lengths(points))])


def half_size(points: Array) -> float:
    """Compute half of the larger extent of a drawing's bounding box.

    The one unit in which gaps are compared with the drawing they belong to. It is the same wherever the drawing lies,
    and changes by at most a factor of √2 when the drawing is turned.

    Args:
        points: Positions, shape (T, 2).

    Returns:
        The half size, 0 if all points are one.
    """
    return float(np.ptp(points, axis=0).max() / 2)


def box_centre(points: Array) -> Array:
    """Compute the middle of the bounding box of points, shape (T, 2); returns shape (2,)."""
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)


def interpolate(at: Array, known: Array, points: Array) -> Array:
    """Interpolate positions linearly over any rising parameter: time, way, or a mixture.

    Args:
        at: Where positions are wanted, shape (n,); outside of ``known`` they are those of its ends.
        known: The parameter at each point, shape (T,), not falling.
        points: Positions, shape (T, 2).

    Returns:
        Positions, shape (n, 2).
    """
    return np.stack([np.interp(at, known, points[:, axis]) for axis in (0, 1)], axis=1)


def resample_path(points: Array, samples: int) -> Array:
    """Resample a path, shape (T, 2), to points evenly spaced along its length, shape (samples, 2); ends stay."""
    lengths = arc_lengths(points)
    return interpolate(np.linspace(0.0, lengths[-1], samples), lengths, points)


def space_path(points: Array, spacing: float, closed: bool = False, most: int = _MOST_STEPS) -> Array:
    """Resample a path to about equal steps of its own length.

    Args:
        points: Positions, shape (T, 2).
        spacing: Wanted length of a step; the path is cut into the nearest whole number of them, at least four.
        closed: Whether the last point is followed by the first, which the result then does not repeat.
        most: Largest number of steps.

    Returns:
        Positions, shape (steps, 2) of a closed path, (steps + 1, 2) of an open one.
    """
    line = np.concatenate([points, points[:1]]) if closed else points
    lengths = arc_lengths(line)
    even = _even_lengths(lengths[-1], spacing, most)
    return interpolate(even[:-1] if closed else even, lengths, line)


def space_timed_path(points: Array, times: Array, spacing: float, most: int = _MOST_STEPS) -> TimedPath:
    """Resample an open path, shape (T, 2), with its times, shape (T,), as `space_path` does.

    A pause takes time and no way: it belongs to the step after it.
    """
    lengths = arc_lengths(points)
    moving = np.concatenate([[True], np.diff(lengths) > _STILL * lengths[-1]])
    even = _even_lengths(lengths[-1], spacing, most)
    return TimedPath(
        interpolate(even, lengths[moving], points[moving]), np.interp(even, lengths[moving], times[moving])
    )


def _even_lengths(length: float, spacing: float, most: int) -> Array:
    steps = int(np.clip(np.rint(length / spacing), _FEWEST_STEPS, most))
    return np.linspace(0.0, length, steps + 1)


def unit_tangents(points: Array, closed: bool = False) -> Array:
    """Compute the directions of motion along a path by central differences.

    Args:
        points: Positions, shape (T, 2), T at least 2, in a unit in which 1e-12 is nothing.
        closed: Whether the last point is followed by the first.

    Returns:
        Unit vectors, shape (T, 2); zero where the hand rests.
    """
    steps = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0) if closed else np.gradient(points, axis=0)
    return np.asarray(steps / (np.linalg.norm(steps, axis=1, keepdims=True) + _AT_REST))


def headings(vectors: Array) -> Array:
    """Compute the angles of vectors, shape (..., 2), to the x axis, counter-clockwise, shape (...), in [-π, π] rad."""
    return np.asarray(np.arctan2(vectors[..., 1], vectors[..., 0]))


def wrap_angles(angles: Array) -> Array:
    """Bring angles of any shape, rad, into [-π, π] by whole turns."""
    return np.asarray((angles + np.pi) % (2 * np.pi) - np.pi)


def nearest_points(queries: Array, points: Array) -> NDArray[np.intp]:
    """Find the nearest of a few thousand points to each query, by one matrix product and one search a block.

    Args:
        queries: Positions, shape (Q, 2).
        points: Positions to choose from, shape (n, 2), n at least 1.

    Returns:
        Index of the nearest point, shape (Q,); of equally near ones the first, up to rounding.
    """
    centre = points.mean(axis=0)  # |p - q|² is least where |p|² - 2 p·q is, which cancels badly far from the origin
    local = points - centre
    target = np.vstack([-2.0 * local.T, (local * local).sum(1)])
    nearest = np.empty(len(queries), dtype=np.intp)
    rows = max(1, _BLOCK // len(points))
    padded = np.column_stack([queries - centre, np.ones(len(queries))])
    buffer = np.empty((rows, len(points)))
    for start in range(0, len(queries), rows):
        block = padded[start : start + rows]
        values = np.matmul(block, target, out=buffer[: len(block)])
        values.argmin(axis=1, out=nearest[start : start + rows])
    return nearest


def nearest_distances(queries: Array, points: Array) -> Array:
    """Compute the distance from each query, shape (Q, 2), to the nearest of points, shape (n, 2); returns (Q,)."""
    return np.asarray(np.hypot(*(queries - points[nearest_points(queries, points)]).T))
