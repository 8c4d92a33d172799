"""Signs: dynamic time warping against its definition, and the sign space."""

from dataclasses import FrozenInstanceError
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import InvalidInputError, SignSpace, Stroke, dtw_distance, normalised_sign, signs
from signimit.signs import SAMPLES, pairwise_dtw, warped_totals

Array = NDArray[np.float64]
BAR = np.array([[0.0, 0.0], [0.0, 1.0]])
HOOK = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
strokes = st.tuples(st.integers(1, 9), st.integers(0, 10_000)).map(
    lambda p: np.random.default_rng(p[1]).normal(size=(p[0], 2))
)
properties = settings(deadline=None, derandomize=True, max_examples=40)


def slow_dtw(a: Array, b: Array) -> float:
    """The definition: the cheapest way from one corner of the table to the other."""
    table = np.full((len(a) + 1, len(b) + 1), np.inf)
    table[0, 0] = 0.0
    for i in range(len(a)):
        for j in range(len(b)):
            cheapest = min(table[i, j], table[i, j + 1], table[i + 1, j])
            table[i + 1, j + 1] = np.hypot(*(a[i] - b[j])) + cheapest
    return float(table[-1, -1])


@pytest.mark.parametrize(
    ("a", "b", "distance"),
    [
        ([[0, 0]], [[3, 4]], 5.0),
        ([[0, 0], [1, 0], [2, 0]], [[0, 0], [2, 0]], 1.0),  # the middle point goes to either end
        ([[0, 0], [1, 0]], [[0, 3], [1, 3]], 6.0),  # 3 + 3 along the diagonal
        ([[0, 0], [0, 0], [5, 0]], [[0, 0], [5, 0], [5, 0]], 0.0),  # the same drawing, held at other places
        ([[0, 0]], [[0, 1], [0, 2], [0, 3]], 6.0),  # one point goes with all
    ],
)
def test_distances_worked_by_hand(a: Any, b: Any, distance: float) -> None:
    assert dtw_distance(a, b) == pytest.approx(distance, abs=1e-12)


@properties
@given(strokes, strokes)
def test_the_distance_is_that_of_the_definition(a: Array, b: Array) -> None:
    assert dtw_distance(a, b) == pytest.approx(slow_dtw(a, b), rel=1e-12)


@properties
@given(strokes, strokes)
def test_the_distance_is_symmetric_and_not_negative(a: Array, b: Array) -> None:
    assert dtw_distance(a, b) == dtw_distance(b, a) >= 0.0


@properties
@given(strokes)
def test_a_stroke_is_at_no_distance_from_itself(a: Array) -> None:
    assert dtw_distance(a, a) == 0.0
    assert dtw_distance(a, np.repeat(a, 3, axis=0)) == 0.0


@properties
@given(strokes, strokes, st.floats(-100, 100), st.floats(-100, 100), st.floats(0.01, 100))
def test_the_distance_moves_with_neither_place_nor_direction_and_grows_with_size(
    a: Array, b: Array, x: float, y: float, size: float
) -> None:
    expected = dtw_distance(a, b)
    assert dtw_distance(a + np.array([x, y]), b + np.array([x, y])) == pytest.approx(expected, rel=1e-9)
    assert dtw_distance(a[::-1], b[::-1]) == pytest.approx(expected, rel=1e-9)
    assert dtw_distance(size * a, size * b) == pytest.approx(size * expected, rel=1e-9)


@pytest.mark.parametrize("block", [1, 300, 10**6])
def test_all_pairs_at_once_are_each_pair_alone(block: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(signs, "_BLOCK", block)
    rng = np.random.default_rng(0)
    first, second = rng.normal(size=(5, 7, 2)), rng.normal(size=(3, 4, 2))
    table = pairwise_dtw(first, second)
    assert table.tolist() == [[dtw_distance(a, b) for b in second] for a in first]


@pytest.mark.parametrize(("block", "rows"), [(1, [1] * 5), (84, [1] * 5), (300, [3, 2]), (10**6, [5])])
def test_a_block_holds_as_many_strokes_as_fit_and_at_least_one(
    block: int, rows: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of the first strokes, 7 points, takes 7 * 4 costs for each of the 3 second ones."""
    held: list[int] = []

    def noted(cost: Array) -> Array:
        held.append(cost.size)
        return warped_totals(cost)

    monkeypatch.setattr(signs, "_BLOCK", block)
    monkeypatch.setattr(signs, "warped_totals", noted)
    pairwise_dtw(np.zeros((5, 7, 2)), np.zeros((3, 4, 2)))
    assert held == [84 * count for count in rows]


@pytest.mark.parametrize(
    ("a", "b", "sentence"),
    [
        (np.zeros((0, 2)), BAR, "first stroke: expected at least 1 point, found 0."),
        (BAR, [[0.0]], "second stroke: expected numbers of shape (n, 2), found shape (1, 1)."),
        (BAR * np.nan, BAR, "first stroke: expected finite numbers, found nan at index (0, 0)."),
    ],
)
def test_what_is_no_stroke_has_no_distance(a: Any, b: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        dtw_distance(a, b)
    assert str(caught.value) == sentence


@properties
@given(st.integers(0, 10_000), st.floats(-1e4, 1e4), st.floats(1e-6, 1e6))
def test_a_sign_is_the_same_anywhere_and_at_any_size(seed: int, shift: float, size: float) -> None:
    sign = np.random.default_rng(seed).normal(size=(12, 2)).cumsum(axis=0)
    normal = normalised_sign(sign)
    assert normal.shape == (SAMPLES, 2)
    assert np.abs(normal).max() == pytest.approx(1.0)
    np.testing.assert_allclose(normalised_sign(size * sign), normal, atol=1e-9)
    np.testing.assert_allclose(normalised_sign(size * (sign + shift)), normal, atol=1e-9)


@pytest.mark.parametrize("sign", [BAR * 1e99, BAR * 1e-99, BAR + 1e6])
def test_the_size_of_the_unit_does_not_matter(sign: Array) -> None:
    np.testing.assert_allclose(normalised_sign(sign), normalised_sign(BAR), atol=1e-6)


def test_a_prototype_is_most_like_itself() -> None:
    space = SignSpace([Stroke(BAR, np.arange(2.0)), HOOK])
    points = space.embed_all([BAR, HOOK, 3 * HOOK + 7])
    assert points.shape == (3, 2)
    assert points[0, 0] == points[1, 1] == 1.0
    assert points[2, 1] == pytest.approx(1.0)
    assert ((points > 0) & (points <= 1)).all()
    assert space.embed(HOOK).tolist() == points[1].tolist()


def test_a_coordinate_is_worked_by_hand() -> None:
    sideways = np.array([[0.0, 0.0], [1.0, 0.0]])  # normalised: (-1, 0) ... (1, 0), the bar (0, -1) ... (0, 1)
    distance = slow_dtw(normalised_sign(sideways), normalised_sign(BAR))
    assert SignSpace([BAR]).embed(sideways)[0] == pytest.approx(1 / (1 + distance / 64))


@pytest.mark.parametrize(
    ("prototypes", "sentence"),
    [
        ([], "prototypes: expected at least one, found none."),
        (3, "prototypes: expected a list, found int."),
        (BAR, "prototype 0: expected numbers of shape (n, 2), found shape (2,)."),
        ([BAR, BAR[:1]], "prototype 1: expected at least 2 points, found 1."),
        (["7"], "prototype 0: expected numbers of shape (n, 2), found <U1 values."),
    ],
)
def test_a_space_needs_prototypes(prototypes: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        SignSpace(prototypes)
    assert str(caught.value) == sentence


def test_a_bad_sign_is_told_by_its_number() -> None:
    with pytest.raises(InvalidInputError, match="sign 1: expected at least 2 points, found 1"):
        SignSpace([BAR]).embed_all([BAR, BAR[:1]])
    with pytest.raises(InvalidInputError, match="signs: expected at least one, found none"):
        SignSpace([BAR]).embed_all([])


def test_a_space_is_one_thing_that_can_be_looked_up_and_not_changed() -> None:
    space, twin = SignSpace([BAR]), SignSpace([BAR])
    assert {space: 1, twin: 2}[space] == 1
    with pytest.raises(FrozenInstanceError):
        space.prototypes = twin.prototypes  # type: ignore[misc]


def test_a_space_shares_nothing_that_can_change() -> None:
    prototype = BAR.copy()
    space = SignSpace([prototype])
    prototype[:] = 5.0
    assert space.embed(BAR)[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        space.prototypes[0, 0, 0] = 1.0
