"""Overshoots are cut, spikes, loops and corners are not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.policies.arclength import space_course
from signimit.policies.overshoot import without_overshoot

SQUARE = np.array([[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]])


def spaced(*corners: tuple[float, float]) -> NDArray[np.float64]:
    return space_course(np.array(corners), 0.004, closed=True)


def test_a_square_is_left_alone() -> None:
    course = space_course(SQUARE, 0.004, closed=True)
    assert len(without_overshoot(course, 0.1)) == len(course)


def test_running_past_the_beginning_and_coming_back_is_cut() -> None:
    there, again = (-0.075, -0.1), (-0.098, -0.101)
    course = spaced((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), there, again)
    kept = course[without_overshoot(course, 0.1)]
    way = np.hypot(*np.diff(np.vstack([kept, kept[:1]]), axis=0).T).sum()
    assert len(kept) < len(course) - 8
    assert 0.78 < way < 0.82


def test_a_spike_and_a_star_stay() -> None:
    spike = spaced((-0.1, -0.1), (0.0, -0.1), (0.0, -0.13), (0.0, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1))
    angles = 2 * np.pi * np.arange(5) * 2 / 5
    star = space_course(0.1 * np.column_stack([np.sin(angles), np.cos(angles)]), 0.004, closed=True)
    for course in (spike, star):
        assert len(without_overshoot(course, 0.1)) == len(course)


def test_a_small_round_loop_stays() -> None:
    angles = np.linspace(0, 2 * np.pi, 40)
    loop = np.array([0.0, -0.08]) + 0.02 * np.column_stack([np.sin(angles), -np.cos(angles)])
    course = space_course(np.concatenate([SQUARE[:1], loop, SQUARE[1:]]), 0.004, closed=True)
    assert len(without_overshoot(course, 0.1)) == len(course)
