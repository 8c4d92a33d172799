"""Constants are measured without the people they are tested on."""

import numpy as np
import pytest

pytest.importorskip("sklearn", reason="the study needs scikit-learn")

from signimit.benchmark.splits import FOCUS_SIGNS, MOVEMENT_SIGNS, SYNTHETIC_MOVEMENTS
from signimit.benchmark.studies import left_out_people as folds
from signimit.benchmark.studies.conditions import REAL_MOVEMENTS, Recordings
from signimit.benchmark.studies.left_out_people import leave_people_out, measured_learner
from signimit.learners.joint.distance_model import DRAWINGS
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
    assert learner.drawings.equal_mean + learner.drawings.equal_spread < learner.drawings.other_mean
    assert learner.signs.equal_mean < learner.signs.other_mean
    assert learner.drawings.odd_share == DRAWINGS.odd_share
    assert learner.drawings.equal_mean != DRAWINGS.equal_mean


def test_everybody_who_moves_is_left_out_once(recordings: Recordings, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Recordings] = []

    def spy(others: Recordings) -> JointLearner:
        asked.append(others)
        return JointLearner()

    monkeypatch.setattr(folds, "measured_learner", spy)
    rows = list(leave_people_out(recordings, 2))
    assert [row.mover for row in rows] == sorted(set(recordings.movements.writers))
    for row, others in zip(rows, asked, strict=True):
        assert row.mover not in others.movements.writers
        assert len(set(others.signs.writers)) == 1
        assert row.right_without == row.right_shipped == row.sessions == 2
