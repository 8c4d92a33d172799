"""Our learners as entries."""

from typing import Any

import numpy as np

from signimit.benchmark.entries import ENTRANTS, refer_to
from signimit.benchmark.running import SessionTask, run_task
from signimit.learning import learn
from signimit.teaching.sessions import Session


def test_the_default_obeys_all_nine_pairs() -> None:
    record = run_task(SessionTask(refer_to("joint"), "paper", 0))
    assert record["obeyed"] == [1] * 9
    assert record["read"] == [2] * 9


def test_an_entry_answers_as_the_model_does(paper_session: Session, observed: Any) -> None:
    entry = observed("joint", paper_session)
    model = learn(paper_session.demonstrations)
    assert np.array_equal(entry.understanding.labels, model.labels)
    for command in paper_session.commands:
        entry.begin(command.signs, command.objects)
        response = model.respond(command.signs, command.objects)
        assert entry.reading.movement.argmax() == response.movement
        assert entry.reading.focus.argmax() == response.focus


def test_the_papers_policy_is_its_own_and_the_other_ours(paper_session: Session, observed: Any) -> None:
    kinds = {}
    for name in ("joint", "paper", "paper-path", "paper-literal"):
        entry = observed(name, paper_session)
        kinds[name] = (entry._model.method, entry._model.policy_kind)
    assert kinds == {
        "joint": ("joint", "path-following"),
        "paper": ("paper", "knn"),
        "paper-path": ("paper", "path-following"),
        "paper-literal": ("paper-literal", "knn"),
    }
    assert next(iter(ENTRANTS)) == "joint"
