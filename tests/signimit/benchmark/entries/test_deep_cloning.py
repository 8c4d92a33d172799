"""Deep cloning: deterministic, mannerly with PyTorch's settings, and able to find an object by its sign."""

import sys
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.entries import ENTRANTS
from signimit.benchmark.entries.cloning import collect_moments
from signimit.benchmark.protocol import Entrant, Observation
from signimit.benchmark.running import obey
from signimit.exceptions import MissingDependencyError
from signimit.teaching.sessions import Session

DEEP = [name for name in ENTRANTS if name.startswith("deep")]


@pytest.fixture
def torch(monkeypatch: pytest.MonkeyPatch) -> Any:
    module = pytest.importorskip("torch", reason="PyTorch is not installed")
    monkeypatch.setattr("signimit.benchmark.entries.deep_cloning.STEPS", 15)
    monkeypatch.setattr("signimit.benchmark.entries.deep_cloning.STEPS_EACH", 0)
    return module


@pytest.fixture(params=["deep-12", "deep-plain-12"])
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_the_same_session_gives_the_same_bytes_whatever_the_settings(
    name: str, torch: Any, paper_session: Session, observed: Any
) -> None:
    command = paper_session.commands[0]
    torch.manual_seed(1)
    first = obey(observed(name, paper_session), command, 1.0)
    torch.manual_seed(2)
    assert obey(observed(name, paper_session), command, 1.0).tobytes() == first.tobytes()
    assert np.isfinite(first).all()


def test_settings_and_random_state_are_left_as_they_were(torch: Any, paper_session: Session, observed: Any) -> None:
    before = torch.get_rng_state(), torch.get_num_threads(), torch.are_deterministic_algorithms_enabled()
    observed("deep-12", paper_session)
    after = torch.get_rng_state(), torch.get_num_threads(), torch.are_deterministic_algorithms_enabled()
    assert bool((before[0] == after[0]).all())
    assert before[1:] == after[1:]


def test_a_step_of_the_hand_is_what_the_network_computes(
    name: str, torch: Any, paper_session: Session, observed: Any
) -> None:
    from signimit.benchmark.entries.deep_cloning import NEAR, SPEED, sign_channels

    entry, command = observed(name, paper_session), paper_session.commands[0]
    entry.begin(command.signs, command.objects)
    given = entry.act(Observation(command.hand, np.zeros(2), 0.3))
    with torch.inference_mode():
        code = entry._network.encode(torch.from_numpy(sign_channels(command.signs))[None])
        places = torch.from_numpy((command.hand - command.objects) / NEAR).float()[None]
        wanted = SPEED * entry._network(code, places, torch.tensor([[0.3]]))[0].numpy()
    np.testing.assert_allclose(given, wanted, atol=1e-5)


def test_it_moves_more_as_was_shown_than_a_resting_hand(
    name: str, torch: Any, paper_session: Session, observed: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("signimit.benchmark.entries.deep_cloning.STEPS", 100)
    entry, samples = observed(name, paper_session), collect_moments(paper_session.demonstrations)
    left, all_of_it = 0.0, 0.0
    for number, shown in enumerate(paper_session.demonstrations):
        entry.begin(shown.signs, shown.objects)
        own = np.flatnonzero(samples.demonstration == number)[::40]
        given = np.array([entry.act(Observation(samples.hand[i], np.zeros(2), 5.0)) for i in own])
        left += ((given - samples.velocity[own]) ** 2).sum()
        all_of_it += (samples.velocity[own] ** 2).sum()
    assert left < 0.9 * all_of_it


def test_without_pytorch_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch, kit: Any) -> None:
    monkeypatch.delitem(sys.modules, "signimit.benchmark.entries.deep_cloning", raising=False)
    monkeypatch.setitem(sys.modules, "torch", None)
    entrant = ENTRANTS["deep-12"]
    assert isinstance(entrant, Entrant)
    with pytest.raises(MissingDependencyError, match=r"pip install 'signimit\[deep\]'"):
        entrant.make(kit)


def test_a_row_says_how_many_demonstrations_it_was_given() -> None:
    for name in DEEP:
        entrant = ENTRANTS[name]
        assert entrant.demonstrations == (1200 if name.endswith("1200") else 0)
        assert entrant.demonstrations == 0 or "1,200" in entrant.title
