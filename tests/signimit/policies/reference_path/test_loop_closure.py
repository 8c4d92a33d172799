"""The jump between two rounds is mended; corners, spikes and loops that people mean are not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit.paths import space_path
from signimit.policies.reference_path.loop_closure import close_loop

STEP = 0.004
SQUARE = np.array([[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]])


def spaced(*corners: tuple[float, float]) -> NDArray[np.float64]:
    return space_path(np.array(corners), STEP, closed=True)


def mended(course: NDArray[np.float64]) -> NDArray[np.float64]:
    return close_loop(course, np.full(len(course), 0.3), 0.1)[0]


def turning(course: NDArray[np.float64]) -> float:
    """All turning of a closed course, rad: 2 pi if it only ever turns one way."""
    steps = np.diff(np.vstack([course, course[:2]]), axis=0)
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    return float(np.abs((np.diff(angles) + np.pi) % (2 * np.pi) - np.pi).sum())


def notched_circle(depth: float) -> NDArray[np.float64]:
    """A circle whose stroke ends ``depth`` m further in than it begins."""
    angles = np.linspace(0.0, 2 * np.pi, 150)
    radius = 0.1 - depth * angles / (2 * np.pi)
    return space_path(np.column_stack([radius * np.sin(angles), radius * np.cos(angles)]), STEP, closed=True)


@pytest.mark.parametrize("corners", [3, 4, 5, 60])
def test_polygons_are_left_alone_wherever_they_begin(corners: int) -> None:
    angles = 2 * np.pi * np.arange(corners) / corners
    course = space_path(0.1 * np.column_stack([np.cos(angles), np.sin(angles)]), STEP, closed=True)
    for first in (0, 7, len(course) // 2):
        rolled = np.roll(course, first, axis=0)
        np.testing.assert_array_equal(mended(rolled), rolled)


def test_a_star_is_left_alone() -> None:
    angles = 2 * np.pi * np.arange(5) * 2 / 5
    star = space_path(0.1 * np.column_stack([np.sin(angles), np.cos(angles)]), STEP, closed=True)
    np.testing.assert_array_equal(mended(star), star)


@pytest.mark.parametrize("depth", [0.012, 0.02, -0.02])
def test_the_notch_of_a_circle_that_does_not_close_is_smoothed(depth: float) -> None:
    course = notched_circle(depth)
    smooth = mended(course)
    assert turning(course) > 2 * np.pi + 1.5
    assert turning(smooth) < 2 * np.pi + 0.8
    assert np.hypot(*smooth.T).min() > min(0.1, 0.1 - depth) - 0.004
    assert np.hypot(*np.diff(np.vstack([smooth, smooth[:1]]), axis=0).T).max() < 2 * STEP


def test_a_corner_that_a_jump_has_cut_off_is_sharp_again() -> None:
    cut = spaced((-0.08, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1), (-0.1, -0.085), (-0.09, -0.075))
    course = mended(cut)
    assert np.hypot(*(course - [-0.1, -0.1]).T).min() < 0.006
    assert turning(course) < 2 * np.pi + 0.1


def test_running_past_the_beginning_and_coming_back_is_cut() -> None:
    there, again = (-0.075, -0.1), (-0.098, -0.101)
    course = mended(spaced((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), there, again))
    way = np.hypot(*np.diff(np.vstack([course, course[:1]]), axis=0).T).sum()
    assert 0.78 < way < 0.82


def test_a_spike_away_from_the_seam_stays() -> None:
    spike = spaced((-0.1, 0.1), (-0.1, -0.1), (0.0, -0.1), (0.0, -0.13), (0.0, -0.1), (0.1, -0.1), (0.1, 0.1))
    np.testing.assert_array_equal(mended(spike), spike)


def test_a_jump_is_made_no_faster_than_what_lies_about_it() -> None:
    course = notched_circle(0.02)
    speeds = np.where(np.arange(len(course)) < len(course) - 3, 0.3, 2.0)
    points, calm = close_loop(course, speeds, 0.1)
    assert len(points) == len(calm)
    assert np.count_nonzero(calm > 0.3) < np.count_nonzero(speeds > 0.3)


@settings(deadline=None, derandomize=True, max_examples=20)
@given(st.floats(-0.03, 0.03), st.floats(0, 2 * np.pi), st.floats(0.01, 100.0))
def test_mending_does_not_depend_on_where_the_table_is_turned_or_on_the_unit(
    depth: float, angle: float, unit: float
) -> None:
    course = notched_circle(depth)
    turn = unit * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = close_loop(course @ turn.T, np.ones(len(course)), 0.1 * unit)[0]
    np.testing.assert_allclose(turned, mended(course) @ turn.T, rtol=1e-6, atol=1e-7 * unit)


def test_a_course_of_few_nodes_or_of_one_place_is_mended_too() -> None:
    for course in (SQUARE, np.zeros((6, 2)), spaced(*SQUARE.tolist())[::10]):
        points, speeds = close_loop(course, np.ones(len(course)), 0.1)
        assert np.isfinite(points).all()
        assert len(points) == len(speeds)
