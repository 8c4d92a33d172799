"""The study of all kinds, and its measures."""

from __future__ import annotations

import numpy as np
import pytest

from signimit.benchmark.studies.path_quality import (
    arrives_and_stays,
    back_after_shove,
    corner_gap,
    detour,
    judge_path,
    speed_agreement,
)
from signimit.benchmark.studies.policies import StudyPlan, compose_lessons, run_study, study_table, summarise
from signimit.exceptions import InvalidInputError
from signimit.teaching.people import synthetic_library

ANGLES = 2 * np.pi * np.arange(100) / 100
CIRCLE = 0.1 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
TWELVE_SECONDS = np.tile(CIRCLE, (6, 1))


def test_the_demonstrated_loop_itself_is_a_perfect_drawing() -> None:
    conduct = judge_path(TWELVE_SECONDS, [CIRCLE, CIRCLE])
    assert conduct.draws
    assert conduct.misfit < 0.03
    assert conduct.corner_gap < 0.03
    assert conduct.speed_ratio == pytest.approx(1, rel=0.01)


def test_a_path_elsewhere_or_at_rest_does_not_draw() -> None:
    assert not judge_path(TWELVE_SECONDS + 0.2, [CIRCLE]).draws
    assert not judge_path(np.zeros((100, 2)), [CIRCLE]).draws


def test_a_straight_way_is_no_detour_and_a_zigzag_is_one() -> None:
    straight = np.linspace([0.5, 0.0], [0.1, 0.0], 50)
    bent = np.concatenate([np.linspace([0.5, 0.0], [0.5, 0.4], 50), np.linspace([0.5, 0.4], [0.1, 0.0], 50)])
    assert detour(straight, CIRCLE) == pytest.approx(0.96, abs=0.02)
    assert detour(bent, CIRCLE) > 2
    assert np.isnan(detour(CIRCLE, CIRCLE))


def test_cut_corners_leave_a_gap() -> None:
    square = np.array([[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1]])
    assert corner_gap(CIRCLE, square) == pytest.approx(0.41, abs=0.03)


def test_speed_is_compared_place_by_place() -> None:
    slow_and_fast = np.cumsum(np.column_stack([np.repeat([0.002, 0.006], 50), np.zeros(100)]), axis=0)
    correlation, ratio = speed_agreement(slow_and_fast, [slow_and_fast])
    assert correlation > 0.95
    assert ratio == pytest.approx(1, rel=0.02)


def test_back_after_a_shove_and_arrived_are_counted_hand_by_hand() -> None:
    path = np.tile(CIRCLE, (6, 1))[:, None] + np.array([[0.0, 0.0], [0.3, 0.0]])
    np.testing.assert_array_equal(back_after_shove(path, [CIRCLE]), [1, 0])
    still = np.zeros((60, 2, 2)) + np.array([[0.0, 0.0], [0.03, 0.0]])
    np.testing.assert_array_equal(arrives_and_stays(still, np.zeros(2), 0.02), [1, 0])


def test_a_small_study_has_a_row_for_each_kind_and_the_default_wins() -> None:
    labels = ("circle", "reach from above")
    library = synthetic_library(labels, writers=1, samples=8, rng=np.random.default_rng(0))
    plan = StudyPlan(labels=labels, sessions=1, starts=3)
    trials = list(run_study(library, plan, ("path-following", "knn")))
    assert [(t.kind, t.label) for t in trials] == [(k, label) for label in labels for k in ("path-following", "knn")]
    ours, theirs = summarise(trials, plan.starts)
    assert ours.measures["drawn"][0] == ours.measures["arrived"][0] == ours.measures["on_table"][0] == 1
    assert ours.measures["misfit"][0] < 0.1
    assert theirs.kind == "knn"
    table = study_table([ours, theirs])
    assert table.count("\n") == 3
    assert "| path-following | 2 | 6 | 100.0 % [20.7, 100.0] |" in table


def test_the_same_plan_gives_the_same_lessons() -> None:
    library = synthetic_library(("star",), writers=2, samples=8, rng=np.random.default_rng(0))
    plan = StudyPlan(labels=("star",), sessions=2)
    for (_, a), (_, b) in zip(compose_lessons(library, plan), compose_lessons(library, plan), strict=True):
        np.testing.assert_array_equal(np.concatenate(a.paths), np.concatenate(b.paths))
        np.testing.assert_array_equal(a.hands, b.hands)


def test_an_empty_plan_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="sessions"):
        StudyPlan(labels=("circle",), sessions=0)
