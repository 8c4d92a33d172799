"""Replays draw what was shown when nearly the same was said."""

from typing import Any

import numpy as np
import pytest

from signimit.benchmark.entries import refer_to
from signimit.benchmark.obeying import obey
from signimit.benchmark.running import Task, run_task
from signimit.teaching.sessions import Session


def test_replay_ignores_the_objects(paper_session: Session, observed: Any) -> None:
    entry, command = observed("replay", paper_session), paper_session.commands[0]
    here = obey(entry, command, 4.0)
    elsewhere = obey(entry, command._replace(objects=command.objects[::-1] + 0.1), 4.0)
    assert np.array_equal(here, elsewhere)


@pytest.mark.parametrize("name", ["replay", "replay-nearby"])
def test_the_signs_of_a_demonstration_bring_it_back(name: str, paper_session: Session, observed: Any) -> None:
    entry = observed(name, paper_session)
    command = paper_session.commands[0]
    for shown in paper_session.demonstrations[:4]:
        as_shown = command._replace(signs=shown.signs, objects=shown.objects, hand=shown.hand[0])
        path = obey(entry, as_shown)[150:]
        gaps = np.linalg.norm(path[:, None] - shown.hand, axis=2).min(axis=1)
        assert np.median(gaps) < 0.02


def test_the_nearby_replay_goes_where_the_objects_go(paper_session: Session, observed: Any) -> None:
    entry, command = observed("replay-nearby", paper_session), paper_session.commands[0]
    shift = np.array([0.05, -0.03])
    here = obey(entry, command, 4.0)
    there = obey(entry, command._replace(objects=command.objects + shift, hand=command.hand + shift), 4.0)
    np.testing.assert_allclose(there, here + shift, atol=1e-6)


def test_nearness_obeys_the_pairs_that_were_shown_and_no_other() -> None:
    shown = run_task(Task(refer_to("replay-nearby"), "paper", 0))
    unseen = run_task(Task(refer_to("replay-nearby"), "unseen-pair", 0))
    assert sum(shown["obeyed"]) >= 5
    assert sum(unseen["obeyed"]) == 0
