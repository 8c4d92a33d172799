"""Constants are measured without the people they are tested on."""

from collections.abc import Sequence

import numpy as np
import pytest

pytest.importorskip("sklearn", reason="the study needs scikit-learn")

from signimit.benchmark.splits import FOCUS_SIGNS, MOVEMENT_SIGNS, SYNTHETIC_MOVEMENTS
from signimit.benchmark.studies import left_out_people as folds
from signimit.benchmark.studies.conditions import REAL_MOVEMENTS, Recordings
from signimit.benchmark.studies.drawing_weights import DrawingPairs
from signimit.benchmark.studies.left_out_people import leave_people_out, measured_learner
from signimit.exceptions import InvalidInputError
from signimit.learners.joint.distance_model import SIGNS
from signimit.learners.joint.drawing_dissimilarity import DRAWINGS
from signimit.learners.joint.learner import JointLearner
from signimit.strokes import StrokeLibrary
from signimit.teaching.people import synthetic_library


@pytest.fixture(scope="module")
def recordings() -> Recordings:
    """Two who move and two who sign; what real people draw is played by other shapes."""
    rng = np.random.default_rng(0)
    labels = tuple(dict.fromkeys((*FOCUS_SIGNS, *MOVEMENT_SIGNS)))
    drawn = synthetic_library(SYNTHETIC_MOVEMENTS[: len(REAL_MOVEMENTS)], writers=2, samples=10, rng=rng)
    played = dict(zip(SYNTHETIC_MOVEMENTS, REAL_MOVEMENTS, strict=False))
    movements = StrokeLibrary(drawn.strokes, tuple(played[x] for x in drawn.labels), drawn.writers, drawn.source)
    return Recordings(synthetic_library(labels, writers=2, samples=10, rng=rng), movements)


@pytest.fixture(autouse=True)
def few_sessions(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(folds, "_MEASURING", 3)
    monkeypatch.setattr(folds, "TESTED", ((3, 2, 1),))


def test_measured_equals_are_nearer_than_others_and_chosen_shares_stay(recordings: Recordings) -> None:
    learner = measured_learner(recordings)
    assert learner.signs.equal_mean + learner.signs.equal_spread < learner.signs.other_mean
    assert learner.signs.odd_share == SIGNS.odd_share
    assert learner.signs.equal_mean != SIGNS.equal_mean
    assert learner.drawings.weights.shape == DRAWINGS.weights.shape
    assert not np.allclose(learner.drawings.weights, DRAWINGS.weights)


def test_further_people_have_their_say_about_drawings(recordings: Recordings) -> None:
    """Of strangers who all draw one thing in the same way, and never anything like it, nearness says much."""
    further = DrawingPairs("strangers", np.eye(2, 13), np.array([True, False]), 1000.0)
    alone, with_them = (measured_learner(recordings, more).drawings.weights for more in ((), [further]))
    assert with_them[1] - with_them[0] > alone[1] - alone[0]
    assert with_them[0] < 0 < with_them[1]


def test_everybody_who_moves_is_left_out_once(recordings: Recordings, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Recordings] = []

    def spy(others: Recordings, strangers: Sequence[DrawingPairs]) -> JointLearner:
        asked.append(others)
        return JointLearner()

    monkeypatch.setattr(folds, "measured_learner", spy)
    rows = list(leave_people_out(recordings, 2))
    assert [row.mover for row in rows] == sorted(set(recordings.movements.writers))
    for row, others in zip(rows, asked, strict=True):
        assert row.mover not in others.movements.writers
        assert len(set(others.signs.writers)) == 1
        assert row.right_without == row.right_shipped == row.sessions == 2
        assert row.drawings_without == row.drawings_shipped > 0.99


def test_nobody_is_left_out_where_nobody_would_be_left(recordings: Recordings) -> None:
    one = Recordings(recordings.signs, recordings.movements.select(writer=recordings.movements.writers[0]))
    with pytest.raises(InvalidInputError, match="at least 2 who move and 2 who sign, found 1 and 2"):
        next(leave_people_out(one, 1))
