"""Signs compared with signs, and utterances read."""

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import InvalidInputError, WordOrder
from signimit.learners.base import Understanding
from signimit.learners.joint.sign_distance import VocabularyReader, cross_sign_distances, sign_distances, sign_features
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def digits() -> list[Array]:
    """Three ones, three twos and three threes of one person."""
    library = synthetic_library(("1", "2", "3"), samples=3, rng=np.random.default_rng(0))
    return [stroke.points for stroke in library.strokes]


def slow_distance(p: Array, q: Array) -> float:
    """The mean distance to the nearest sample, both ways, none counting for more than 1.2."""
    there = np.mean([min(1.2, *(np.linalg.norm(u - v) for v in q)) for u in p])
    back = np.mean([min(1.2, *(np.linalg.norm(u - v) for u in p)) for v in q])
    return float((there + back) / 2)


def reader(signs: list[Array], objects: int = 3) -> VocabularyReader:
    features = sign_features(signs)
    meaning = np.repeat([0, 1, 2], 3)
    return VocabularyReader((features, features), Understanding(meaning, meaning, WordOrder(0, 1)), objects)


def test_the_distance_of_signs_is_that_of_plain_loops(digits: list[Array]) -> None:
    features = sign_features(digits)
    slow = [[slow_distance(p, q) for p in features[::2]] for q in features[::2]]
    np.testing.assert_allclose(sign_distances(features)[::2, ::2], slow, rtol=1e-6, atol=1e-6)


def test_where_and_how_large_a_sign_is_made_does_not_matter(digits: list[Array]) -> None:
    moved = [1000 * sign + [5.0, -3.0] for sign in digits]
    np.testing.assert_allclose(sign_features(moved), sign_features(digits), atol=1e-9)


def test_a_stroke_more_makes_it_less_of_another_sign_than_another_sign_is() -> None:
    stem = np.linspace([0.0, 1.0], [0.0, -1.0], 40)
    with_base = np.concatenate(
        [stem, np.linspace([0.0, -1.0], [-0.6, -1.0], 10), np.linspace([-0.6, -1.0], [0.6, -1.0], 15)]
    )
    arc = np.linspace(0.8 * np.pi, -0.2 * np.pi, 30)
    head = np.column_stack([0.5 * np.cos(arc), 0.5 + 0.5 * np.sin(arc)])
    two = np.concatenate([head, np.linspace(head[-1], [-0.6, -1.0], 25), np.linspace([-0.6, -1.0], [0.6, -1.0], 15)])
    to_itself, to_stem, to_two = sign_distances(sign_features([with_base, stem, two]))[0]
    assert to_itself == 0 < to_stem < to_two


def test_a_hand_that_slants_more_makes_the_same_signs(digits: list[Array]) -> None:
    slanted = [sign @ [[1.0, 0.0], [0.6, 1.0]] for sign in digits]
    table = cross_sign_distances(sign_features(slanted), sign_features(digits))
    meaning = np.repeat([0, 1, 2], 3)
    np.testing.assert_array_equal(meaning[table.argmin(axis=1)], meaning)


def test_strokes_that_differ_in_slant_alone_are_still_told_apart() -> None:
    upright, leaning, fallen = ([(-x, -1.0), (x, 1.0)] for x in (0.0, 0.7, -0.7))
    table = sign_distances(sign_features([upright, leaning, fallen]))
    assert table[~np.eye(3, dtype=bool)].min() > 0.25


def test_a_straight_line_drawn_the_other_way_is_another_sign() -> None:
    line = np.linspace([0.0, 1.0], [0.0, -1.0], 40)
    assert sign_distances(sign_features([line, line[::-1]]))[0, 1] == pytest.approx(1.2)


def test_equal_signs_are_nearer_than_others(digits: list[Array]) -> None:
    table = sign_distances(sign_features(digits))
    same = np.kron(np.eye(3), np.ones((3, 3))).astype(bool)
    assert table[same].max() < table[~same].min()


def test_an_utterance_is_read_as_the_signs_it_resembles(digits: list[Array]) -> None:
    heard = [digits[4] * 1.1, digits[8] + [0.1, 0.0]]
    reading = reader(digits).read(heard)
    assert reading.focus.argmax() == 1
    assert reading.movement.argmax() == 2
    assert reading.focus.sum() == pytest.approx(1)
    assert reading.movement.sum() == pytest.approx(1)
    assert (reading.focus >= 0).all()


def test_an_object_that_was_never_named_is_never_understood(digits: list[Array]) -> None:
    reading = reader(digits, objects=4).read([digits[0], digits[0]])
    assert reading.focus[3] == 0
    assert reading.focus.sum() == pytest.approx(1)


def test_a_sign_that_was_seen_exactly_so_is_read_without_a_warning(digits: list[Array]) -> None:
    assert reader(digits).read([digits[0], digits[3]]).focus[0] > 0.99


def test_a_point_is_no_sign() -> None:
    with pytest.raises(InvalidInputError, match="sign 1"):
        sign_features([[[0, 0], [1, 1]], [[2, 2], [2, 2]]])


def test_a_straight_sign_is_a_sign() -> None:
    features = sign_features([[[0, 0], [0, 1]], [[0, 0], [1, 0]]])
    assert np.isfinite(sign_distances(features)).all()
