"""Drawings as traces, and their distance against plain loops."""

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.learners.joint.drawing_distance import (
    SAMPLES,
    Drawing,
    compare_drawings,
    cross_distances,
    distances_to,
    make_drawing,
)
from signimit.teaching.composition import compose_loops, compose_path
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]
ANGLES = np.linspace(0, 4 * np.pi, 201)
CIRCLE = 0.1 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])


def times(path: Array) -> Array:
    return np.arange(len(path), dtype=np.float64) / 50


@pytest.fixture(scope="module")
def session() -> tuple[list[Drawing], Array, NDArray[np.int64]]:
    """Six traces, two of each movement, their objects, and the foci."""
    rng = np.random.default_rng(3)
    labels = ("triangle up", "circle", "star")
    language = Language(movements=labels, movement_signs=("4", "5", "6"))
    library = synthetic_library(labels, samples=8, rng=rng)
    objects = rng.uniform(-1, 1, (6, 3, 2)) * [0.22, 0.18]
    focus = rng.integers(0, 3, 6)
    traces = []
    for t in range(6):
        loops = compose_loops(language, library, t // 2, rng)
        path = compose_path(rng.uniform(-0.2, 0.2, 2), [loop + objects[t, focus[t]] for loop in loops])
        traces.append(make_drawing(path, times(path)))
    return traces, objects, focus


def slow_one_way(first: Drawing, second: Drawing, origin: Array, other: Array) -> float:
    """Mean over the points of a drawing of the least distance in place, direction and pace."""
    a = np.column_stack([(first.places - origin) / first.half_size, first.manner])
    b = np.column_stack([(second.places - other) / second.half_size, second.manner])
    return float(np.mean([min(np.linalg.norm(p - q) for q in b) for p in a]))


def test_the_distance_is_that_of_plain_loops(session: tuple[list[Drawing], Array, NDArray[np.int64]]) -> None:
    traces, objects, _ = session
    fast = compare_drawings(traces[:3], objects[:3])
    for t, k, i, j in [(0, 1, 0, 0), (0, 1, 2, 1), (1, 2, 1, 0), (2, 0, 0, 2), (1, 1, 0, 1)]:
        there = slow_one_way(traces[t], traces[k], objects[t, i], objects[k, j])
        back = slow_one_way(traces[k], traces[t], objects[k, j], objects[t, i])
        assert fast[t, k, i, j] == pytest.approx((there + back) / 2, rel=2e-3)


def test_the_distance_is_symmetric_and_nothing_from_itself(
    session: tuple[list[Drawing], Array, NDArray[np.int64]],
) -> None:
    traces, objects, _ = session
    table = compare_drawings(traces, objects)
    np.testing.assert_array_equal(table, table.transpose(1, 0, 3, 2))
    assert table[np.arange(6), np.arange(6)][:, np.arange(3), np.arange(3)].max() < 0.01


def test_equal_movements_are_nearest_in_the_frames_of_their_foci(
    session: tuple[list[Drawing], Array, NDArray[np.int64]],
) -> None:
    traces, objects, focus = session
    table = compare_drawings(traces, objects)
    for t in (0, 2, 4):
        assert np.unravel_index(table[t, t + 1].argmin(), (3, 3)) == (focus[t], focus[t + 1])
        others = [k for k in range(6) if k // 2 != t // 2]
        framed = table[t, np.arange(6), focus[t], focus]
        assert framed[t + 1] < framed[others].min()


def test_a_new_drawing_is_compared_as_if_it_had_been_there(
    session: tuple[list[Drawing], Array, NDArray[np.int64]],
) -> None:
    traces, objects, _ = session
    late = distances_to(traces[5], objects[5], traces[:5], objects[:5])
    np.testing.assert_allclose(late, compare_drawings(traces, objects)[5, :5], rtol=1e-4, atol=1e-4)


def test_a_shift_of_the_whole_table_changes_nothing(session: tuple[list[Drawing], Array, NDArray[np.int64]]) -> None:
    traces, objects, _ = session
    shift = np.array([0.4, -0.7])
    moved = [t._replace(places=t.places + shift, centre=t.centre + shift) for t in traces]
    table, again = compare_drawings(traces, objects), compare_drawings(moved, objects + shift)
    np.testing.assert_allclose(again, table, rtol=1e-4, atol=2e-3)


def test_best_matches_of_blocks_are_those_of_one(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(0)
    query = rng.normal(size=(2, SAMPLES, 5)).astype(np.float32)
    targets = rng.normal(size=(7, 3, SAMPLES, 5)).astype(np.float32)
    whole = cross_distances(query, targets)
    monkeypatch.setattr("signimit.learners.joint.drawing_distance._BLOCK", 1)
    np.testing.assert_allclose(cross_distances(query, targets), whole, rtol=1e-5)
    assert whole.shape == (7, 2, 3)


def test_a_trace_knows_the_size_and_middle_of_the_drawing_without_its_reach() -> None:
    reach = np.linspace([0.9, 0.0], [0.1, 0.0], 60, endpoint=False)
    path = np.concatenate([reach, CIRCLE])
    trace = make_drawing(path, times(path))
    assert trace.half_size == pytest.approx(0.1, rel=0.15)
    np.testing.assert_allclose(trace.centre, 0, atol=0.02)
    assert trace.places.shape == (SAMPLES, 2)


def test_the_unit_of_time_does_not_matter_but_the_pace_does() -> None:
    halting = np.concatenate([np.linspace(0, 0.5, 150) ** 2, 0.25 + np.linspace(0, 1, 61)[1:] * 0.75])
    path = CIRCLE[np.round(halting * 200).astype(int)] + 1e-6 * np.arange(len(halting))[:, None]
    even, slow = make_drawing(CIRCLE, times(CIRCLE)), make_drawing(path, times(path))
    np.testing.assert_allclose(make_drawing(CIRCLE, 7 * times(CIRCLE)).manner, even.manner, atol=1e-9)
    assert np.abs(slow.manner[:, 2] - even.manner[:, 2]).max() > 0.5


@pytest.mark.parametrize(
    "path", [[[0, 0], [1, 0]], [[0, 0], [1, 0], [0, 0]], [[0, 0], [0, 0], [0, 1]], [[0, 0], [1e-9, 0], [1, 1], [1, 1]]]
)
def test_paths_of_a_few_points_and_pauses_make_finite_traces(path: list[list[float]]) -> None:
    points = np.array(path, dtype=float)
    trace = make_drawing(points, times(points))
    assert all(np.isfinite(part).all() for part in trace)
    assert trace.half_size > 0
