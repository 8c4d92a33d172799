"""Paths by the way travelled instead of by time: pauses vanish, corners stay."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from signimit.policies.base import Array
from signimit.strokes import Stroke


class SpacedPath(NamedTuple):
    """A path at equal steps of its own length.

    Attributes:
        points: Positions, shape (n, 2), m.
        times: When the hand passed them, shape (n,), s; a pause belongs to the step after it.
    """

    points: Array
    times: Array


def arc_lengths(points: Array) -> Array:
    """Return the way travelled up to each point, shape (T,), m."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    return np.concatenate([[0.0], np.cumsum(steps)])


def space_path(stroke: Stroke, spacing: float, most: int = 10_000) -> SpacedPath:
    """Resample a timed path at about equal steps of ``spacing`` metres, at least four and at most ``most`` of them."""
    lengths = arc_lengths(stroke.points)
    moving = np.concatenate([[True], np.diff(lengths) > 1e-9 * lengths[-1]])
    even = np.linspace(0.0, lengths[-1], int(np.clip(np.rint(lengths[-1] / spacing), 4, most)) + 1)
    return SpacedPath(
        interpolate(even, lengths[moving], stroke.points[moving]),
        np.interp(even, lengths[moving], stroke.times[moving]),
    )


def space_course(points: Array, spacing: float, closed: bool, most: int = 10_000) -> Array:
    """Resample a course at about equal steps of ``spacing`` metres; a closed one does not repeat its first point."""
    line = np.concatenate([points, points[:1]]) if closed else points
    lengths = arc_lengths(line)
    even = np.linspace(0.0, lengths[-1], int(np.clip(np.rint(lengths[-1] / spacing), 4, most)) + 1)
    return interpolate(even[:-1] if closed else even, lengths, line)


def interpolate(at: Array, known: Array, points: Array) -> Array:
    """Interpolate positions, shape (n, 2), linearly over any rising parameter."""
    return np.stack([np.interp(at, known, points[:, axis]) for axis in (0, 1)], axis=1)


def unit_tangents(points: Array, closed: bool) -> Array:
    """Return directions of motion by central differences, shape (n, 2); zero where there is none."""
    steps = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0) if closed else np.gradient(points, axis=0)
    tangents: Array = steps / np.maximum(np.hypot(*steps.T), 1e-12)[:, None]
    return tangents
