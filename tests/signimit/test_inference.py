"""Focus and word order: by hand, against plain loops, and in the cases where nothing can be known."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError, WordOrder, infer_focus, infer_word_order
from signimit.inference import focus_similarities, spread_between, spread_within

Array = NDArray[np.float64]
properties = settings(deadline=None, derandomize=True, max_examples=30)


def random_table(count: int, frames: int, seed: int) -> Array:
    table = np.random.default_rng(seed).uniform(0.1, 3.0, (count, count, frames, frames))
    return np.asarray(np.minimum(table, table.transpose(1, 0, 3, 2)))


def slow_focus(distances: Array, labels: list[int]) -> list[int]:
    """The frame in which a trajectory is most similar to the others of its movement."""
    count, frames = distances.shape[1:3]
    found = []
    for t in range(count):
        others = [k for k in range(count) if k != t and labels[k] == labels[t]]
        others = others or [k for k in range(count) if k != t]
        found.append(int(np.argmax([sum((1 / distances[t, k, i]).max() for k in others) for i in range(frames)])))
    return found


@properties
@given(st.integers(1, 6), st.integers(1, 4), st.integers(0, 10_000))
def test_the_focus_is_that_of_the_definition(count: int, frames: int, seed: int) -> None:
    table, labels = random_table(count, frames, seed), np.random.default_rng(seed).integers(0, 3, count).tolist()
    assert infer_focus(table, labels).tolist() == slow_focus(table, labels)


def test_the_frame_that_agrees_with_the_group_is_the_focus() -> None:
    table = np.full((3, 3, 2, 2), 1.0)
    table[0, 1, 1, 0] = table[1, 0, 0, 1] = 0.1  # 0 about its object 1 is like 1 about its object 0
    table[0, 2, 0, 0] = table[2, 0, 0, 0] = 0.01  # closer still, but of another movement
    assert infer_focus(table, [0, 0, 1])[:2].tolist() == [1, 0]


def test_a_demonstration_alone_in_its_group_is_compared_with_all() -> None:
    table = np.full((2, 2, 2, 2), 1.0)
    table[0, 1, 1, 0] = table[1, 0, 0, 1] = 0.1
    assert infer_focus(table, [0, 1]).tolist() == [1, 0]


def test_similarities_to_a_group_are_means_by_hand() -> None:
    table = np.full((4, 4, 2, 2), 1.0)
    table[0, 1, 0, 1] = table[1, 0, 1, 0] = 0.25  # γ = 4 where 0 is about its object 0, 1 about its object 1
    table[0, 2, 0, 0] = table[2, 0, 0, 0] = 0.5  # γ = 2
    found = focus_similarities(table, np.array([0, 0, 0, 1]))
    # 0: (4 + 2) / 2 and (1 + 1) / 2; 1: (1 + 1) / 2 and (4 + 1) / 2; 2: (2 + 1) / 2 and 1; 3, alone: 1 to all three
    np.testing.assert_allclose(found, [[3.0, 1.0], [1.0, 2.5], [1.5, 1.0], [1.0, 1.0]])
    pair = focus_similarities(table[:2, :2], np.array([0, 0]))  # each has one other
    np.testing.assert_allclose(pair, [[4, 1], [1, 4]])


def test_one_demonstration_or_one_object_leaves_no_choice() -> None:
    assert infer_focus(np.zeros((1, 1, 3, 3)), [0]).tolist() == [0]
    assert infer_focus(np.zeros((2, 2, 1, 1)), [0, 0]).tolist() == [0, 0]


def spread_points(first: list[float], second: list[float]) -> Array:
    """Return signs as points on a line, (N, 2, 1)."""
    return np.array([first, second]).T[..., None]


MOVEMENT, FOCUS = [0, 0, 1, 1], [0, 1, 0, 1]


@pytest.mark.parametrize("method", ["paper", "ratio"])
def test_the_word_that_differs_within_movements_names_the_object(method: str) -> None:
    # first word: 0 or 1 with the focus; second: 0 or 1 with the movement
    points = spread_points([0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0])
    assert infer_word_order(points, MOVEMENT, FOCUS, method) == WordOrder(focus=0, movement=1)
    assert infer_word_order(points[:, ::-1], MOVEMENT, FOCUS, method) == WordOrder(focus=1, movement=0)


def test_sign_classes_close_together_mislead_the_raw_distance_and_not_the_ratio() -> None:
    # the signs for objects differ by 0.1 only; those for movements are drawn with as much noise
    points = spread_points([0.0, 0.1, 0.0, 0.1], [0.0, 0.3, 5.0, 5.3])
    assert infer_word_order(points, MOVEMENT, FOCUS, "paper") == WordOrder(focus=1, movement=0)
    assert infer_word_order(points, MOVEMENT, FOCUS, "ratio") == WordOrder(focus=0, movement=1)


def test_words_are_compared_by_within_over_between_whatever_their_scale() -> None:
    movement, focus = np.array([0, 0, 1, 1, 0, 1]), np.array([0, 1, 0, 1, 0, 1])
    noise = np.array([0.0, 0.0, 1.0, 1.0, 1.0, 0.0])
    # two words name the object: a small one drawn with a tenth of noise, and a large one with a hundredth
    points = np.stack([0.1 * (focus + 0.1 * noise), 10 * (focus + 0.01 * noise), movement], axis=1)[..., None]
    assert infer_word_order(points, movement, focus) == WordOrder(focus=1, movement=2)
    assert infer_word_order(points, focus, movement) == WordOrder(focus=2, movement=1)


def test_spreads_by_hand() -> None:
    gaps = np.array([[0.0, 1.0, 2.0], [1.0, 0.0, 4.0], [2.0, 4.0, 0.0]])[..., None]
    assert spread_within(gaps, np.array([0, 0, 1])).tolist() == [1.0]
    assert spread_between(gaps, np.array([0, 0, 1])).tolist() == [3.0]
    assert spread_between(0 * gaps, np.array([0, 0, 1])).tolist() == [1e-12]  # signs that are all the same
    assert (
        spread_within(gaps, np.array([0, 1, 2])).tolist()
        == spread_between(gaps, np.zeros(3, dtype=np.int64)).tolist()
        == [1.0]
    )


def test_a_third_word_that_means_nothing_is_left_out() -> None:
    rng = np.random.default_rng(0)
    movement, focus = np.repeat([0, 1, 2], 6), np.tile([0, 1, 2], 6)
    words = np.stack([focus, rng.uniform(0, 2, 18), movement], axis=1)[..., None] + rng.normal(0, 0.05, (18, 3, 1))
    assert infer_word_order(words, movement, focus) == WordOrder(focus=0, movement=2)


@pytest.mark.parametrize("method", ["paper", "ratio"])
def test_one_word_is_both(method: str) -> None:
    assert infer_word_order(np.zeros((4, 1, 3)), MOVEMENT, FOCUS, method) == WordOrder(0, 0)


@pytest.mark.parametrize("method", ["paper", "ratio"])
@pytest.mark.parametrize("count", [1, 2])
def test_words_that_say_nothing_are_still_two_words(method: str, count: int) -> None:
    order = infer_word_order(np.zeros((count, 2, 3)), [0] * count, [0] * count, method)
    assert sorted(order) == [0, 1]


@properties
@given(st.integers(0, 10_000), st.floats(1e-3, 1e3), st.sampled_from(["paper", "ratio"]))
def test_neither_the_order_of_demonstrations_nor_the_unit_of_signs_matters(seed: int, unit: float, method: str) -> None:
    rng = np.random.default_rng(seed)
    points, movement, focus = rng.normal(size=(8, 2, 3)), rng.integers(0, 3, 8), rng.integers(0, 3, 8)
    order = rng.permutation(8)
    permuted = infer_word_order(unit * points[order], movement[order], focus[order], method)
    assert permuted == infer_word_order(points, movement, focus, method)


@properties
@given(st.integers(0, 10_000), st.sampled_from(["paper", "ratio"]))
def test_the_names_of_movements_and_objects_do_not_matter(seed: int, method: str) -> None:
    rng = np.random.default_rng(seed)
    points, movement, focus = rng.normal(size=(8, 2, 3)), rng.integers(0, 3, 8), rng.integers(0, 3, 8)
    renamed = infer_word_order(points, np.array([7, -1, 2])[movement], np.array([2, 0, 1])[focus], method)
    assert renamed == infer_word_order(points, movement, focus, method)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((np.zeros((2, 2, 1)), [0, 0]), "distances: expected numbers of shape (n, n, n, n), found shape (2, 2, 1)."),
        ((np.zeros((2, 3, 1, 1)), [0, 0]), "distances: expected shape (N, N, O, O), found shape (2, 3, 1, 1)."),
        ((np.ones((2, 2, 1, 1)), [0, 0, 0]), "labels: expected numbers of shape (2,), found shape (3,)."),
        ((np.ones((2, 2, 1, 1)), [0.5, 0]), "labels: expected whole numbers, found [0.5, 0.0]."),
    ],
)
def test_what_has_no_focus_is_told(arguments: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        infer_focus(*arguments)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((np.zeros((2, 2)), [0, 0], [0, 0]), "sign points: expected numbers of shape (n, n, n), found shape (2, 2)."),
        ((np.zeros((2, 0, 3)), [0, 0], [0, 0]), "sign points: expected at least one number, found shape (2, 0, 3)."),
        ((np.ones((2, 2, 3)), [0], [0, 0]), "labels: expected numbers of shape (2,), found shape (1,)."),
        ((np.ones((2, 2, 3)), [0, 1], ["red", "blue"]), "focus: expected numbers of shape (2,), found <U4 values."),
    ],
)
def test_what_has_no_word_order_is_told(arguments: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        infer_word_order(*arguments)
    assert str(caught.value) == sentence


def test_an_unknown_method_is_told_with_the_known_ones() -> None:
    with pytest.raises(UnknownNameError, match="Unknown word order method 'guess'; known are ratio, paper"):
        infer_word_order(np.ones((2, 2, 3)), [0, 1], [0, 1], "guess")
