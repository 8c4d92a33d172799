"""Measurements compare like with like; no clock is asked here."""

from __future__ import annotations

import numpy as np
import pytest

import signimit
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.people import synthetic_library
from signimit_envs import ENV_IDS
from signimit_envs.timing.measurements import (
    compare,
    compare_distances,
    compare_environment,
    installed_versions,
    plain_distances,
)


def small_session() -> signimit.DemonstrationSet:
    language = Language(repetitions=1)
    labels = (*PAPER_LANGUAGE.focus_signs, *PAPER_LANGUAGE.movement_signs)
    rng = np.random.default_rng(0)
    signs = synthetic_library(labels, samples=4, rng=rng)
    movements = synthetic_library(language.movements, samples=4, rng=rng)
    demonstrations, _ = compose_demonstrations(language, signs, movements, rng)
    return signimit.DemonstrationSet(list(demonstrations)[:2])


def test_plain_loops_by_hand() -> None:
    """Two straight ways at right angles: every direction differs by a quarter turn, in every pair of frames."""
    paths = [np.array([[0.0, 0], [1, 0], [2, 0]]), np.array([[0.0, 0], [0, 1], [0, 2]])]
    distances = plain_distances(paths, np.zeros((2, 1, 2)))
    np.testing.assert_allclose(distances[..., 0, 0], [[0, (np.pi / 2) ** 2], [(np.pi / 2) ** 2, 0]])


def test_the_core_and_the_plain_loops_agree() -> None:
    comparison, difference = compare_distances(small_session(), repetitions=1)
    assert difference < 1e-12
    assert comparison.ratio > 0


@pytest.mark.parametrize("env_id", ENV_IDS)
def test_environments_are_compared(env_id: str) -> None:
    comparison = compare_environment(env_id, repetitions=1)
    assert 0 < comparison.plain < comparison.ours


def test_both_ways_are_run_in_turns() -> None:
    runs: list[str] = []
    compare(lambda: runs.append("ours"), lambda: runs.append("plain"), repetitions=3)
    assert runs == ["ours", "plain"] * 3


def test_versions_are_told() -> None:
    assert installed_versions()["mujoco"]
