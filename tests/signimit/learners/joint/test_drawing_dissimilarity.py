"""Features of pairs of drawings: by hand, against plain loops, and what they do not depend on."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit.learners.joint.drawing_dissimilarity import (
    FEATURES,
    Drawing,
    compare_drawings,
    describe_drawing,
    pair_features,
    summarise_gaps,
)
from signimit.teaching.composition import compose_loops, compose_path
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]
properties = settings(deadline=None, derandomize=True, max_examples=25)
KINDS = ("circle", "square", "star", "zigzag", "figure eight")


def times(path: Array) -> Array:
    return np.arange(len(path)) / 50


def polygon(sides: int, rounds: int = 1) -> Array:
    angles = np.linspace(0, 2 * np.pi * rounds, sides * rounds + 1) + np.pi / sides
    corners = 0.1 * np.column_stack([np.cos(angles), np.sin(angles)])
    share = np.linspace(0, 1, 30, endpoint=False)[:, None]
    return np.concatenate([a + share * (b - a) for a, b in pairwise(corners)])


def described(path: Array) -> Drawing:
    return describe_drawing(path, times(path))


@pytest.fixture(scope="module")
def paths() -> list[Array]:
    """Two demonstrations of each movement, with their reaches; each twice about where the hand likes."""
    rng = np.random.default_rng(3)
    language = Language(movements=KINDS, movement_signs=("4", "5", "6", "7", "8"))
    library = synthetic_library(KINDS, samples=8, rng=rng)
    loops = [compose_loops(language, library, t // 2, rng) for t in range(2 * len(KINDS))]
    return [compose_path(rng.uniform(-0.2, 0.2, 2), loop) for loop in loops]


def test_equal_movements_are_less_unlike_than_any_others(paths: list[Array]) -> None:
    table = compare_drawings([described(path) for path in paths])
    kinds = np.arange(len(paths)) // 2
    same = kinds[:, None] == kinds
    assert table[same].max() < table[~same].min()


def test_unlikeness_is_symmetric_and_least_to_oneself(paths: list[Array]) -> None:
    drawings = [described(path) for path in paths]
    table = compare_drawings(drawings)
    np.testing.assert_allclose(table, table.T, atol=1e-6)
    assert (table.argmin(axis=1) == np.arange(len(paths))).all()
    np.testing.assert_allclose(compare_drawings(drawings[-1:], drawings)[0], table[-1], atol=1e-6)


@pytest.mark.parametrize(("size", "shift"), [(1.0, 0.7), (3.0, 0.0), (0.25, -0.4)])
def test_where_and_how_large_a_drawing_is_changes_no_feature(paths: list[Array], size: float, shift: float) -> None:
    plain = pair_features([described(path) for path in paths])
    moved = [described(size * path + shift) for path in paths]
    np.testing.assert_allclose(pair_features(moved), plain, atol=1e-6)
    for path, drawing in zip(paths, moved, strict=True):
        np.testing.assert_allclose(drawing.centre, size * described(path).centre + shift, atol=1e-9)
        assert drawing.half_size == pytest.approx(size * described(path).half_size)


def test_a_drawing_that_is_compared_with_itself_has_the_features_of_no_difference(paths: list[Array]) -> None:
    drawing = described(paths[0])
    same = dict(zip(FEATURES, pair_features([drawing])[0, 0], strict=True))
    for name in ("directions", "outline", "gap", "largest gap", "largest gap in a square"):
        assert same.pop(name) == pytest.approx(np.log(0.02), abs=1e-3)
    assert not any(same.values())


def test_a_drawing_that_is_drawn_twice_is_told_by_its_first_round() -> None:
    once, twice, square = described(polygon(3)), described(polygon(3, rounds=2)), described(polygon(4))
    table = compare_drawings([once, twice, square])
    assert table[0, 1] < min(table[0, 2], table[1, 2]) - 2
    np.testing.assert_allclose(once.outline, twice.outline, atol=0.02)


def test_scalars_by_hand() -> None:
    """A square of half size 1 from its middle: 2 pi / 8 of turning in all but the last side; three corners turned."""
    turning, corners, _, aspect, spread, least, opening, length = described(polygon(4)).scalars
    assert turning == pytest.approx(3 * np.pi / 2 / 8, rel=0.05)
    assert corners == pytest.approx(3 * 3 / 8, rel=0.05)
    assert aspect == pytest.approx(0, abs=0.01)
    assert least == pytest.approx(1, abs=0.05)  # the middle of a side
    assert spread == pytest.approx(0.127, abs=0.02)  # sqrt(4 / 3 - 1.1478²), of sqrt(1 + x²) over a side
    assert opening == pytest.approx(2 / 30, abs=0.01)
    assert length == pytest.approx(np.log(8), abs=0.02)


def test_a_box_of_two_to_one_has_the_logarithm_of_two() -> None:
    assert described(polygon(4) * [2.0, 1.0]).scalars[3] == pytest.approx(np.log(2), abs=0.01)


def test_gaps_by_hand() -> None:
    """To the nearest: 0 and 3 one way, 0 and 0 and 4 the other; the larger fourth root of the mean fourth power."""
    mean, large = summarise_gaps(np.array([[[0.0, 0.0], [3.0, 0.0]]]), np.array([[[0.0, 0.0], [0.0, 0.0], [0.0, 4.0]]]))
    assert mean.item() == pytest.approx((3 / 2 + 4 / 3) / 2)
    assert large.item() == pytest.approx((4**4 / 3) ** 0.25)  # 3.04; the other way (3⁴ / 2) ** 0.25 = 2.52


def slow_gaps(a: Array, b: Array) -> tuple[float, float]:
    there = [min(float(np.linalg.norm(p - q)) for q in b) for p in a]
    back = [min(float(np.linalg.norm(p - q)) for p in a) for q in b]
    large = max(float(np.mean(np.array(way) ** 4)) ** 0.25 for way in (there, back))
    return (float(np.mean(there)) + float(np.mean(back))) / 2, large


@properties
@given(st.integers(1, 3), st.integers(1, 3), st.integers(2, 5), st.integers(0, 10_000))
def test_gaps_are_those_of_plain_loops(first: int, second: int, width: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(first, 7, width)), rng.normal(size=(second, 7, width))
    mean, large = summarise_gaps(a, b)
    for i, k in np.ndindex(mean.shape):
        assert (mean[i, k], large[i, k]) == pytest.approx(slow_gaps(a[i], b[k]))


@pytest.mark.parametrize(
    "path",
    [
        [[0, 0], [1, 0]],
        [[0, 0], [1, 0], [0, 0]],
        [[0, 0], [0, 0], [0, 1]],
        [[0, 0], [1e-9, 0], [1, 1], [1, 1]],
        [[0, 0], [1e-12, 0]],
    ],
)
def test_paths_of_a_few_points_and_pauses_have_finite_features(path: list[list[float]]) -> None:
    drawing = described(np.array(path, dtype=float))
    assert np.isfinite(pair_features([drawing, described(polygon(4))])).all()
    assert drawing.half_size > 0
