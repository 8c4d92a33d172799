"""Entrants are found by name, by module and by file, also in another process."""

import pickle
import sys
from pathlib import Path

import pytest

from signimit import InvalidInputError, UnknownNameError
from signimit.benchmark.entries import ENTRANTS, EntrantReference, get_entrant, refer_to
from signimit.benchmark.protocol import Entrant, Kit

OWN = """
from dataclasses import dataclass, field

@dataclass
class Still:
    \"\"\"Rests.

    More about it.
    \"\"\"
    seen: list = field(default_factory=list)
    def observe(self, demonstrations): self.seen.append(demonstrations)
    def begin(self, signs, objects): pass
    def act(self, observation): return 0.0, 0.0

class Halved:
    def observe(self, demonstrations): pass

still = Still()
"""


@pytest.fixture
def own(tmp_path: Path) -> Path:
    path = tmp_path / "mine.py"
    path.write_text(OWN)
    return path


def made(reference: EntrantReference, kit: Kit) -> object:
    entrant = get_entrant(reference)
    assert isinstance(entrant, Entrant)
    return entrant.make(kit)


def test_every_registered_name_leads_to_an_entrant_of_that_name() -> None:
    for name in ENTRANTS:
        assert get_entrant(refer_to(name)).name == name


def test_a_file_travels_with_its_reference(own: Path, kit: Kit) -> None:
    sent = pickle.dumps(refer_to(f"{own}:Still"))
    own.unlink()
    reference = pickle.loads(sent)
    entry = made(reference, kit)
    assert type(entry).__name__ == "Still"
    assert get_entrant(reference).title == "Rests"
    assert reference.name == "mine.py:Still"
    assert reference.slug == "mine.py-Still"


def test_every_session_gets_an_entry_of_its_own(own: Path, kit: Kit) -> None:
    reference = refer_to(f"{own}:Still")
    assert made(reference, kit) is not made(reference, kit)


def test_a_changed_file_is_another_entrant(own: Path) -> None:
    before = refer_to(f"{own}:Still")
    own.write_text(OWN.replace("Rests", "Sleeps"))
    after = refer_to(f"{own}:Still")
    assert (get_entrant(before).title, get_entrant(after).title) == ("Rests", "Sleeps")


def test_a_class_of_a_module_can_enter(own: Path, kit: Kit, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(own.parent))
    assert type(made(refer_to("mine:Still"), kit)).__name__ == "Still"
    sys.modules.pop("mine")


@pytest.mark.parametrize(
    ("what", "sentence"),
    [
        ("Halved", "entry mine.py:Halved: expected a class with observe, begin and act, found without begin, act."),
        ("still", "expected a class with observe, begin and act, found Still(seen=[])."),
        ("Nobody", "entry mine.py:Nobody: expected a class with observe, begin and act, found None."),
    ],
)
def test_what_cannot_enter_is_told_why(own: Path, what: str, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        refer_to(f"{own}:{what}")
    assert sentence in str(caught.value)


def test_an_unknown_name_is_answered_with_the_known_ones() -> None:
    with pytest.raises(UnknownNameError, match=r"Unknown entry 'joined'; known are joint, .*, file\.py:Class\."):
        refer_to("joined")


def test_a_module_that_is_not_there_is_named() -> None:
    with pytest.raises(InvalidInputError, match="a module that can be imported, found none called nowhere"):
        refer_to("nowhere:Class")
