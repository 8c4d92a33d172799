"""Chance guesses, and draws what it guessed."""

from typing import Any

import numpy as np

from signimit.benchmark.obeying import obey
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
