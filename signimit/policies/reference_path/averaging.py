"""Mean of many passes over one reference path, in position and in time.

DTW barycentre averaging (Petitjean et al. 2011, doi:10.1016/j.patcog.2010.09.013) for courses that repeat: aligned
points are averaged node by node, so corners meet corners and stay sharp. A pass that is unlike the course counts less.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.paths import TimedPath, arc_lengths
from signimit.policies.base import Array
from signimit.policies.reference_path.alignment import FARTHEST_GAP

ALIKE = 0.07  # half sizes from the course; rounds of one hand are 0.05 to 0.08 from it, of strangers 0.12 to 0.3


class Pass(NamedTuple):
    """One round of one demonstration; NaN where it did not go.

    Attributes:
        points: Position at each node, shape (M, 2), m.
        speeds: Speed from each node to the next, shape (M,), m/s.
    """

    points: Array
    speeds: Array


class MeanPass(NamedTuple):
    """What passes have in common.

    Attributes:
        points: Mean position at each node, shape (M, 2), m.
        speeds: Mean speed from each node to the next, shape (M,), m/s; zero where nobody showed it.
        support: Weight of the passes through each node, shape (M,).
    """

    points: Array
    speeds: Array
    support: Array


def cut_passes(path: TimedPath, phases: NDArray[np.int64], nodes: int, shortest: float = 0.0) -> Iterator[Pass]:
    """Cut an aligned demonstration into its rounds.

    Args:
        path: The demonstration.
        phases: Node of each point, shape (n,), as `align_phases` gives them.
        nodes: Number of nodes M of the course.
        shortest: Share of a round that makes a pass; less is left out.
    """
    first, points, pace = _by_phase(path, phases)
    last = first + len(points) - 1
    for start in range(first - first % nodes, last + 1, nodes):
        low, high = max(first, start), min(last, start + nodes - 1)
        if high - low + 1 < shortest * nodes:
            continue
        position, speeds = np.full((nodes, 2), np.nan), np.full(nodes, np.nan)
        position[low - start : high - start + 1] = points[low - first : high - first + 1]
        shown = pace[low - first : high - first + 1]  # one less at the end of the drawing
        speeds[low - start : low - start + len(shown)] = shown
        yield Pass(position, speeds)


def _by_phase(path: TimedPath, phases: NDArray[np.int64]) -> tuple[int, Array, Array]:
    """Return the first phase, positions at it and every phase after, and the speed from each to the next."""
    drawn = phases >= 0
    first, offset = int(phases[drawn][0]), phases[drawn] - phases[drawn][0]
    count = np.bincount(offset)
    known = np.flatnonzero(count)
    every, at = np.arange(len(count), dtype=np.float64), known.astype(np.float64)
    values = (*path.points[drawn].T, path.times[drawn], arc_lengths(path.points)[drawn])
    x, y, stamps, way = (np.interp(every, at, np.bincount(offset, v)[known] / count[known]) for v in values)
    return first, np.stack([x, y], axis=1), np.diff(_smooth(way)) / np.diff(_smooth(stamps))


def _smooth(rising: Array) -> Array:
    """Average over up to five nodes: the grid's noise goes, the slowing at corners stays."""
    width = min(2, len(rising) - 1)
    padded = np.pad(rising, width, mode="reflect", reflect_type="odd") if width else rising
    smooth: Array = np.convolve(padded, np.full(2 * width + 1, 1 / (2 * width + 1)), mode="valid")
    return smooth


def mean_pass(passes: Sequence[Pass], course: Array, unit: float, closed: bool) -> MeanPass:
    """Average passes node by node, one that is unlike the course with less weight; leave out what few passed.

    The weight is Gaussian in the distance, so a course that is averaged again and again moves to where passes are dense
    (mean shift, Comaniciu and Meer 2002, doi:10.1109/34.1000236): with drawings of one hand that is their mean, with
    drawings by strangers, whose mean nobody drew, it is the drawing that the course began with.

    Args:
        passes: Rounds of the course, at least one.
        course: The nodes that they were aligned with, shape (M, 2), m.
        unit: Half size of the movement, m.
        closed: Whether rounds follow each other. If not, each pass should go all the way, a node that it does not pass
            counts as far, and ends that fewer than half of the passes, by weight, reach are no part of the course.

    Returns:
        The mean, at most M nodes.
    """
    points = np.array([p.points for p in passes])
    speeds = np.array([p.speeds for p in passes])
    seen, timed = np.isfinite(points[..., 0]), np.isfinite(speeds)
    gaps = np.where(seen, np.hypot(*np.moveaxis(points - course, -1, 0)), 0.0 if closed else FARTHEST_GAP * unit)
    apart = gaps.sum(axis=1) / (seen.sum(axis=1) if closed else len(course)) / (ALIKE * unit)
    weights = np.exp(-0.5 * (apart**2 - apart.min() ** 2))[:, None]
    support = (weights * seen).sum(axis=0)
    total = (weights[..., None] * np.where(seen[..., None], points, 0.0)).sum(axis=0)
    paced = (weights * np.where(timed, speeds, 0.0)).sum(axis=0)
    tiny = np.finfo(np.float64).tiny
    mean = total / np.maximum(support, tiny)[:, None]
    pace = paced / np.maximum((weights * timed).sum(axis=0), tiny)
    kept = support > tiny
    if not closed:
        reached = np.flatnonzero(support >= min(0.5 * weights.sum(), support.max()))
        kept[: reached[0]] = kept[reached[-1] + 1 :] = False
    return MeanPass(mean[kept], pace[kept], support[kept])
