"""Chance draws what it guessed; replays draw what was shown when nearly the same was said."""

from typing import Any

import numpy as np
import pytest

from signimit.benchmark.entries import refer_to
from signimit.benchmark.running import SessionTask, obey, run_task
from signimit.evaluation import performed
from signimit.teaching.sessions import Session


def test_chance_draws_a_shown_movement_about_the_object_it_guessed(paper_session: Session, observed: Any) -> None:
    entry, about = observed("chance", paper_session), []
    for command in paper_session.commands:
        path = obey(entry, command)
        done = performed(path, command.objects, paper_session.truth.templates)
        about.append((done.focus, int(entry.reading.focus.argmax())))
    assert sum(done == guessed for done, guessed in about) >= 8
    assert len({guessed for _, guessed in about}) > 1


def test_guesses_have_nothing_to_do_with_the_signs(paper_session: Session, observed: Any) -> None:
    first, second = (observed("chance", paper_session) for _ in range(2))
    a, b = paper_session.commands[0], paper_session.commands[1]
    first.begin(a.signs, a.objects)
    second.begin(b.signs, a.objects)
    assert np.array_equal(first.reading.focus, second.reading.focus)
    assert np.array_equal(first.act(_start(a)), second.act(_start(a)))


def _start(command: Any) -> Any:
    from signimit.benchmark.protocol import Observation

    return Observation(command.hand, np.zeros(2), 0.0)


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
    shown = run_task(SessionTask(refer_to("replay-nearby"), "paper", 0))
    unseen = run_task(SessionTask(refer_to("replay-nearby"), "unseen-pair", 0))
    assert sum(shown["obeyed"]) >= 5
    assert sum(unseen["obeyed"]) == 0
