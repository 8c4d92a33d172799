"""The paper's policy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import FrozenInstanceError
from typing import Any

import numpy as np
import pytest

from signimit.exceptions import InvalidInputError
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


@pytest.mark.parametrize("tremor", [0.0, 1e-9], ids=["still", "trembling by a nanometre"])
@pytest.mark.parametrize("size", [1.0, 1e-3])
def test_a_resting_hand_has_no_direction(tremor: float, size: float) -> None:
    resting = tremor * np.random.default_rng(0).normal(size=(30, 2))
    path = np.concatenate([resting, np.column_stack([0.01 * np.arange(1, 31), np.zeros(30)])])
    policy = KNearestPolicy.learn(check_demonstrations([size * path], [STEP * np.arange(60)]))
    assert len(policy.points) == 31
    assert policy.speed == pytest.approx(0.5 * size, rel=0.03)


def test_a_policy_keeps_copies_that_nobody_writes_to() -> None:
    points, directions = np.zeros((3, 2)), np.tile([1.0, 0.0], (3, 1))
    policy = KNearestPolicy(points, directions, 0.5)
    points[:], directions[:] = 9.0, 9.0
    np.testing.assert_array_equal(policy([0.0, 0.0]), [0.5, 0.0])
    with pytest.raises(ValueError, match="read-only"):
        policy.points[0] = 1.0
    with pytest.raises(InvalidInputError, match="policy: directions: expected finite numbers"):
        KNearestPolicy(points, directions * np.nan, 0.5)


def test_a_policy_is_one_thing_that_can_be_looked_up_and_not_changed() -> None:
    made = [KNearestPolicy(np.zeros((3, 2)), np.tile([1.0, 0.0], (3, 1)), 0.5) for _ in range(2)]
    assert {made[0]: 0, made[1]: 1}[made[0]] == 0
    assert repr(made[0]) == "KNearestPolicy(points=<3x2>, directions=<3x2>, speed=0.5)"
    with pytest.raises(FrozenInstanceError):
        made[0].speed = 1.0  # type: ignore[misc]
