"""Paths by the way travelled."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit.paths import arc_lengths, space_course, space_path, unit_tangents
from signimit.strokes import Stroke

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def test_the_way_along_a_square() -> None:
    np.testing.assert_allclose(arc_lengths(SQUARE), np.arange(4.0))


def test_a_closed_course_is_spaced_all_the_way_round() -> None:
    course = space_course(SQUARE, 0.5, closed=True)
    expected = np.array([[0, 0], [0.5, 0], [1, 0], [1, 0.5], [1, 1], [0.5, 1], [0, 1], [0, 0.5]])
    np.testing.assert_allclose(course, expected, atol=1e-12)


def test_an_open_course_ends_where_it_ended() -> None:
    course = space_course(SQUARE, 0.5, closed=False)
    assert len(course) == 7
    np.testing.assert_allclose(course[-1], SQUARE[-1])


def test_a_pause_takes_time_and_no_way() -> None:
    stroke = Stroke(np.array([[0.0, 0], [1, 0], [1, 0], [2, 0]]), np.array([0.0, 1, 5, 6]))
    path = space_path(stroke, 0.5)
    np.testing.assert_allclose(path.points[:, 0], [0, 0.5, 1, 1.5, 2])
    np.testing.assert_allclose(path.times, [0, 0.5, 1, 3.5, 6])


def test_tangents_of_a_closed_square_at_its_corners_are_diagonal() -> None:
    np.testing.assert_allclose(unit_tangents(SQUARE, closed=True)[0], np.array([1, -1]) / np.sqrt(2))


@settings(deadline=None, derandomize=True, max_examples=25)
@given(shift=st.tuples(st.floats(-1, 1), st.floats(-1, 1)), scale=st.floats(0.1, 10))
def test_spacing_moves_and_grows_with_the_course(shift: tuple[float, float], scale: float) -> None:
    plain = space_course(SQUARE, 0.3, closed=True)
    moved = space_course(SQUARE * scale + shift, 0.3 * scale, closed=True)
    np.testing.assert_allclose(moved, plain * scale + shift, atol=1e-9)
