"""The plain loops that the core is timed against compute the same; their times are not looked at."""

from __future__ import annotations

import numpy as np

from signimit import dtw_distance, policy_distances
from signimit_envs.timing.core import plain_distances, plain_dtw, time_core


def test_plain_distances_by_hand() -> None:
    """Two straight ways at right angles: every direction differs by a quarter turn, in every pair of frames."""
    paths = [np.array([[0.0, 0], [1, 0], [2, 0]]), np.array([[0.0, 0], [0, 1], [0, 2]])]
    distances = plain_distances(paths, np.zeros((2, 1, 2)))
    np.testing.assert_allclose(distances[..., 0, 0], [[0, (np.pi / 2) ** 2], [(np.pi / 2) ** 2, 0]])


def test_the_core_and_the_plain_loops_agree() -> None:
    rng = np.random.default_rng(0)
    paths, objects = [rng.normal(size=(n, 2)).cumsum(axis=0) for n in (5, 12, 30)], rng.normal(size=(3, 2, 2))
    np.testing.assert_allclose(policy_distances(paths, objects), plain_distances(paths, objects), rtol=1e-12)
    np.testing.assert_allclose(dtw_distance(paths[1], paths[2]), plain_dtw(paths[1], paths[2]), rtol=1e-12)


def test_every_piece_of_the_core_is_timed() -> None:
    rows = time_core(seed=0, turns=1)
    assert [row.work for row in rows] == [
        "Δ of 12 paths",
        "dynamic time warping of two signs",
        "learning, method paper",
        "learning, method joint",
    ]
    assert all(row.seconds > 0 for row in rows)
    assert all(row.plain and row.ratio == row.seconds / row.plain for row in rows[:2])  # one turn: least is median
