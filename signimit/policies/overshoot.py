"""Overshoots: a stroke runs past its own beginning, comes back and goes on. Nobody means them; they are cut out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.policies.arclength import unit_tangents
from signimit.policies.protocol import Array

CLOSE = 0.1  # half sizes between the two ends of an overshoot
ALIKE = 0.7  # cos of the angle between the directions at its two ends, at least
BACKWARD = -0.5  # cos of the angle between the direction at its beginning and the way back, at most
LONGEST = 0.25  # of the course


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
    every, back = np.arange(nodes), np.ones(nodes)
    start, longest = 0, 0
    for lag in range(1, int(LONGEST * nodes)):
        other = (every + lag) % nodes
        cosine = (tangents * tangents[other]).sum(axis=1)
        back = np.minimum(back, cosine)
        gaps = np.hypot(*(course - course[other]).T)
        found = np.flatnonzero((gaps < CLOSE * scale) & (cosine > ALIKE) & (back < BACKWARD))
        if len(found):
            start, longest = int(found[gaps[found].argmin()]), lag
    return np.delete(every, (start + 1 + np.arange(max(longest - 1, 0))) % nodes)
