"""Means of passes."""

from __future__ import annotations

import numpy as np

from signimit.paths import TimedPath
from signimit.policies.reference_path.averaging import Pass, cut_passes, mean_pass


def test_two_rounds_are_cut_where_the_phase_begins_anew() -> None:
    path = TimedPath(np.column_stack([np.arange(7.0), np.zeros(7)]), np.arange(7.0))
    first, second = cut_passes(path, np.array([-1, 1, 2, 3, 4, 5, -1]), 3)
    np.testing.assert_array_equal(first.points[:, 0], [np.nan, 1, 2])
    np.testing.assert_array_equal(second.points[:, 0], [3, 4, 5])
    np.testing.assert_allclose(first.speeds, [np.nan, 1, 1])
    np.testing.assert_allclose(second.speeds, [1, 1, np.nan])


def test_skipped_nodes_are_interpolated_and_repeated_ones_averaged() -> None:
    path = TimedPath(np.array([[0.0, 0], [2, 0], [4, 0], [6, 0]]), np.array([0.0, 1, 2, 3]))
    (one,) = cut_passes(path, np.array([0, 0, 2, 3]), 4)
    np.testing.assert_allclose(one.points[:, 0], [1, 2.5, 4, 6])
    np.testing.assert_allclose(one.speeds[:3], 2)


def test_too_short_a_pass_is_no_pass() -> None:
    path = TimedPath(np.column_stack([np.arange(5.0), np.zeros(5)]), np.arange(5.0))
    assert len(list(cut_passes(path, np.arange(5), 4, shortest=0.5))) == 1


def test_the_mean_of_like_passes_is_their_mean() -> None:
    rng = np.random.default_rng(0)
    points = np.ones((3, 5, 2)) + np.array([-0.01, 0.0, 0.01])[:, None, None]
    passes = [Pass(p, rng.uniform(1, 2, 5)) for p in points]
    mean = mean_pass(passes, np.ones((5, 2)), 1.0, closed=True)
    np.testing.assert_allclose(mean.points, 1.0, atol=1e-4)
    np.testing.assert_allclose(mean.speeds, np.mean([p.speeds for p in passes], axis=0), rtol=0.01)


def test_one_bad_pass_of_four_hardly_counts() -> None:
    rng = np.random.default_rng(0)
    passes = [Pass(rng.normal(0, 0.01, (20, 2)), np.ones(20)) for _ in range(3)]
    passes.append(Pass(np.full((20, 2), 1.0), np.ones(20)))
    for first in passes[:3]:
        assert np.abs(mean_pass(passes, first.points, 1.0, closed=True).points).max() < 0.03


def test_where_nobody_went_there_is_no_support() -> None:
    hole = np.array([[0.0, 0], [np.nan, np.nan], [1, 1]])
    mean = mean_pass([Pass(hole, np.ones(3))] * 2, np.nan_to_num(hole), 1.0, closed=True)
    np.testing.assert_array_equal(mean.points, [[0, 0], [1, 1]])


def test_drawings_that_are_nothing_alike_are_not_averaged() -> None:
    rng = np.random.default_rng(0)
    shapes = rng.normal(0, 1, (5, 20, 2))
    for shape in shapes:
        mean = mean_pass([Pass(s, np.ones(20)) for s in shapes], shape, 1.0, closed=False)
        np.testing.assert_allclose(mean.points, shape, atol=1e-6)


def test_a_pass_that_goes_half_the_way_does_not_bend_the_course() -> None:
    whole = np.column_stack([np.linspace(0, 1, 20), np.zeros(20)])
    half = np.where(np.arange(20)[:, None] < 10, np.nan, whole + np.array([0.0, 0.1]))
    mean = mean_pass([Pass(whole, np.ones(20)), Pass(half, np.ones(20))], whole, 1.0, closed=False)
    np.testing.assert_allclose(mean.points, whole, atol=1e-3)


def test_ends_that_one_of_three_passes_reaches_are_cut_off() -> None:
    whole = np.column_stack([np.linspace(0, 1, 20), np.zeros(20)])
    most = np.where((np.arange(20)[:, None] < 1) | (np.arange(20)[:, None] > 18), np.nan, whole)
    mean = mean_pass([Pass(p, np.ones(20)) for p in (whole, most, most)], whole, 10.0, closed=False)
    np.testing.assert_allclose(mean.points, whole[1:19], atol=1e-6)
