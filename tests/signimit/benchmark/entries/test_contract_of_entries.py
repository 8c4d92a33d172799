"""What holds for every entry, and what no entry is told."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.entries import ENTRANTS, EntrantReference
from signimit.benchmark.protocol import Entrant, Entry, Kit, Observation, Oracle
from signimit.benchmark.running import SessionTask, make_entry, obey, run_task
from signimit.demonstrations import DemonstrationSet
from signimit.teaching.composition import GroundTruth
from signimit.teaching.languages import Language, Request
from signimit.teaching.sessions import Session

FAST = [name for name in ENTRANTS if name != "clone-mlp" and not name.startswith("deep")]


@pytest.fixture(scope="module", params=FAST)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def entry(name: str, paper_session: Session, observed: Any) -> Entry:
    return observed(name, paper_session)  # type: ignore[no-any-return]


def test_names_are_those_of_the_table() -> None:
    assert all(name == entrant.name for name, entrant in ENTRANTS.items())
    assert {"joint", "paper", "paper-literal", "chance", "replay"} <= set(ENTRANTS)


def test_the_same_session_gives_the_same_bytes(name: str, paper_session: Session, observed: Any) -> None:
    once, again = (
        [obey(entry, command, 0.5).tobytes() for command in paper_session.commands[:2]]
        for entry in (observed(name, paper_session) for _ in range(2))
    )
    assert once == again


def test_velocities_are_finite_wherever_the_hand_is(entry: Entry, paper_session: Session) -> None:
    for command in paper_session.commands[:3]:
        entry.begin(command.signs, command.objects)
        for hand in (command.objects[0], np.array([1.5, -2.0]), np.zeros(2)):
            velocity = np.asarray(entry.act(Observation(hand, np.zeros(2), 0.0)))
            assert velocity.shape == (2,)
            assert np.isfinite(velocity).all()


def test_what_is_given_is_left_as_it_was(entry: Entry, paper_session: Session) -> None:
    command = paper_session.commands[0]
    signs, objects = tuple(s.copy() for s in command.signs), command.objects.copy()
    entry.begin(signs, objects)
    hand = command.hand.copy()
    entry.act(Observation(hand, np.zeros(2), 0.0))
    assert all(np.array_equal(a, b) for a, b in zip(signs, command.signs, strict=True))
    assert np.array_equal(objects, command.objects)
    assert np.array_equal(hand, command.hand)


def test_an_ordinary_entry_is_given_nothing_that_leads_to_labels(
    paper_session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[Any] = []

    class Spy:
        def observe(self, *everything: Any) -> None:
            assert [type(thing) for thing in everything] == [DemonstrationSet]
            given.extend(everything)

        def begin(self, signs: Any, objects: Any) -> None:
            assert all(isinstance(array, np.ndarray) for array in (*signs, objects))
            given.extend((signs, objects))

        def act(self, observation: Observation) -> tuple[float, float]:
            given.append(observation) if len(given) < 100 else None
            return 0.0, 0.0

    def make(*everything: Any) -> Spy:
        assert [type(thing) for thing in everything] == [Kit]
        given.append(everything[0].prototypes)
        return Spy()

    monkeypatch.setitem(ENTRANTS, "spy", Entrant(name="spy", title="looks about", make=make))
    run_task(SessionTask(EntrantReference("spy"), "paper", 0))
    assert given
    assert not [thing for thing in _reachable(given) if isinstance(thing, (GroundTruth, Language, Request, str))]
    assert isinstance(paper_session.truth, GroundTruth)
    assert [thing for thing in _reachable(paper_session) if isinstance(thing, Language)]  # the search does find it


def _reachable(thing: Any) -> Iterator[Any]:
    yield thing
    if isinstance(thing, (tuple, list)):
        inside = list(thing)
    elif isinstance(thing, np.ndarray):
        inside = [] if thing.base is None else [thing.base]
    else:
        inside = list(getattr(thing, "__dict__", {}).values())
    for part in inside:
        yield from _reachable(part)


@pytest.mark.parametrize("name", [n for n, e in ENTRANTS.items() if isinstance(e, Oracle)])
def test_an_oracle_cannot_be_made_without_the_truth(name: str, kit: Kit) -> None:
    with pytest.raises(TypeError):
        ENTRANTS[name].make(kit)  # type: ignore


def test_every_row_that_is_told_something_says_so() -> None:
    for name, entrant in ENTRANTS.items():
        assert isinstance(entrant, Oracle) == ("told" in entrant.title), name
        assert isinstance(entrant, Oracle) == name.startswith("oracle"), name


def test_only_an_oracle_is_told_the_truth(paper_session: Session) -> None:
    told: list[Any] = []

    def make_oracle(kit: Kit, truth: Any) -> Any:
        told.append(truth)

    def make_entrant(kit: Kit, *more: Any) -> Any:
        told.extend(more)

    make_entry(Entrant(name="honest", title="", make=make_entrant), paper_session)
    assert told == []
    make_entry(Oracle(name="oracle", title="", make=make_oracle), paper_session)
    assert told[0].shown is paper_session.truth
    assert told[0].asked == tuple(command.request for command in paper_session.commands)
