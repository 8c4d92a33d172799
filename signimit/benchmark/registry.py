"""Entrants by name, and everybody's own by ``module:Class`` or ``file.py:Class``."""

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

from signimit.benchmark.protocol import Entrant, Entry, Oracle
from signimit.exceptions import InvalidInputError, UnknownNameError

METHODS = ("observe", "begin", "act")


class EntrantReference(NamedTuple):
    """Names an entrant so that another process, on another machine, can make it.

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
        return _registered(reference.name)
    module = _module_of_source(reference) if reference.source else _imported(place, reference.name)
    made_by = getattr(module, attribute, None)
    missing = [m for m in METHODS if not callable(getattr(made_by, m, None))]
    if not isinstance(made_by, type) or missing:
        lacks = f"without {', '.join(missing)}" if isinstance(made_by, type) else repr(made_by)
        raise InvalidInputError(f"entry {reference.name}", "a class with observe, begin and act", lacks)
    title = (made_by.__doc__ or attribute).strip().partition("\n")[0].rstrip(".")
    make: Callable[[], Entry] = made_by
    return Entrant(name=reference.slug, title=title, make=lambda kit: make())


def entrant_names() -> tuple[str, ...]:
    """Return the names of all registered entrants."""
    from signimit.benchmark.entries import ENTRANTS

    return tuple(ENTRANTS)


def _registered(name: str) -> Entrant | Oracle:
    from signimit.benchmark.entries import ENTRANTS

    if name not in ENTRANTS:
        raise UnknownNameError("entry", name, [*ENTRANTS, "module:Class", "file.py:Class"])
    return ENTRANTS[name]


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
