"""Baselines find what is planted, and all answer in the same form."""

import numpy as np
import pytest
from numpy.typing import NDArray

pytest.importorskip("sklearn", reason="the baselines need scikit-learn")

from signimit.benchmark.studies.conditions import compose_study_session, study_condition
from signimit.benchmark.studies.methods import BASELINES, CLUSTERINGS, SharedDistances, infer
from signimit.grouping import canonical_labels

TRUTH = np.array([0, 0, 1, 2, 1, 2, 0, 1, 2])


def planted() -> NDArray[np.float64]:
    """γ of 30 within groups, 1 between, with a little noise."""
    rng = np.random.default_rng(0)
    noise = rng.uniform(0.9, 1.1, (9, 9))
    gamma = np.where(TRUTH[:, None] == TRUTH[None], 30.0, 1.0) * np.sqrt(noise * noise.T)
    np.fill_diagonal(gamma, 0.0)
    return np.asarray(gamma)


@pytest.mark.parametrize("name", CLUSTERINGS)
def test_planted_groups_are_found(name: str) -> None:
    np.testing.assert_array_equal(canonical_labels(CLUSTERINGS[name](planted(), 3, 0)), TRUTH)


@pytest.fixture(scope="module")
def distances() -> SharedDistances:
    return SharedDistances(compose_study_session(study_condition(2, 2, 1), 0), 0)


@pytest.mark.parametrize("method", BASELINES)
def test_every_baseline_answers_and_answers_the_same_again(distances: SharedDistances, method: str) -> None:
    first, again = infer(distances, method), infer(distances, method)
    assert first.labels.shape == first.focus.shape == (4,)
    assert set(first.word_order) == {0, 1}
    np.testing.assert_array_equal(first.labels, again.labels)
    np.testing.assert_array_equal(first.focus, again.focus)
    assert set(first.labels.tolist()) == set(range(first.labels.max() + 1))
