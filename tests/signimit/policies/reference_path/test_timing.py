"""Courses laid out in time."""

from __future__ import annotations

import numpy as np

from signimit.policies.reference_path.reference_path import ReferencePath
from signimit.policies.reference_path.timing import CORNER_ALLOWANCE, MOST_NODES, time_course

LINE = np.column_stack([np.arange(11) / 10, np.zeros(11)])


def test_an_even_course_gets_even_nodes_a_control_period_apart() -> None:
    nodes = time_course(ReferencePath(LINE, np.ones(11), False, 0.5, 1.0))
    np.testing.assert_allclose(nodes[:, 0], np.linspace(0, 1, 51), atol=1e-12)


def test_a_slow_part_gets_more_nodes() -> None:
    nodes = time_course(ReferencePath(LINE, np.where(np.arange(11) < 5, 1.5, 0.5), False, 0.5, 1.0))
    steps = np.diff(nodes[:, 0])
    np.testing.assert_allclose(steps[:10].mean() / steps[-10:].mean(), 3, rtol=0.05)


def test_a_pause_is_shortened_and_a_glitch_slowed() -> None:
    for glitch in (1e-9, 1e9):
        speeds = np.ones(11)
        speeds[5] = glitch
        nodes = time_course(ReferencePath(LINE, speeds, False, 0.5, 1.0))
        assert len(nodes) * 0.02 < 3.0
        assert np.hypot(*np.diff(nodes, axis=0).T).min() > 0


def test_a_course_of_hours_is_followed_in_minutes() -> None:
    assert len(time_course(ReferencePath(LINE, np.full(11, 1e-6), False, 0.5, 1.0))) == MOST_NODES + 1


def test_a_speed_that_nobody_showed_is_the_mean_speed() -> None:
    nodes = time_course(ReferencePath(LINE, np.where(np.arange(11) < 6, 1.0, 0.0), False, 0.5, 1.0))
    np.testing.assert_allclose(nodes[:, 0], np.linspace(0, 1, 51), atol=1e-12)


def test_a_closed_course_is_grown_about_its_middle_by_the_allowance() -> None:
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    nodes = time_course(ReferencePath(square, np.full(4, 1.0), True, 0.5, 1.0))
    np.testing.assert_allclose(np.ptp(nodes, axis=0), CORNER_ALLOWANCE)
    np.testing.assert_allclose((nodes.min(axis=0) + nodes.max(axis=0)) / 2, 0.5)
