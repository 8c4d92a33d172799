"""The shared course of demonstrations, against what was drawn."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from signimit.paths import half_size
from signimit.policies.base import check_demonstrations
from signimit.policies.reference_path.reference_path import (
    CORNER_ALLOWANCE,
    MOST_NODES,
    ReferencePath,
    learn_reference_path,
    sample_reference_path,
)
from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS

Array = NDArray[np.float64]
Compose = Callable[..., Any]
LINE = np.column_stack([np.arange(11) / 10, np.zeros(11)])


def learn(shown: Any) -> ReferencePath:
    return learn_reference_path(check_demonstrations(shown.paths, shown.times))


def misfit(course: ReferencePath, loop: Array) -> float:
    """Mean distance between the nodes and a drawn loop, both ways, in half sizes."""
    gaps = cdist(course.points, loop)
    return float(gaps.min(axis=1).mean() + gaps.min(axis=0).mean()) / (2 * half_size(loop))


@pytest.mark.parametrize("label", MOVEMENT_LABELS)
def test_the_drawing_is_found_and_the_reach_left_out(label: str, shown: Compose) -> None:
    demonstrations = shown(label)
    course = learn(demonstrations)
    assert course.closed
    assert np.median([misfit(course, loop) for loop in demonstrations.loops]) < 0.12
    steps = np.hypot(*np.diff(course.points, axis=0, append=course.points[:1]).T)
    period = (steps / course.speeds)[course.speeds > 0].sum()
    assert period == pytest.approx(0.02 * np.mean([len(loop) for loop in demonstrations.loops]), rel=0.4)


@pytest.mark.parametrize("label", GOAL_LABELS)
def test_a_reach_ends_at_the_object_and_does_not_repeat(label: str, shown: Compose) -> None:
    course = learn(shown(label))
    assert not course.closed
    assert np.hypot(*course.points[-1]) < 0.01


def test_the_order_of_demonstrations_hardly_matters(shown: Compose) -> None:
    demonstrations = shown("star")
    forth, back = learn(demonstrations), learn(type(demonstrations)(*(part[::-1] for part in demonstrations)))
    assert np.median(cdist(forth.points, back.points).min(axis=1)) < 0.005


def test_a_course_moves_and_grows_with_its_demonstrations(shown: Compose) -> None:
    demonstrations = shown("figure eight", 2)
    plain = learn(demonstrations)
    grown = learn(demonstrations._replace(paths=[2 * p + [0.5, -0.3] for p in demonstrations.paths]))
    np.testing.assert_allclose(grown.points, 2 * plain.points + [0.5, -0.3], atol=1e-6)
    assert grown.reach_speed == pytest.approx(2 * plain.reach_speed)
    assert grown.half_size == pytest.approx(2 * plain.half_size)


@pytest.mark.parametrize("label", MOVEMENT_LABELS)
def test_its_half_size_is_that_of_the_typical_drawing(label: str, shown: Compose) -> None:
    demonstrations = shown(label)
    typical = np.median([half_size(loop) for loop in demonstrations.loops])
    assert learn(demonstrations).half_size == pytest.approx(typical, rel=0.05)


def test_half_as_fast_is_half_the_speed(shown: Compose) -> None:
    """Not to the last digit: a stop is told from tremor in seconds, so the reach of a slow hand ends a sample apart."""
    demonstrations = shown("square", 3)
    plain = learn(demonstrations)
    slow = learn(demonstrations._replace(times=[2 * t for t in demonstrations.times]))
    assert cdist(slow.points, plain.points).min(axis=1).max() < 0.03 * plain.half_size
    assert (1 / slow.speeds).mean() == pytest.approx(2 * (1 / plain.speeds).mean(), rel=0.02)


def test_a_wrong_member_of_four_does_no_harm(shown: Compose) -> None:
    right, wrong = shown("triangle up", 3, seed=1), shown("zigzag", 1, seed=2)
    course = learn(right._replace(paths=right.paths + wrong.paths, times=right.times + wrong.times))
    assert np.median([misfit(course, loop) for loop in right.loops]) < 0.12


def test_a_wrong_frame_among_four_does_no_harm(shown: Compose) -> None:
    right = shown("triangle down", 4, seed=1)
    course = learn(right._replace(paths=[right.paths[0] + [0.2, 0.1], *right.paths[1:]]))
    assert np.median([misfit(course, loop) for loop in right.loops[2:]]) < 0.12


def test_reach_speed_is_that_of_the_reach() -> None:
    angles = np.linspace(0, 4 * np.pi, 200, endpoint=False)
    loops = 0.1 * np.column_stack([np.cos(angles), np.sin(angles)])
    paths = [
        np.concatenate([np.linspace(start, loops[0], 30, endpoint=False), loops]) for start in ([0.4, 0.1], [0.4, -0.1])
    ]
    course = learn_reference_path(check_demonstrations(paths, [0.02 * np.arange(230)] * 2))
    expected = np.hypot(0.3, 0.1) / 0.6
    assert course.reach_speed == pytest.approx(expected, rel=0.05)


def test_an_even_course_gets_even_nodes_a_control_period_apart() -> None:
    nodes = sample_reference_path(ReferencePath(LINE, np.ones(11), False, 0.5, 1.0))
    np.testing.assert_allclose(nodes[:, 0], np.linspace(0, 1, 51), atol=1e-12)


def test_a_slow_part_gets_more_nodes() -> None:
    nodes = sample_reference_path(ReferencePath(LINE, np.where(np.arange(11) < 5, 1.5, 0.5), False, 0.5, 1.0))
    steps = np.diff(nodes[:, 0])
    np.testing.assert_allclose(steps[:10].mean() / steps[-10:].mean(), 3, rtol=0.05)


def test_a_pause_is_shortened_and_a_glitch_slowed() -> None:
    for glitch in (1e-9, 1e9):
        speeds = np.ones(11)
        speeds[5] = glitch
        nodes = sample_reference_path(ReferencePath(LINE, speeds, False, 0.5, 1.0))
        assert len(nodes) * 0.02 < 3.0
        assert np.hypot(*np.diff(nodes, axis=0).T).min() > 0


def test_a_course_of_hours_is_followed_in_minutes() -> None:
    assert len(sample_reference_path(ReferencePath(LINE, np.full(11, 1e-6), False, 0.5, 1.0))) == MOST_NODES + 1


def test_a_speed_that_nobody_showed_is_the_mean_speed() -> None:
    nodes = sample_reference_path(ReferencePath(LINE, np.where(np.arange(11) < 6, 1.0, 0.0), False, 0.5, 1.0))
    np.testing.assert_allclose(nodes[:, 0], np.linspace(0, 1, 51), atol=1e-12)


def test_a_closed_course_is_grown_about_its_middle_by_the_allowance() -> None:
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    nodes = sample_reference_path(ReferencePath(square, np.full(4, 1.0), True, 0.5, 1.0))
    np.testing.assert_allclose(np.ptp(nodes, axis=0), CORNER_ALLOWANCE)
    np.testing.assert_allclose((nodes.min(axis=0) + nodes.max(axis=0)) / 2, 0.5)
