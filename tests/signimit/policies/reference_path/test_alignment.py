"""Phases by dynamic programming, against every reading tried."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.paths import unit_tangents
from signimit.policies.reference_path.alignment import (
    ADVANCE_COSTS,
    DIRECTION_WEIGHT,
    FARTHEST_GAP,
    REACH_COST,
    align_phases,
)


def cheapest_reading(path: NDArray[np.float64], course: NDArray[np.float64], closed: bool, scale: float) -> float:
    """Try all beginnings, endings, first nodes and advances."""
    n, m = len(path), len(course)
    u, v = unit_tangents(path, False), unit_tangents(course, closed)
    local = [
        [
            min(float(np.hypot(*(p - q))) / scale, FARTHEST_GAP) + DIRECTION_WEIGHT * (1 - a @ b)
            for q, b in zip(course, v, strict=True)
        ]
        for p, a in zip(path, u, strict=True)
    ]
    best = np.inf
    for begin, node in product(range(n), range(m)):
        for end in range(begin, n) if closed else [n - 1]:
            for advances in product(range(len(ADVANCE_COSTS)), repeat=end - begin):
                nodes = node + np.concatenate([[0], np.cumsum(advances)]).astype(int)
                if not closed and nodes[-1] >= m:
                    continue
                drawn = sum(local[begin + i][k % m] for i, k in enumerate(nodes))
                moved = sum(ADVANCE_COSTS[k] for k in advances)
                best = min(best, REACH_COST * (begin + n - 1 - end) + drawn + moved)
    return float(best)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_the_cost_is_that_of_the_cheapest_reading_of_all(seed: int, closed: bool) -> None:
    rng = np.random.default_rng(seed)
    path, course = rng.normal(size=(5, 2)), rng.normal(size=(3, 2))
    (alignment,) = align_phases([path], course, closed, 1.0)
    assert alignment.cost == pytest.approx(cheapest_reading(path, course, closed, 1.0))


def circle(rounds: float, nodes: int = 40, radius: float = 0.1) -> NDArray[np.float64]:
    angles = 2 * np.pi * np.arange(int(rounds * nodes)) / nodes
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def test_a_reach_then_two_rounds_are_counted_on() -> None:
    reach = np.column_stack([np.linspace(0.4, 0.11, 12), np.full(12, 0.0)])
    path = np.concatenate([reach, circle(2.0)])
    (alignment,) = align_phases([path], circle(1.0), True, 0.1)
    assert (alignment.phases[:10] == -1).all()
    np.testing.assert_array_equal(alignment.phases[12:], np.arange(80))


def test_paths_of_different_lengths_are_aligned_as_each_alone() -> None:
    paths = [circle(2.0), circle(1.4) * 1.1, circle(0.7)[::-1]]
    together = align_phases(paths, circle(1.0), True, 0.1)
    for path, alignment in zip(paths, together, strict=True):
        (alone,) = align_phases([path], circle(1.0), True, 0.1)
        np.testing.assert_array_equal(alone.phases, alignment.phases)
        assert alone.cost == pytest.approx(alignment.cost)


def test_an_open_course_is_never_gone_round() -> None:
    (alignment,) = align_phases([circle(2.0)], circle(1.0), False, 0.1)
    assert alignment.phases.max() < 40
