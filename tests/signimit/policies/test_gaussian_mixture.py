"""Gaussian mixtures, against definitions and scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from signimit.policies.gaussian_mixture import (
    Mixture,
    bayesian_information,
    fit_mixture,
    log_joint,
    maximise,
    regress,
    softmax,
    within_speed,
)

RNG = np.random.default_rng(0)
DATA = np.concatenate([RNG.normal(m, 0.3, (60, 4)) for m in ([0, 0, 1, 0], [2, 1, 0, -1])])
SIDES = np.eye(2)[np.repeat([0, 1], 60)]


def likelihood(mixture: Mixture) -> float:
    densities = [w * multivariate_normal(m, c).pdf(DATA) for w, m, c in zip(*mixture, strict=True)]
    return float(np.log(np.sum(densities, axis=0)).sum())


def test_joint_densities_are_scipys() -> None:
    mixture = maximise(DATA, SIDES)
    for k in range(2):
        expected = np.log(mixture.weights[k]) + multivariate_normal(mixture.means[k], mixture.covariances[k]).logpdf(
            DATA
        )
        np.testing.assert_allclose(log_joint(mixture, DATA)[:, k], expected, atol=1e-9)


def test_expectation_maximisation_only_gains_likelihood() -> None:
    first = np.eye(2)[RNG.integers(2, size=120)]
    gains = [likelihood(fit_mixture(DATA, first, steps)) for steps in range(0, 30, 3)]
    assert (np.diff(gains) > -0.1).all()
    assert gains[-1] > gains[0] + 1


def test_bic_is_schwarzs_and_prefers_the_true_number() -> None:
    two = maximise(DATA, SIDES)
    assert bayesian_information(two, DATA) == pytest.approx(29 * np.log(120) - 2 * likelihood(two))
    one = maximise(DATA, np.ones((120, 1)))
    assert bayesian_information(two, DATA) < bayesian_information(one, DATA)


def test_regression_with_one_component_is_least_squares() -> None:
    mixture = maximise(DATA, np.ones((120, 1)))
    design = np.column_stack([np.ones(120), DATA[:, :2]])
    lines, *_ = np.linalg.lstsq(design, DATA[:, 2:], rcond=None)
    hands = DATA[:5, :2]
    np.testing.assert_allclose(regress(mixture, hands), np.column_stack([np.ones(5), hands]) @ lines, atol=0.02)


def test_regression_says_far_away_what_it_says_where_trust_ends() -> None:
    mixture = maximise(DATA, np.ones((120, 1)))
    far = regress(mixture, np.array([[100.0, 50.0], [1e6, 5e5]]))
    np.testing.assert_allclose(far[0], far[1], rtol=0.05)


def test_a_batch_of_mixtures_is_each_mixture_alone() -> None:
    data = np.stack([DATA, DATA[::-1] * 2])
    together = fit_mixture(data, np.stack([SIDES, SIDES]), 3)
    for i in range(2):
        alone = fit_mixture(data[i], SIDES, 3)
        for a, b in zip(together, alone, strict=True):
            np.testing.assert_allclose(a[i], b, atol=1e-9)


def test_shares_sum_to_one_however_unlikely() -> None:
    np.testing.assert_allclose(softmax(np.array([-1e5, -1e5 - 1.0])).sum(), 1.0)


def test_a_collapsed_component_stays_finite() -> None:
    mixture = fit_mixture(np.zeros((20, 4)), np.eye(2)[np.arange(20) % 2], 5)
    assert np.isfinite(regress(mixture, np.ones((3, 2)))).all()


def test_speed_is_shortened_and_never_lengthened() -> None:
    np.testing.assert_allclose(
        within_speed(np.array([[3.0, 4.0], [0.3, 0.4], [0.0, 0.0]]), 1.0),
        [[0.6, 0.8], [0.3, 0.4], [0.0, 0.0]],
    )
