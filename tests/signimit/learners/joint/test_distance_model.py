"""Distances of signs as evidence: bounded, monotone, and worked by hand."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import norm

from signimit.learners.joint.distance_model import SIGNS, DistanceModel

AKIN = replace(SIGNS, akin_share=0.2, akin_mean=-0.6, akin_spread=0.15)
MODELS = pytest.mark.parametrize("model", [SIGNS, AKIN], ids=["signs", "akin"])
HAND = DistanceModel(equal_mean=0.0, equal_spread=1.0, other_mean=2.0, other_spread=1.0, odd_share=1e-9)
properties = settings(deadline=None, derandomize=True, max_examples=30)


@MODELS
@properties
@given(mean=st.floats(-2.5, 0.5))
def test_farther_is_never_more_equal(model: DistanceModel, mean: float) -> None:
    ratios = model.log_ratios(np.exp(np.linspace(-6, 4, 400)), mean)
    assert (np.diff(ratios) <= 1e-12).all()


@MODELS
@properties
@given(mean=st.floats(-2.5, 0.5))
def test_no_distance_says_more_than_odd_ones_and_chance_allow(model: DistanceModel, mean: float) -> None:
    ratios = model.log_ratios(np.array([0.0, 1e-12, 0.1, 1.0, 10.0, 1e12]), mean)
    assert np.isfinite(ratios).all()
    assert ratios.min() >= np.log(model.odd_share)
    assert ratios.max() <= -np.log(model.chance_share)


@MODELS
def test_typical_equals_speak_for_and_typical_others_against(model: DistanceModel) -> None:
    equal, other = model.log_ratios(np.exp([model.equal_mean, model.other_mean]), model.equal_mean)
    assert equal > 1
    assert other < -0.9


def test_the_ratio_of_two_normal_densities_is_that_of_the_hand() -> None:
    sure = replace(HAND, chance_share=1e-9)
    # -x²/2 + (x - 2)²/2 = 2 - 2x
    np.testing.assert_allclose(sure.log_ratios(np.exp([0.0, 0.5, 1.0, 2.0]), 0.0), [2, 1, 0, -2], atol=1e-6)
    np.testing.assert_allclose(sure.log_ratios(np.exp([-5.0, 9.0]), 0.0), [2, -2], atol=1e-6)


@MODELS
@properties
@given(mean=st.floats(-2.5, 0.5), seed=st.integers(0, 10_000))
def test_ratios_are_those_of_the_densities(model: DistanceModel, mean: float, seed: int) -> None:
    """Two mixtures of normal densities of the logarithm, which is held between the typical equal and other."""
    distances = np.exp(np.random.default_rng(seed).normal(-0.5, 1.0, 50))
    logs = np.clip(np.log(distances), mean, max(mean, model.other_mean))
    equal = norm.pdf(logs, mean, model.equal_spread)
    akin = norm.pdf(logs, model.akin_mean, model.akin_spread)
    other = (1 - model.akin_share) * norm.pdf(logs, model.other_mean, model.other_spread) + model.akin_share * akin
    odd, chance = model.odd_share, model.chance_share
    expected = np.log((1 - odd) * equal + odd * other) - np.log((1 - chance) * other + chance * equal)
    np.testing.assert_allclose(model.log_ratios(distances, mean), expected, atol=1e-5)
