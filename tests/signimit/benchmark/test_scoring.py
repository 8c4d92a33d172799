"""Scores are what a person would give."""

import numpy as np
import pytest

from signimit.benchmark.scoring import Judge, adjusted_rand_index, count_signs_read, score_understanding
from signimit.benchmark.shipped_sessions import get_session
from signimit.benchmark.splits import SPLITS
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


def test_understanding_everything_scores_one_whatever_the_groups_are_called() -> None:
    assert score_understanding(understood(), TRUTH) == (1, 1, 1)
    assert score_understanding(understood(labels=2 - TRUTH.movement), TRUTH) == (1, 1, 1)


def test_each_mistake_lowers_its_own_score() -> None:
    one_off = TRUTH.focus.copy()
    one_off[0] = (one_off[0] + 1) % 3
    assert score_understanding(understood(focus=one_off), TRUTH) == (1, 11 / 12, 1)
    assert score_understanding(understood(word_order=WordOrder(1, 0)), TRUTH) == (1, 1, 0)
    assert score_understanding(understood(labels=np.zeros(12, np.int64)), TRUTH) == (0, 1, 1)


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
    judge, shown = Judge(TRUTH.templates), SESSION.demonstrations[0]
    request = TRUTH.requests[0]
    command = SESSION.commands[0]._replace(objects=shown.objects, request=request)
    path = np.concatenate([shown.hand, shown.hand[len(shown.hand) // 2 :]])
    done = judge.judge(path, command)
    assert done.obeyed
    assert done.misfit < 0.15
    other_object = judge.judge(path, command._replace(request=request._replace(focus=(request.focus + 1) % 3)))
    other_movement = judge.judge(path, command._replace(request=request._replace(movement=(request.movement + 1) % 3)))
    for wrong in (other_object, other_movement):
        assert not wrong.obeyed
        assert wrong.misfit > done.misfit


def test_a_hand_that_rests_has_the_worst_misfit() -> None:
    assert Judge(TRUTH.templates).judge(np.zeros((501, 2)), SESSION.commands[0]) == (False, 1.0)
