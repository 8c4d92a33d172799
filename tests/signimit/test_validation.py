"""The boundary: what passes is a finite, read-only copy; what does not gives one sentence."""

from typing import Any

import numpy as np
import pytest

from signimit import InvalidInputError
from signimit.validation import (
    finite_array,
    increasing_times,
    item_list,
    make_generator,
    moving_points,
    whole_numbers,
)


@pytest.mark.parametrize("value", [[[1, 2], [3, 4]], ((True, 2), (3.0, 4)), np.array([[1, 2], [3, 4]], np.float32)])
def test_numbers_of_any_kind_become_a_read_only_float_copy(value: Any) -> None:
    array = finite_array(value, "x", (None, 2))
    assert array.dtype == np.float64
    assert array.flags.c_contiguous
    assert not array.flags.writeable
    assert array.tolist() == [[1, 2], [3, 4]]


def test_the_copy_does_not_follow_its_source() -> None:
    source = np.zeros(3)
    copy = finite_array(source, "x", (3,))
    source[0] = 1.0
    assert copy[0] == 0.0


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ([[1.0, 2.0], [3.0]], "x: expected numbers of shape (n, 2), found list that is not such an array."),
        ([["1", "2"]], "x: expected numbers of shape (n, 2), found <U1 values."),
        ([[1j, 2.0]], "x: expected numbers of shape (n, 2), found complex128 values."),
        ([[None, 2.0]], "x: expected numbers of shape (n, 2), found object values."),
        (np.zeros((1, 2), "M8[s]"), "x: expected numbers of shape (n, 2), found datetime64[s] values."),
        ("text", "x: expected numbers of shape (n, 2), found <U4 values."),
        (None, "x: expected numbers of shape (n, 2), found object values."),
        ({"a": 1}, "x: expected numbers of shape (n, 2), found object values."),
        (3.0, "x: expected numbers of shape (n, 2), found shape ()."),
        ([1.0, 2.0], "x: expected numbers of shape (n, 2), found shape (2,)."),
        (np.zeros((2, 3)), "x: expected numbers of shape (n, 2), found shape (2, 3)."),
        ([[0.0, 1.0], [2.0, np.nan]], "x: expected finite numbers, found nan at index (1, 1)."),
        ([[-np.inf, 1.0]], "x: expected finite numbers, found -inf at index (0, 0)."),
        ([[1e101, 1.0]], "x: expected finite numbers, found 1e+101 at index (0, 0)."),
    ],
)
def test_what_is_not_finite_numbers_of_the_shape_is_refused(value: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        finite_array(value, "x", (None, 2))
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ([], "hand: expected numbers of shape (n, 2), found shape (0,)."),
        (np.zeros((0, 2)), "hand: expected at least 2 points, found 0."),
        ([[1.0, 2.0]], "hand: expected at least 2 points, found 1."),
        ([[1.0, 2.0]] * 9, "hand: expected points that move, found 9 points in one place."),
        ([[1.0, 2.0], [1.0 + 1e-15, 2.0]], "hand: expected points that move, found 2 points in one place."),
        ([[0.0, 0.0], [5e-324, 0.0]], "hand: expected points that move, found 2 points in one place."),
    ],
)
def test_a_path_has_two_points_and_moves(value: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        moving_points(value, "hand")
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        ([0.0, 1.0], "times: expected numbers of shape (3,), found shape (2,)."),
        ([0.0, 1.0, 1.0], "times: expected strictly increasing seconds, found 1 then 1 at index 1."),
        ([0.0, 1.0, 0.5], "times: expected strictly increasing seconds, found 1 then 0.5 at index 1."),
        ([0.0, 1e-300, 1.0], "times: expected strictly increasing seconds, found 0 then 1e-300 at index 0."),
        (
            [0.0, 1302126477.139, 1302126477.138],
            "times: expected strictly increasing seconds, found 1302126477.139 then 1302126477.138 at index 1.",
        ),
    ],
)
def test_times_increase(value: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        increasing_times(value, "times", 3)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("value", "sentence"),
    [
        (5, "signs: expected a list, found int."),
        ("abc", "signs: expected a list, found str."),
        ({"a": 1}, "signs: expected a list, found dict."),
        (np.array(5.0), "signs: expected a list, found ndarray."),
        (None, "signs: expected a list, found NoneType."),
        ((), "signs: expected at least one, found none."),
        (np.zeros((0, 3)), "signs: expected at least one, found none."),
    ],
)
def test_a_list_is_a_list_of_something(value: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        item_list(value, "signs")
    assert str(caught.value) == sentence


def test_anything_that_can_be_gone_through_is_a_list() -> None:
    assert item_list((i for i in range(3)), "signs") == [0, 1, 2]


@pytest.mark.parametrize("value", [[0.5, 1.0], [1e60, 0.0]])
def test_labels_are_whole_numbers(value: Any) -> None:
    with pytest.raises(InvalidInputError, match=r"labels: expected whole numbers, found \["):
        whole_numbers(value, "labels", (2,))
    assert whole_numbers([1.0, -2], "labels", (2,)).tolist() == [1, -2]


@pytest.mark.parametrize("value", ["x", -1, 0.5, object])
def test_randomness_is_a_generator_or_a_seed(value: Any) -> None:
    with pytest.raises(InvalidInputError, match="rng: expected a numpy Generator or a seed, 0 or more, found"):
        make_generator(value)


def test_a_generator_is_used_and_not_copied() -> None:
    rng = np.random.default_rng(0)
    assert make_generator(rng) is rng
    assert make_generator(7).random() == np.random.default_rng(7).random()
