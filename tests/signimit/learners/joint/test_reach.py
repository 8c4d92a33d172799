"""The reach is told from the drawing."""

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.learners.joint.reach import find_drawing_start
from signimit.teaching.composition import compose_loops, compose_path
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]
CLOSED = ("circle", "triangle up", "square", "star", "figure eight")


def demonstration(label: str, seed: int) -> tuple[Array, int]:
    """A hand that reaches and draws twice, and where the drawing begins."""
    rng = np.random.default_rng(seed)
    language = Language(movements=(label,), movement_signs=("4",), unseen=())
    loops = compose_loops(language, synthetic_library((label,), samples=2, rng=rng), 0, rng)
    path = compose_path(loops[0][0] + 0.2 * np.array([np.cos(seed), np.sin(seed)]), loops)
    return path, int(np.argmin(np.linalg.norm(path - loops[0][0], axis=1)))


@pytest.mark.parametrize("label", CLOSED)
def test_the_reach_to_a_drawing_is_found(label: str) -> None:
    """Within a sixth of the way: what lies between reach and drawing may be called either."""
    for seed in range(6):
        path, true = demonstration(label, seed)
        way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
        assert abs(way[find_drawing_start(path)] - way[true]) < way[-1] / 6


def test_a_path_that_never_returns_is_all_drawing() -> None:
    line = np.linspace([0.0, 0.0], [0.3, 0.1], 80)
    angles = np.linspace(0, 0.8 * 2 * np.pi, 80)
    bow = np.column_stack([np.cos(angles), np.sin(angles)])
    assert find_drawing_start(line) == find_drawing_start(bow) == find_drawing_start(line[[0, -1]]) == 0


def test_a_drawing_without_a_reach_begins_at_once() -> None:
    angles = np.linspace(0, 6 * np.pi, 200)
    assert find_drawing_start(np.column_stack([np.cos(angles), np.sin(angles)])) <= 5


@pytest.mark.parametrize("seed", range(4))
def test_shift_size_and_rotation_change_nothing(seed: int) -> None:
    path, _ = demonstration("triangle up", seed)
    quarter = np.array([[0.0, 1.0], [-1.0, 0.0]])
    assert find_drawing_start(path) == find_drawing_start(3 * path + [0.5, -0.25]) == find_drawing_start(path @ quarter)


def test_at_least_two_points_are_left() -> None:
    rng = np.random.default_rng(0)
    for count in (2, 3, 5, 30):
        for _ in range(20):
            assert 0 <= find_drawing_start(rng.normal(size=(count, 2))) <= count - 2
