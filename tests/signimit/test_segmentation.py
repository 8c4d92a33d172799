"""Reaches and ways home are told from drawings."""

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.segmentation import find_drawing, find_stops

Array = NDArray[np.float64]
PERIOD = 0.02  # s


def _way(start: Array, goal: Array, bend: float = 0.0) -> Array:
    """A minimum-jerk way, without its goal; ``bend`` is how far its middle is aside, in lengths."""
    s = np.linspace(0, 1, 40, endpoint=False)[:, None]
    along = 10 * s**3 - 15 * s**4 + 6 * s**5
    aside = np.array([[-1.0, 1.0]]) * (goal - start)[::-1]
    return start + along * (goal - start) + bend * np.sin(np.pi * along) * aside


def _circle(rounds: float = 1.0) -> Array:
    angle = np.linspace(0, 2 * np.pi * rounds, int(100 * rounds))
    ease = 10 * (angle / angle[-1]) ** 3 - 15 * (angle / angle[-1]) ** 4 + 6 * (angle / angle[-1]) ** 5
    return 0.1 * np.column_stack([np.cos(ease * angle[-1]), np.sin(ease * angle[-1])])


def _triangle() -> Array:
    corners = 0.1 * np.array([[0.0, 1.0], [-0.9, -0.5], [0.9, -0.5], [0.0, 1.0]])
    return np.concatenate([_way(a, b) for a, b in itertools.pairwise(corners)] + [corners[-1:]])


def _found(path: Array) -> tuple[int, int]:
    part = find_drawing(path, PERIOD * np.arange(len(path)))
    return part.start, part.stop


@pytest.mark.parametrize("drawing", [_circle(), _circle(2), _triangle()], ids=["circle", "two rounds", "triangle"])
@pytest.mark.parametrize("bend", [0.0, 0.15], ids=["straight", "curved"])
def test_reach_and_way_home_are_taken_away(drawing: Array, bend: float) -> None:
    start = np.array([-0.3, -0.2])
    there = _way(start, drawing[0], bend)
    home = np.concatenate([_way(drawing[-1], start), start[None]])
    begin, end = _found(np.concatenate([there, drawing]))
    assert abs(begin - len(there)) <= 3
    assert end == len(there) + len(drawing)
    begin, end = _found(np.concatenate([there, drawing, home]))
    assert abs(begin - len(there)) <= 3
    assert abs(end - len(there) - len(drawing)) <= 3


def test_a_triangle_drawn_where_the_hand_is_stays_whole() -> None:
    triangle = _triangle()
    assert _found(triangle) == (0, len(triangle))


def test_a_line_is_all_drawing() -> None:
    line = _way(np.zeros(2), np.array([0.2, 0.1]))
    assert _found(line) == (0, len(line))
    assert _found(line[[0, -1]]) == (0, 2)
    assert _found(np.zeros((5, 2))) == (0, 5)


def test_shift_size_and_pace_change_nothing() -> None:
    path = np.concatenate([_way(np.array([-0.3, 0.1]), _circle()[0]), _circle()])
    times = PERIOD * np.arange(len(path))
    wanted = find_drawing(path, times)
    assert find_drawing(3 * path + 0.7, times) == find_drawing(path, 10 + times) == wanted


def test_stops_are_where_a_hand_rests() -> None:
    triangle = _triangle()
    assert find_stops(triangle, PERIOD * np.arange(float(len(triangle)))).tolist() == pytest.approx([40, 80], abs=2)


def test_times_of_another_length_are_refused() -> None:
    with pytest.raises(InvalidInputError, match="times"):
        find_drawing(np.zeros((5, 2)), np.arange(4.0))
