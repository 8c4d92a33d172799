"""Alignment of demonstrations with a reference path: the phase of each point, by dynamic programming.

A course is a polyline of M nodes, closed (the movement repeats) or open (it ends at a goal). A demonstration is
read as a *reach* that follows no course, then a *drawing* whose phase moves along the nodes, round and round if the
course is closed; a closed drawing may also be left again. The cheapest reading is found exactly, as a
hidden Markov model's best path would be (Viterbi); with one pass it is dynamic time warping with a free beginning.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from signimit.paths import unit_tangents
from signimit.policies.base import Array

# Costs of a point, all in half sizes.
FARTHEST_GAP = 0.64  # a wrong member or a slip of the pen costs no more than this a point
DIRECTION_WEIGHT = 0.2  # of 1 - cos of the angle between the directions of motion
REACH_COST = 0.36  # a point of the reach; a drawn point is about 0.12, one that only crosses the course 0.48
ADVANCE_COSTS = (0.016, 0.0, 0.016, 0.048)  # of moving on by 0, 1, 2, 3 nodes from one point to the next


class PhaseAlignment(NamedTuple):
    """How one demonstration follows a course.

    Attributes:
        phases: Node of each point, counting on past M in every further round, shape (n,); -1 in the reach.
        cost: Sum over the points.
    """

    phases: NDArray[np.int64]
    cost: float


def align_phases(paths: Sequence[Array], course: Array, closed: bool, unit: float) -> list[PhaseAlignment]:
    """Find the phase of every point of every path.

    Args:
        paths: Positions at equal steps of length, each of shape (n, 2), m.
        course: Nodes at the same steps, shape (M, 2), m.
        closed: Whether the last node is followed by the first.
        unit: Half size of the movement, m: the unit of a gap.
    """
    costs = _accumulate(_local_costs(paths, course, closed, unit), closed)
    return [_trace(costs[:, d], len(path), closed) for d, path in enumerate(paths)]


def _local_costs(paths: Sequence[Array], course: Array, closed: bool, unit: float) -> Array:
    """Return the cost of each point at each node, shape (n, D, M); zero after a path's end."""
    local = np.zeros((max(map(len, paths)), len(paths), len(course)))
    tangents = unit_tangents(course, closed)
    for d, path in enumerate(paths):
        gaps = cdist(path, course) / unit
        turned = 1.0 - unit_tangents(path) @ tangents.T
        local[: len(path), d] = np.minimum(gaps, FARTHEST_GAP) + DIRECTION_WEIGHT * turned
    return local


def _accumulate(local: Array, closed: bool) -> Array:
    """Return the cheapest sum up to each point of each path at each node, shape (n, D, M)."""
    before = np.arange(local.shape[2]) - np.arange(len(ADVANCE_COSTS))[:, None]  # (K, M)
    charge = np.array(ADVANCE_COSTS)[:, None] + (0.0 if closed else np.where(before < 0, np.inf, 0.0))
    costs = local.copy()
    for t in range(1, len(local)):
        options = np.take(costs[t - 1], before, axis=1, mode="wrap")  # (D, K, M)
        options += charge
        costs[t] += np.minimum(options.min(axis=1), REACH_COST * t)
    return costs


def _trace(costs: Array, length: int, closed: bool) -> PhaseAlignment:
    """Walk back from the cheapest end of one path; an open course is followed to the path's last point."""
    ends = costs[:length].min(axis=1) + REACH_COST * np.arange(length - 1, -1, -1.0)
    last = int(ends.argmin()) if closed else length - 1
    t, phase, nodes = last, int(costs[last].argmin()), costs.shape[1]
    phases = np.full(length, -1, dtype=np.int64)
    phases[t] = phase
    while t > 0:
        row, reach = costs[t - 1], REACH_COST * t
        options = [
            row[(phase - k) % nodes] + charge if closed or phase >= k else np.inf
            for k, charge in enumerate(ADVANCE_COSTS)
        ]
        cheapest = min(options)
        if cheapest > reach:
            break
        t, phase = t - 1, phase - options.index(cheapest)
        phases[t] = phase
    phases[t : last + 1] -= phase - phase % nodes
    return PhaseAlignment(phases, float(ends[last]))
