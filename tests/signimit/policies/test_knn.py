"""The paper's policy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from signimit.policies.base import check_demonstrations
from signimit.policies.knn import KNearestPolicy

STEP = 0.02


def test_it_is_the_mean_direction_of_the_fifty_nearest_points(shown: Callable[..., Any]) -> None:
    paths, times, _ = shown("star", 3)
    policy = KNearestPolicy.learn(check_demonstrations(paths, times))
    for hand in np.random.default_rng(0).uniform(-0.2, 0.2, (20, 2)):
        nearest = sorted(range(len(policy.points)), key=lambda i: float(np.hypot(*(policy.points[i] - hand))))[:50]
        directions = [policy.directions[i] for i in nearest]
        np.testing.assert_allclose(policy(hand), policy.speed * np.mean(directions, axis=0), atol=1e-12)


def test_on_a_straight_line_at_one_speed_it_is_the_demonstration() -> None:
    line = np.column_stack([0.5 * STEP * np.arange(80), np.zeros(80)])
    policy = KNearestPolicy.learn(check_demonstrations([line], [STEP * np.arange(80)]))
    np.testing.assert_allclose(policy([0.3, 0.1]), [0.5, 0.0], atol=1e-12)


def test_opposite_directions_cancel_as_they_do_in_the_paper() -> None:
    line = np.column_stack([0.5 * STEP * np.arange(40), np.zeros(40)])
    policy = KNearestPolicy.learn(check_demonstrations([line, line[::-1]], [STEP * np.arange(40)] * 2))
    assert np.hypot(*policy(line[20])) < 0.05


def test_a_resting_hand_has_no_direction() -> None:
    rest = np.concatenate([np.zeros((30, 2)), np.column_stack([0.01 * np.arange(1, 31), np.zeros(30)])])
    policy = KNearestPolicy.learn(check_demonstrations([rest], [STEP * np.arange(60)]))
    assert len(policy.points) == 31
