"""The entries of the benchmark: those of this project by name, others by ``module:Class`` or ``file.py:Class``.

What a learner needs that is not installed with signimit is imported when its entry is made.
"""

from __future__ import annotations

import hashlib
import importlib
import importlib.util
import re
import sys
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from signimit.benchmark.entries.baselines import Chance, Replay, ReplayNearby
from signimit.benchmark.entries.cloning import NearestNeighbourCloning
from signimit.benchmark.entries.imitator import learner_entrant
from signimit.benchmark.entries.oracles import AllKnowing, oracle_focus, oracle_grouping
from signimit.benchmark.protocol import Entrant, Entry, Kit, Oracle
from signimit.exceptions import InvalidInputError, UnknownNameError

METHODS = ("observe", "begin", "act")
MANY = 1200  # demonstrations of the entries that learn slowly


def _perceptron(kit: Kit) -> Entry:
    from signimit.benchmark.entries.mlp_cloning import PerceptronCloning

    return PerceptronCloning(kit)


def _deep(name: str, title: str, attention: bool, demonstrations: int = 0) -> Entrant:
    """Enter a deep network, with or without attention to one object."""

    def make(kit: Kit) -> Entry:
        from signimit.benchmark.entries.deep_cloning import DeepCloning

        return DeepCloning(kit, attention)

    return Entrant(name=name, title=title, make=make, demonstrations=demonstrations)


_ALL: tuple[Entrant | Oracle, ...] = (
    learner_entrant("joint", "our default: everything inferred together, path-following", "joint"),
    learner_entrant("paper", "the paper: Algorithm 1 as it works, its k-NN policy", "paper", "knn"),
    learner_entrant("paper-path", "the paper's inference, path-following", "paper"),
    learner_entrant("paper-literal", "the paper with Algorithm 1 as printed", "paper-literal", "knn"),
    _deep("deep-12", "a deep network with attention to one object, trained on what was shown", True),
    _deep("deep-1200", "the same, trained on 1,200 demonstrations", True, MANY),
    _deep("deep-plain-12", "a deep network without attention, trained on what was shown", False),
    _deep("deep-plain-1200", "the same without attention, trained on 1,200 demonstrations", False, MANY),
    Entrant(
        name="clone-knn",
        title="behaviour cloning: the nearest moments, seen from all objects",
        make=lambda kit: NearestNeighbourCloning(),
    ),
    Entrant(name="clone-mlp", title="behaviour cloning: a perceptron from signs, objects and hand", make=_perceptron),
    Entrant(
        name="replay-nearby",
        title="the demonstration with the nearest signs, about the object it was nearest to",
        make=lambda kit: ReplayNearby(),
    ),
    Entrant(name="replay", title="the demonstration with the nearest signs, in its place", make=lambda kit: Replay()),
    Oracle(name="oracle-grouping", title="paper-path, told the groups", make=oracle_grouping),
    Oracle(name="oracle-focus", title="paper-path, told the foci", make=oracle_focus),
    Oracle(name="oracle", title="told everything; only path-following can fail", make=AllKnowing),
    Entrant(name="chance", title="guesses: something that was shown, about something that lies there", make=Chance),
)

ENTRANTS: dict[str, Entrant | Oracle] = {entrant.name: entrant for entrant in _ALL}
"""All entrants, by name, in the order of the leaderboard."""


class EntrantReference(NamedTuple):
    """A name of an entrant by which any process on any machine can make it.

    Attributes:
        name: A registered name, or ``module:Class``, or the name of a file and a class.
        source: Text of the file, if it is a file.
    """

    name: str
    source: str = ""

    @property
    def slug(self) -> str:
        """The name as part of a file's name."""
        return re.sub(r"[^\w.-]+", "-", self.name)


def refer_to(name: str) -> EntrantReference:
    """Make a reference from what a user typed, and see that the entrant exists.

    Raises:
        UnknownNameError: If there is no such entrant.
        InvalidInputError: If what is named is not a class with the three methods.
        OSError: If the file cannot be read.
    """
    place, colon, attribute = name.rpartition(":")
    if colon and place.endswith(".py"):
        source = Path(place).read_text(encoding="utf-8")
        reference = EntrantReference(f"{Path(place).name}:{attribute}", source)
    else:
        reference = EntrantReference(name)
    get_entrant(reference)
    return reference


@lru_cache(maxsize=64)
def get_entrant(reference: EntrantReference) -> Entrant | Oracle:
    """Return the entrant that a reference stands for.

    Raises:
        UnknownNameError: If there is none of that name.
        InvalidInputError: If what is named is not a class with the three methods.
    """
    place, colon, attribute = reference.name.rpartition(":")
    if not colon:
        if reference.name not in ENTRANTS:
            raise UnknownNameError("entry", reference.name, [*ENTRANTS, "module:Class", "file.py:Class"])
        return ENTRANTS[reference.name]
    module = _module_of_source(reference) if reference.source else _imported(place, reference.name)
    made_by = getattr(module, attribute, None)
    missing = [m for m in METHODS if not callable(getattr(made_by, m, None))]
    if not isinstance(made_by, type) or missing:
        lacks = f"without {', '.join(missing)}" if isinstance(made_by, type) else repr(made_by)
        raise InvalidInputError(f"entry {reference.name}", "a class with observe, begin and act", lacks)
    title = (made_by.__doc__ or attribute).strip().partition("\n")[0].rstrip(".")
    make: Callable[[], Entry] = made_by
    return Entrant(name=reference.slug, title=title, make=lambda kit: make())


def _imported(place: str, name: str) -> ModuleType:
    try:
        return importlib.import_module(place)
    except ModuleNotFoundError as error:
        if error.name is None or not place.startswith(error.name):
            raise  # it exists, and lacks something itself
        raise InvalidInputError(f"entry {name}", "a module that can be imported", f"none called {place}") from None


def _module_of_source(reference: EntrantReference) -> ModuleType:
    """Run the text of a file as a module; it is registered because dataclasses look theirs up."""
    digest = hashlib.sha256(reference.source.encode()).hexdigest()[:16]
    module = ModuleType(f"signimit_entry_{digest}")
    sys.modules[module.__name__] = module
    exec(compile(reference.source, reference.name.rpartition(":")[0], "exec"), module.__dict__)
    return module
