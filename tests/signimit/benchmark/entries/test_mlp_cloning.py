"""Cloning by a perceptron."""

import sys
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.entries import ENTRANTS
from signimit.benchmark.entries.cloning import collect_moments
from signimit.benchmark.protocol import Entrant, Kit, Observation
from signimit.benchmark.running import obey
from signimit.exceptions import MissingDependencyError
from signimit.teaching.sessions import Session


@pytest.fixture
def short_training(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("sklearn", reason="scikit-learn is not installed")
    monkeypatch.setattr("signimit.benchmark.entries.mlp_cloning.EPOCHS", 2)


@pytest.mark.usefixtures("short_training")
def test_it_moves_as_was_shown_where_it_was_shown(paper_session: Session, observed: Any) -> None:
    entry = observed("clone-mlp", paper_session)
    left, all_of_it = 0.0, 0.0
    samples = collect_moments(paper_session.demonstrations)
    for number, shown in enumerate(paper_session.demonstrations):
        entry.begin(shown.signs, shown.objects)
        own = np.flatnonzero(samples.demonstration == number)[::40]
        given = np.array([entry.act(Observation(samples.hand[i], np.zeros(2), 0.0)) for i in own])
        left += ((given - samples.velocity[own]) ** 2).sum()
        all_of_it += (samples.velocity[own] ** 2).sum()
    assert left < 0.7 * all_of_it


@pytest.mark.usefixtures("short_training")
def test_the_same_session_gives_the_same_bytes(paper_session: Session, observed: Any) -> None:
    paths = [obey(observed("clone-mlp", paper_session), paper_session.commands[0], 1.0) for _ in range(2)]
    assert paths[0].tobytes() == paths[1].tobytes()
    assert np.isfinite(paths[0]).all()


@pytest.mark.usefixtures("short_training")
def test_one_demonstration_is_enough_to_train(paper_session: Session, kit: Kit) -> None:
    entrant, command = ENTRANTS["clone-mlp"], paper_session.commands[0]
    assert isinstance(entrant, Entrant)
    entry = entrant.make(kit)
    entry.observe(paper_session.demonstrations[:1])
    assert np.isfinite(obey(entry, command, 0.5)).all()


def test_without_scikit_learn_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch, kit: Kit) -> None:
    monkeypatch.delitem(sys.modules, "signimit.benchmark.entries.mlp_cloning", raising=False)
    monkeypatch.setitem(sys.modules, "sklearn.exceptions", None)
    monkeypatch.setitem(sys.modules, "sklearn.neural_network", None)
    entrant = ENTRANTS["clone-mlp"]
    assert isinstance(entrant, Entrant)
    with pytest.raises(MissingDependencyError, match=r"pip install 'signimit\[study\]'"):
        entrant.make(kit)
