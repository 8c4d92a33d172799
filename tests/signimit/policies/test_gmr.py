"""Gaussian mixture regression and its local, online kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from signimit.policies.base import check_demonstrations
from signimit.policies.gmr import GMRPolicy, position_velocity

TIMES = 0.02 * np.arange(100)
LINE = np.column_stack([0.4 * TIMES, np.zeros(100)])


def test_a_straight_line_needs_one_component() -> None:
    noisy = LINE + np.random.default_rng(0).normal(0, 1e-3, LINE.shape)
    policy = GMRPolicy.learn(check_demonstrations([noisy], [TIMES]))
    assert len(policy.weights) == 1
    np.testing.assert_allclose(policy([0.4, 0.0]), [0.4, 0.0], atol=0.05)


def test_a_movement_needs_several(shown: Callable[..., Any]) -> None:
    policy = GMRPolicy.learn(check_demonstrations(*shown("square")[:2]))
    assert len(policy.weights) >= 4


def test_the_demonstrated_speed_is_never_exceeded(shown: Callable[..., Any]) -> None:
    policy = GMRPolicy.learn(check_demonstrations(*shown("star")[:2]))
    hands = np.random.default_rng(0).uniform(-3, 3, (500, 2))
    assert np.hypot(*policy(hands).T).max() <= policy.limit * (1 + 1e-9)


def test_velocities_are_those_of_the_demonstration() -> None:
    data = position_velocity(check_demonstrations([LINE, LINE[::-1]], [TIMES] * 2))
    assert data.shape == (200, 4)
    np.testing.assert_allclose(np.abs(data[:, 2]), 0.4)
    assert data[:, 2].sum() == pytest.approx(0)
