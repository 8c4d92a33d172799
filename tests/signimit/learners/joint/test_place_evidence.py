"""A place where all drawings lie tells the focus; where there is none, nothing is told."""

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.learners.joint.place_evidence import CERTAINTY, common_place_evidence

Array = NDArray[np.float64]
TABLE = np.array([0.22, 0.18])


def scenes(rng: np.random.Generator, count: int = 12) -> Array:
    return np.asarray(rng.uniform(-1, 1, (count, 3, 2)) * TABLE)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.05, 0.1)])
def test_a_common_place_is_found_wherever_it_is(seed: int, offset: tuple[float, float]) -> None:
    rng = np.random.default_rng(seed)
    objects, focus = scenes(rng), rng.integers(0, 3, 12)
    centres = objects[np.arange(12), focus] + offset + rng.normal(0, 0.005, (12, 2))
    evidence = common_place_evidence(centres, objects)
    np.testing.assert_array_equal(evidence.argmax(axis=1), focus)
    assert (evidence[np.arange(12), focus] > 3).all()


@pytest.mark.parametrize("seed", range(5))
def test_drawings_anywhere_say_little_for_any_object(seed: int) -> None:
    rng = np.random.default_rng(seed)
    evidence = common_place_evidence(rng.uniform(-1, 1, (12, 2)) * TABLE, scenes(rng))
    assert evidence.max() < 3


def test_evidence_of_places_is_bounded() -> None:
    rng = np.random.default_rng(0)
    objects = scenes(rng)
    assert np.abs(common_place_evidence(objects[:, 0], objects)).max() <= CERTAINTY


def test_a_shift_of_the_table_changes_nothing_and_a_permutation_only_the_order() -> None:
    rng = np.random.default_rng(1)
    objects = scenes(rng)
    centres = objects[:, 1] + rng.normal(0, 0.01, (12, 2))
    evidence, order = common_place_evidence(centres, objects), rng.permutation(12)
    shift = np.array([0.3, -0.2])
    shifted = common_place_evidence(centres + shift, objects + shift)
    np.testing.assert_allclose(shifted, evidence, atol=1e-6)
    np.testing.assert_allclose(common_place_evidence(centres[order], objects[order]), evidence[order], atol=1e-6)


def test_two_objects_at_one_place_share_its_evidence() -> None:
    rng = np.random.default_rng(2)
    objects = scenes(rng)
    objects[3, 1] = objects[3, 0]
    evidence = common_place_evidence(objects[:, 0], objects)
    assert evidence[3, 0] == pytest.approx(evidence[3, 1])


def test_one_demonstration_and_one_object_are_enough_to_say_something_finite() -> None:
    assert np.isfinite(common_place_evidence(np.zeros((1, 2)), np.zeros((1, 1, 2)))).all()
