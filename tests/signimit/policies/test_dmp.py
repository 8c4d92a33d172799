"""Dynamic movement primitives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from signimit.policies.base import CONTROL_PERIOD, check_demonstrations
from signimit.policies.dmp import BASES, DMPPolicy


def drive(policy: DMPPolicy, hands: NDArray[np.float64], steps: int) -> NDArray[np.float64]:
    path, state = [hands], policy.start()
    for _ in range(steps):
        state, velocity = policy.step(state, path[-1])
        path.append(path[-1] + CONTROL_PERIOD * velocity)
    return np.array(path)


@pytest.mark.parametrize("label", ["circle", "square", "figure eight"])
def test_it_reaches_the_drawing_then_repeats_it(label: str, shown: Callable[..., Any]) -> None:
    policy = DMPPolicy.learn(check_demonstrations(*shown(label)[:2]))
    assert policy.weights.shape == (BASES, 2)
    hands = np.random.default_rng(0).uniform(-0.4, 0.4, (20, 2))
    path = drive(policy, hands, 500)[250:]
    gaps = cdist(path.reshape(-1, 2), policy.course)
    assert gaps.min(axis=1).mean() < 0.1 * policy.half_size
    assert gaps.min(axis=0).max() < 0.3 * policy.half_size


@pytest.mark.parametrize("start", [[0.3, 0.2], [-0.3, 0.0], [0.0, 0.0]])
def test_a_discrete_primitive_ends_at_its_goal(start: list[float], shown: Callable[..., Any]) -> None:
    policy = DMPPolicy.learn(check_demonstrations(*shown("reach from the left")[:2]))
    path = drive(policy, np.array(start), 500)
    np.testing.assert_allclose(path[-1], policy.course[-1], atol=1e-3)


def test_a_hand_that_is_held_slows_the_phase(shown: Callable[..., Any]) -> None:
    policy = DMPPolicy.learn(check_demonstrations(*shown("circle")[:2]))
    state, hand = policy.start(), policy.course[0]
    for _ in range(50):
        state, _ = policy.step(state, hand)
    assert state.phases is not None
    assert float(state.phases) < 0.8 * 50 / len(policy.course)
