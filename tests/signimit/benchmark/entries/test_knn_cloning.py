"""Cloning by nearest neighbours."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.entries import refer_to
from signimit.benchmark.entries.knn_cloning import NEAR, NEIGHBOURS
from signimit.benchmark.entries.samples import samples_of, utterance_features
from signimit.benchmark.protocol import Observation
from signimit.benchmark.running import Task, run_task
from signimit.teaching.sessions import Session


def test_the_velocity_is_the_weighted_mean_of_the_most_similar_moments(paper_session: Session, observed: Any) -> None:
    entry, command = observed("clone-knn", paper_session), paper_session.commands[0]
    entry.begin(command.signs, command.objects)
    given = entry.act(Observation(command.hand, np.zeros(2), 0.0))
    np.testing.assert_allclose(given, _by_definition(paper_session, command), atol=1e-9)


def _by_definition(session: Session, command: Any) -> NDArray[np.float64]:
    samples, moments = samples_of(session.demonstrations), []
    asked = utterance_features(command.signs)
    unlike = [np.linalg.norm(utterance_features(shown.signs) - asked) for shown in session.demonstrations]
    for demonstration, hand, velocity in zip(*samples, strict=True):
        for there, here in zip(session.demonstrations[int(demonstration)].objects, command.objects, strict=True):
            x, y = (hand - there) - (command.hand - here)
            moments.append((math.hypot(unlike[demonstration], x / NEAR, y / NEAR), *velocity))
    nearest = np.array(sorted(moments)[:NEIGHBOURS])
    return np.asarray(np.average(nearest[:, 1:], axis=0, weights=nearest[:, 0] ** -2.0))


def test_pairs_that_were_shown_are_obeyed_more_often_than_by_chance_and_no_other() -> None:
    shown, unseen = (run_task(Task(refer_to("clone-knn"), split, 0)) for split in ("paper", "unseen-pair"))
    assert sum(shown["obeyed"]) > 1  # chance asks one of nine
    assert sum(unseen["obeyed"]) == 0
