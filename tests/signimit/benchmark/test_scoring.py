"""Scores are what a person would give."""

import numpy as np
import pytest

from signimit.benchmark.scoring import (
    InferenceVerdict,
    adjusted_rand_index,
    count_signs_read,
    judge_inference,
    same_partition,
    score_path,
)
from signimit.benchmark.shipped_sessions import get_session
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.statistics import Share
from signimit.inference import WordOrder
from signimit.learners.base import Reading, Understanding
from signimit.teaching.languages import Request

SESSION = get_session(SPLITS["paper"], 0)
TRUTH = SESSION.truth


def test_the_rand_index_is_scikit_learns() -> None:
    metrics = pytest.importorskip("sklearn.metrics")
    rng = np.random.default_rng(0)
    for groups in (1, 2, 3, 12):
        found, true = rng.integers(groups, size=12), rng.integers(3, size=12)
        assert adjusted_rand_index(found, true) == pytest.approx(metrics.adjusted_rand_score(true, found), abs=1e-12)


def test_the_rand_index_of_known_groupings() -> None:
    assert adjusted_rand_index([0, 0, 1, 1], [5, 5, 3, 3]) == 1.0
    assert adjusted_rand_index([0, 0, 0, 0], [0, 0, 1, 1]) == 0.0
    assert adjusted_rand_index([0, 1, 0, 1], [0, 0, 1, 1]) == pytest.approx(-0.5)
    assert adjusted_rand_index([0], [0]) == 1.0


def understood(**changes: object) -> Understanding:
    right = Understanding(TRUTH.movement, TRUTH.focus, WordOrder(0, 1))
    return right._replace(**changes)  # type: ignore[arg-type]


def test_understanding_everything_is_right_whatever_the_groups_are_called() -> None:
    right = InferenceVerdict(True, True, True, Share(12, 12), 1.0)
    assert judge_inference(understood(), TRUTH) == right
    assert judge_inference(understood(labels=2 - TRUTH.movement), TRUTH) == right
    assert right.all_right


def test_each_mistake_has_a_verdict_of_its_own() -> None:
    one_off = TRUTH.focus.copy()
    one_off[0] = (one_off[0] + 1) % 3
    assert judge_inference(understood(focus=one_off), TRUTH) == (True, False, True, Share(11, 12), 1)
    assert judge_inference(understood(word_order=WordOrder(1, 0)), TRUTH) == (True, True, False, Share(12, 12), 1)
    merged = judge_inference(understood(labels=np.zeros(12, np.int64)), TRUTH)
    assert merged == (False, True, True, Share(12, 12), 0)
    assert not merged.all_right


def test_partitions_are_the_same_whatever_the_groups_are_called() -> None:
    assert same_partition([0, 0, 1, 2], [5, 5, 0, 1])
    assert not same_partition([0, 0, 1, 1], [0, 0, 0, 1])
    assert not same_partition([0, 0, 0], [0, 0, 1])


def reading(movement: int, focus: int) -> Reading:
    return Reading(np.eye(3)[movement], np.eye(3)[focus])


def test_signs_are_counted_by_what_the_group_mostly_shows() -> None:
    renamed = understood(labels=2 - TRUTH.movement)
    assert count_signs_read(reading(2, 1), renamed, TRUTH, Request(0, 1)) == 2
    assert count_signs_read(reading(0, 1), renamed, TRUTH, Request(0, 1)) == 1
    assert count_signs_read(reading(0, 2), renamed, TRUTH, Request(0, 1)) == 0


def test_a_group_without_members_stands_for_nothing() -> None:
    merged = understood(labels=np.zeros(12, np.int64))
    assert count_signs_read(reading(1, 1), merged, TRUTH, Request(0, 1)) == 1


def test_a_demonstration_obeys_its_own_request_and_no_other() -> None:
    shown = SESSION.demonstrations[0]
    request = TRUTH.requests[0]
    command = SESSION.commands[0]._replace(objects=shown.objects, request=request)
    path = np.concatenate([shown.hand, shown.hand[len(shown.hand) // 2 :]])
    done = score_path(path, command, TRUTH.templates)
    assert done.obeyed
    assert done.misfit < 0.15
    other_object = score_path(
        path, command._replace(request=request._replace(focus=(request.focus + 1) % 3)), TRUTH.templates
    )
    other_movement = score_path(
        path, command._replace(request=request._replace(movement=(request.movement + 1) % 3)), TRUTH.templates
    )
    for wrong in (other_object, other_movement):
        assert not wrong.obeyed
        assert wrong.misfit > done.misfit


def test_a_hand_that_rests_has_the_worst_misfit() -> None:
    assert score_path(np.zeros((501, 2)), SESSION.commands[0], TRUTH.templates) == (False, 3.0)
