"""Geometry of paths: numbers by hand, slow oracles, and what must not matter."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, dist, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit.paths import (
    arc_lengths,
    box_centre,
    half_size,
    headings,
    interpolate,
    nearest_distances,
    nearest_points,
    resample_path,
    space_path,
    space_timed_path,
    step_lengths,
    unit_tangents,
    wrap_angles,
)

Array = NDArray[np.float64]
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
HOOK = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [3.0, 4.0]])  # with a pause in its corner
POINT = np.array([[2.0, -1.0]])
REST = np.repeat(POINT, 5, axis=0)

properties = settings(deadline=None, derandomize=True, max_examples=40)
seeds = st.integers(0, 10_000)
shifts = st.tuples(st.floats(-10, 10), st.floats(-10, 10)).map(np.array)
scales = st.floats(0.01, 100)
turns = st.floats(-7, 7)


def random_path(seed: int) -> Array:
    """Return a path of 2 to 30 points, some of them repeated."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(rng.integers(2, 20), 2)).cumsum(axis=0).repeat(rng.integers(1, 3), axis=0)


def rotation(angle: float) -> Array:
    return np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])


def slow_resampled(points: Array, samples: int) -> Array:
    """Walk along the path and stop every so often, as the definition says."""
    steps = [dist(a, b) for a, b in pairwise(points)]
    resampled = []
    for k in range(samples):
        left, here = k * sum(steps) / (samples - 1), points[0]
        for (a, b), step in zip(pairwise(points), steps, strict=True):
            if step > 0:
                here = a + min(left / step, 1.0) * (b - a)
            if left <= step:
                break
            left -= step
        resampled.append(here)
    return np.array(resampled)


def test_lengths_of_a_hook_by_hand() -> None:
    assert step_lengths(HOOK).tolist() == [3.0, 0.0, 4.0]
    assert arc_lengths(HOOK).tolist() == [0.0, 3.0, 3.0, 7.0]


def test_a_single_point_has_no_length_no_size_and_is_its_own_centre() -> None:
    assert step_lengths(POINT).tolist() == []
    assert arc_lengths(POINT).tolist() == [0.0]
    assert half_size(POINT) == 0.0
    assert box_centre(POINT).tolist() == [2.0, -1.0]
    assert resample_path(POINT, 3).tolist() == [[2.0, -1.0]] * 3


def test_a_resting_hand_has_no_length_no_size_and_no_direction() -> None:
    assert arc_lengths(REST).tolist() == [0.0] * 5
    assert half_size(REST) == 0.0
    assert unit_tangents(REST).tolist() == unit_tangents(REST, closed=True).tolist() == [[0.0, 0.0]] * 5
    assert resample_path(REST, 4).tolist() == space_path(REST, 1.0)[:4].tolist() == [[2.0, -1.0]] * 4


def test_half_a_size_is_half_of_the_larger_extent() -> None:
    assert half_size(HOOK) == 2.0
    assert box_centre(HOOK).tolist() == [1.5, 2.0]


def test_the_half_size_of_a_circle_is_its_radius() -> None:
    angles = np.linspace(0.0, 2 * np.pi, 21)  # with the four points that touch the box
    assert half_size(0.1 * np.column_stack([np.cos(angles), np.sin(angles)]) + 7.0) == pytest.approx(0.1)


@properties
@given(seeds, shifts, scales)
def test_lengths_and_sizes_do_not_move_with_a_path_and_grow_with_it(seed: int, shift: Array, scale: float) -> None:
    path = random_path(seed)
    other = scale * path + shift
    np.testing.assert_allclose(arc_lengths(other), scale * arc_lengths(path), atol=1e-9)
    assert half_size(other) == pytest.approx(scale * half_size(path))
    np.testing.assert_allclose(box_centre(other), scale * box_centre(path) + shift, atol=1e-9)


@properties
@given(seeds, turns)
def test_turning_a_path_keeps_its_lengths_and_at_most_a_root_of_two_of_its_size(seed: int, angle: float) -> None:
    path = random_path(seed)
    turned = path @ rotation(angle).T
    np.testing.assert_allclose(arc_lengths(turned), arc_lengths(path), atol=1e-9)
    assert half_size(path) / 1.4143 <= half_size(turned) <= 1.4143 * half_size(path)


@properties
@given(seeds)
def test_points_in_another_order_or_twice_have_the_same_size(seed: int) -> None:
    path = random_path(seed)
    shuffled = np.random.default_rng(seed).permutation(np.concatenate([path, path]))
    assert half_size(shuffled) == half_size(path)
    assert box_centre(shuffled).tolist() == box_centre(path).tolist()


def test_positions_between_and_beyond_what_is_known() -> None:
    at, known = np.array([-1.0, 0.5, 1.0, 1.5, 9.0]), np.array([0.0, 1.0, 2.0])
    points = np.array([[0.0, 0.0], [2.0, -2.0], [2.0, 0.0]])
    assert interpolate(at, known, points).tolist() == [[0, 0], [1, -1], [2, -2], [2, -1], [2, 0]]


def test_a_path_is_resampled_evenly_along_its_length() -> None:
    path = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 0.0], [3.0, 1.0]])
    assert resample_path(path, 5).tolist() == [[0, 0], [1, 0], [2, 0], [3, 0], [3, 1]]


@properties
@given(seeds, st.integers(2, 60))
def test_resampling_is_a_walk_along_the_path(seed: int, samples: int) -> None:
    path = random_path(seed)
    np.testing.assert_allclose(resample_path(path, samples), slow_resampled(path, samples), atol=1e-7)


@properties
@given(seeds, shifts, scales, turns)
def test_a_path_may_be_moved_before_or_after_it_is_resampled(
    seed: int, shift: Array, scale: float, angle: float
) -> None:
    path, turn = random_path(seed), scale * rotation(angle).T
    np.testing.assert_allclose(
        resample_path(path @ turn + shift, 20), resample_path(path, 20) @ turn + shift, atol=1e-6
    )


@properties
@given(seeds)
def test_resampling_keeps_ends_and_backwards_is_backwards(seed: int) -> None:
    path = random_path(seed)
    resampled = resample_path(path, 33)
    np.testing.assert_allclose(resampled[[0, -1]], path[[0, -1]], atol=1e-12)
    np.testing.assert_allclose(resample_path(path[::-1], 33), resampled[::-1], atol=1e-7)


@properties
@given(seeds, st.integers(2, 5))
def test_points_between_points_change_nothing_about_a_path(seed: int, parts: int) -> None:
    path = random_path(seed)
    finer = interpolate(np.linspace(0, len(path) - 1, parts * (len(path) - 1) + 1), np.arange(float(len(path))), path)
    assert arc_lengths(finer)[-1] == pytest.approx(arc_lengths(path)[-1])
    np.testing.assert_allclose(resample_path(finer, 20), resample_path(path, 20), atol=1e-7)


def test_a_closed_path_is_spaced_all_the_way_round() -> None:
    expected = np.array([[0, 0], [0.5, 0], [1, 0], [1, 0.5], [1, 1], [0.5, 1], [0, 1], [0, 0.5]])
    np.testing.assert_allclose(space_path(SQUARE, 0.5, closed=True), expected, atol=1e-12)


def test_an_open_path_ends_where_it_ended() -> None:
    spaced = space_path(SQUARE, 0.5)
    assert len(spaced) == 7
    np.testing.assert_allclose(spaced[-1], SQUARE[-1])


@pytest.mark.parametrize(("spacing", "steps"), [(100.0, 4), (0.7, 4), (0.4, 8), (0.42, 7), (1e-9, 50)])
def test_steps_are_as_long_as_wanted_but_at_least_four_and_at_most_so_many(spacing: float, steps: int) -> None:
    assert len(space_path(SQUARE, spacing, most=50)) == steps + 1


@properties
@given(shifts, scales)
def test_spacing_moves_and_grows_with_the_path(shift: Array, scale: float) -> None:
    plain = space_path(SQUARE, 0.3, closed=True)
    moved = space_path(SQUARE * scale + shift, 0.3 * scale, closed=True)
    np.testing.assert_allclose(moved, plain * scale + shift, atol=1e-9)


def test_a_pause_takes_time_and_no_way() -> None:
    points, times = np.array([[0.0, 0], [1, 0], [1, 0], [2, 0]]), np.array([0.0, 1, 5, 6])
    path = space_timed_path(points, times, 0.5)
    np.testing.assert_allclose(path.points[:, 0], [0, 0.5, 1, 1.5, 2])
    np.testing.assert_allclose(path.times, [0, 0.5, 1, 3.5, 6])


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_pause_is_a_step_of_less_than_a_billionth_of_the_way(size: float) -> None:
    """Hands tremble in a pause; how far counts only beside how far they go."""
    points, times = size * np.array([[0.0, 0], [1, 0], [1 + 1e-10, 0], [2, 0]]), np.array([0.0, 1, 5, 6])
    np.testing.assert_allclose(space_timed_path(points, times, 0.5 * size).times, [0, 0.5, 1, 3.5, 6])
    late = size * np.array([[0.0, 0], [1e-10, 0], [1, 0]])
    np.testing.assert_allclose(space_timed_path(late, times[[0, 2, 3]], 0.25 * size).times, [0, 1.5, 3, 4.5, 6])
    slow = size * np.array([[0.0, 0], [1e-8, 0], [1, 0]])  # no pause, a slow start
    np.testing.assert_allclose(
        space_timed_path(slow, times[[0, 2, 3]], 0.25 * size).times, [0, 5.25, 5.5, 5.75, 6], atol=1e-6
    )


def test_no_path_is_cut_into_more_than_ten_thousand_steps() -> None:
    assert len(space_path(SQUARE, 1e-9)) == 10_001


@properties
@given(seeds)
def test_with_times_or_without_the_way_is_the_same(seed: int) -> None:
    path = random_path(seed)
    timed = space_timed_path(path, np.arange(len(path), dtype=np.float64), 0.1)
    np.testing.assert_allclose(timed.points, space_path(path, 0.1), atol=1e-6)
    assert (np.diff(timed.times) > 0).all()


def test_directions_by_hand() -> None:
    np.testing.assert_allclose(unit_tangents(SQUARE, closed=True)[0], np.array([1, -1]) / np.sqrt(2))
    np.testing.assert_allclose(unit_tangents(SQUARE)[[0, 1, 3]], [[1, 0], np.array([1, 1]) / np.sqrt(2), [-1, 0]])


@properties
@given(seeds, shifts, scales, turns, st.booleans())
def test_directions_turn_with_the_path_and_forget_its_place_and_size(
    seed: int, shift: Array, scale: float, angle: float, closed: bool
) -> None:
    path = np.random.default_rng(seed).normal(size=(9, 2))
    tangents = unit_tangents(path, closed)
    np.testing.assert_allclose(np.hypot(*tangents.T), 1.0)
    np.testing.assert_allclose(
        unit_tangents(scale * path @ rotation(angle).T + shift, closed), tangents @ rotation(angle).T, atol=1e-6
    )


@properties
@given(seeds, st.integers(1, 8))
def test_a_closed_path_has_no_first_point(seed: int, by: int) -> None:
    path = np.random.default_rng(seed).normal(size=(9, 2))
    rolled = unit_tangents(np.roll(path, by, axis=0), closed=True)
    np.testing.assert_allclose(rolled, np.roll(unit_tangents(path, closed=True), by, axis=0), atol=1e-9)


def test_headings_are_counter_clockwise_from_the_x_axis() -> None:
    vectors = np.array([[[1.0, 0.0], [0.0, 2.0]], [[-3.0, 0.0], [1.0, -1.0]]])
    np.testing.assert_allclose(headings(vectors), np.array([[0, 0.5], [1, -0.25]]) * np.pi)


@properties
@given(st.floats(-1e3, 1e3), st.integers(-50, 50))
def test_wrapped_angles_point_the_same_way_within_half_a_turn(angle: float, rounds: int) -> None:
    wrapped = float(wrap_angles(np.array(angle)))
    assert abs(wrapped) <= np.pi
    assert (cos(wrapped), sin(wrapped)) == pytest.approx((cos(angle), sin(angle)), abs=1e-9)
    gap = wrapped - float(wrap_angles(np.array(angle + 2 * np.pi * rounds)))
    assert abs(atan2(sin(gap), cos(gap))) < 1e-9


@pytest.mark.parametrize("offset", [(0.0, 0.0), (1e6, 1e6), (1e7, -1e7)])
def test_nearest_points_are_those_of_the_definition_far_from_the_origin_too(offset: tuple[float, float]) -> None:
    rng = np.random.default_rng(0)
    queries, points = rng.normal(size=(300, 2)) + offset, rng.normal(size=(40, 2)) + offset
    gaps = np.linalg.norm(queries[:, None] - points, axis=-1)
    assert (nearest_points(queries, points) == gaps.argmin(axis=1)).all()
    np.testing.assert_allclose(nearest_distances(queries, points), gaps.min(axis=1), atol=1e-9)


def test_more_queries_than_fit_one_block() -> None:
    rng = np.random.default_rng(0)
    queries, points = rng.normal(size=(1000, 2)), rng.normal(size=(300, 2))
    gaps = np.linalg.norm(queries[:, None] - points, axis=-1)
    assert (nearest_points(queries, points) == gaps.argmin(axis=1)).all()


def test_more_points_than_fit_one_block() -> None:
    points = np.column_stack([np.arange(70_000.0), np.zeros(70_000)])
    assert nearest_points(np.array([[69_999.4, 1.0], [3.4, 0.0]]), points).tolist() == [69_999, 3]


def test_of_equally_near_points_the_first_is_taken() -> None:
    assert nearest_points(np.array([[0.0, 0.0]]), np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])).tolist() == [0]
    assert nearest_points(SQUARE, np.tile(SQUARE, (3, 1))).tolist() == [0, 1, 2, 3]


def test_one_point_is_the_nearest_to_all_and_no_query_has_none() -> None:
    assert nearest_points(SQUARE, POINT).tolist() == [0, 0, 0, 0]
    assert nearest_distances(HOOK, POINT).tolist() == [dist(p, POINT[0]) for p in HOOK]
    assert nearest_points(np.zeros((0, 2)), SQUARE).tolist() == []


def test_arguments_may_be_read_only_and_are_not_written_to() -> None:
    path, times = HOOK.copy(), np.arange(4.0)
    path.setflags(write=False)
    times.setflags(write=False)
    for function in (step_lengths, arc_lengths, half_size, box_centre, unit_tangents, headings, wrap_angles):
        function(path)
    resample_path(path, 5)
    space_path(path, 0.5, closed=True)
    space_timed_path(path, times, 0.5)
    nearest_distances(path, path)
