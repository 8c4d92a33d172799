"""Incremental local online Gaussian mixture regression."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from signimit.policies.base import check_demonstrations
from signimit.policies.gaussian_mixture import fit_mixture, regress, within_speed
from signimit.policies.ilo_gmr import STEPS, ILOGMRPolicy


def test_it_is_the_regression_of_a_mixture_fitted_to_the_nearest_points(shown: Callable[..., Any]) -> None:
    policy = ILOGMRPolicy.learn(check_demonstrations(*shown("circle")[:2]))
    for hand in np.random.default_rng(0).uniform(-0.12, 0.12, (5, 2)):
        near = policy.data[np.argsort(np.hypot(*(policy.data[:, :2] - hand).T), kind="stable")[:50]]
        away = near[:, 2:] - near[:, 2:].mean(axis=0)
        side = away @ np.linalg.svd(away)[2][0] > 0
        mixture = fit_mixture(near, np.column_stack([side, ~side]).astype(float), STEPS)
        expected = within_speed(regress(mixture, hand[None]), policy.limit)[0]
        np.testing.assert_allclose(policy(hand), expected, atol=1e-6)


def test_on_a_straight_line_at_one_speed_it_is_the_demonstration() -> None:
    times = 0.02 * np.arange(80)
    line = np.column_stack([0.5 * times, 0.2 * times])
    policy = ILOGMRPolicy.learn(check_demonstrations([line], [times]))
    np.testing.assert_allclose(policy(line[40]), [0.5, 0.2], atol=1e-3)
