"""Overshoots: a stroke runs past its own beginning, comes back and goes on. Nobody means them; they are cut out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.policies.arclength import unit_tangents
from signimit.policies.protocol import Array

CLOSE = 0.1  # half sizes between the two ends of an overshoot
ALIKE = 0.8  # cos of the angle between the directions at its two ends, at least
BACKWARD = -0.5  # cos of the angle between the direction at its beginning and the way back, at most
LONGEST = 0.6  # half sizes, out and back; what is larger may be meant
SLIM = 0.02  # area enclosed over squared length, at most; a circle has 0.08, a line drawn out and back 0


def without_overshoot(course: Array, scale: float) -> NDArray[np.intp]:
    """Return which nodes of a closed course to keep: all but those of its longest overshoot.

    An overshoot leaves a place, turns back, and passes the same place in the same direction again. A spike that is
    drawn out and back, the tip of a star, ends in another direction than it began in and stays.

    Args:
        course: Nodes at equal steps of length, shape (M, 2), m.
        scale: Half size of the movement, m.
    """
    nodes = len(course)
    tangents = unit_tangents(course, closed=True)
    step = float(np.hypot(*np.diff(course, axis=0).T).mean())
    turns = np.concatenate([[0.0], np.cumsum(_cross(np.tile(course, (2, 1))[:-1], np.tile(course, (2, 1))[1:]))])
    every, back = np.arange(nodes), np.ones(nodes)
    start, longest = 0, 0
    for lag in range(1, min(int(LONGEST * scale / step), nodes // 2)):
        other = (every + lag) % nodes
        cosine = (tangents * tangents[other]).sum(axis=1)
        back = np.minimum(back, cosine)
        area = np.abs(turns[every + lag] - turns[every] + _cross(course[other], course)) / 2
        gaps = np.hypot(*(course - course[other]).T)
        slim = area < SLIM * (lag * step) ** 2
        found = np.flatnonzero((gaps < CLOSE * scale) & (cosine > ALIKE) & (back < BACKWARD) & slim)
        if len(found):
            start, longest = int(found[gaps[found].argmin()]), lag
    return np.delete(every, (start + 1 + np.arange(max(longest - 1, 0))) % nodes)


def _cross(a: Array, b: Array) -> Array:
    product: Array = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product
