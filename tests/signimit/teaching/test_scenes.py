"""Scenes, reaches and drawn paths."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from signimit import InvalidInputError, Stroke
from signimit.teaching.scenes import drawn_path, reaching_path, sample_hand, sample_scene, sample_times


@given(seed=st.integers(0, 2**32), objects=st.integers(1, 5))
@settings(deadline=None, derandomize=True, max_examples=40)
def test_objects_are_on_the_table_and_apart(seed: int, objects: int) -> None:
    scene = sample_scene(np.random.default_rng(seed), objects)
    assert scene.shape == (objects, 2)
    assert (np.abs(scene) <= (0.22, 0.18)).all()
    gaps = [np.hypot(*(a - b)) for i, a in enumerate(scene) for b in scene[:i]]
    assert min(gaps, default=1.0) >= 0.14


def test_too_many_objects_are_refused() -> None:
    with pytest.raises(InvalidInputError, match=r"objects that fit 0\.14 m apart, found 40"):
        sample_scene(np.random.default_rng(0), 40)


def test_a_hand_starts_on_the_table() -> None:
    hands = np.array([sample_hand(np.random.default_rng(seed)) for seed in range(50)])
    assert (np.abs(hands) <= (0.22, 0.18)).all()


def test_a_reach_is_straight_slow_at_its_ends_and_stops_just_short() -> None:
    path = reaching_path(np.array([0.1, 0.0]), np.array([0.1, 0.35]))
    assert len(path) == 50  # 0.35 m at 0.35 m/s every 20 ms
    assert_allclose(path[:, 0], 0.1)
    speed = np.diff(path[:, 1])
    assert (speed > 0).all()
    assert speed.argmax() in (24, 25)
    assert path[25, 1] == pytest.approx(0.175)  # half the way in half the time
    assert 0.3499 < path[-1, 1] < 0.35


def test_a_drawn_path_is_centred_scaled_and_keeps_the_persons_rhythm() -> None:
    times = np.array([0.0, 0.5, 2.0])
    path = drawn_path(Stroke(np.array([(10, 10), (30, 10), (30, 50.0)]), times), half_size=0.1)
    assert_allclose(path.min(axis=0), (-0.05, -0.1))
    assert_allclose(path.max(axis=0), (0.05, 0.1))
    corner = np.abs(path - (0.05, -0.1)).sum(axis=1).argmin()
    assert corner / (len(path) - 1) == pytest.approx(0.25, abs=0.02)


@pytest.mark.parametrize(("duration", "expected"), [(0.1, 0.4), (0.7, 0.4 / 1.4), (60.0, 0.2)])
def test_drawings_are_brought_to_the_speed_of_a_hand(duration: float, expected: float) -> None:
    length = 0.2
    points = np.column_stack([np.linspace(0, 1, 80), np.zeros(80)])
    path = drawn_path(Stroke(points, np.linspace(3, 3 + duration, 80)), half_size=length / 2)
    mean_speed = length / (0.02 * (len(path) - 1))
    assert mean_speed == pytest.approx(expected, rel=0.03)


@given(shift=st.floats(-50, 50), scale=st.floats(0.01, 100), delay=st.floats(0, 1e3))
@settings(deadline=None, derandomize=True, max_examples=25)
def test_where_how_large_and_when_a_stroke_was_drawn_does_not_matter(shift: float, scale: float, delay: float) -> None:
    angle = np.linspace(0, 6, 40)
    points, times = np.column_stack([np.cos(angle), np.sin(angle)]), np.linspace(0, 1.8, 40)
    moved = drawn_path(Stroke(points * scale + shift, times + delay), 0.1)
    assert_allclose(moved, drawn_path(Stroke(points, times), 0.1), atol=1e-8)


def test_a_goal_directed_drawing_ends_at_the_object() -> None:
    path = drawn_path(Stroke(np.array([(-3, 0), (0, 1.0)]), np.array([0, 1.0])), 0.1, end_at_object=True)
    assert_allclose(path[-1], 0, atol=1e-12)
    assert path[0, 0] == pytest.approx(-0.2)


def test_hand_paths_are_sampled_at_fifty_hertz() -> None:
    assert_allclose(sample_times(3), [0, 0.02, 0.04])
