"""Names of objects and movements, for sentences and figures: those that people gave, else colours and shapes.

Nothing is learned from a name.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.shape_names import guess_shape
from signimit.validation import item_list, plain_text

OBJECT_NAMES = ("red", "green", "blue", "violet", "orange", "teal")
OBJECT_COLOURS = ("#cc332b", "#3d944d", "#2e66c2", "#804dad", "#d9701a", "#1a8f94")
_LONGEST = 40  # characters of a name
_Paths = tuple[NDArray[np.float64], ...]


def object_name(index: int) -> str:
    """Return the colour of an object, or its number, from 1, where colours have run out."""
    return OBJECT_NAMES[index] if index < len(OBJECT_NAMES) else f"number {index + 1}"


@one_line
@dataclass(frozen=True)
class Names:
    """What objects and movements are called in sentences and figures; it counts from 1.

    Attributes:
        objects: Names that were given to the objects; empty if none were, and they are called by colours.
        movements: Names that were given to the movements, an empty text for one without; empty if none were.
        drawings: Paths and times of each movement, from which a name is guessed where none was given.

    Example:
        >>> from signimit.names import Names
        >>> names = Names(objects=("cup", "plate"), movements=("stir", ""))
        >>> names.request(0, 1)
        'movement 1 (stir) about the plate object'
        >>> Names().request(1, 2)
        'movement 2 about the blue object'
    """

    objects: tuple[str, ...] = ()
    movements: tuple[str, ...] = ()
    drawings: tuple[tuple[_Paths, _Paths], ...] = field(default=(), repr=False, compare=False)

    def object(self, index: int) -> str:
        """Return the name of an object, e.g. "red"."""
        return self.objects[index] if index < len(self.objects) else object_name(index)

    def movement(self, number: int) -> str:
        """Return a movement's number and name, e.g. "movement 2 (like a circle, clockwise)"."""
        known = self.movement_names[number] if number < len(self.movement_names) else ""
        return f"movement {number + 1} ({known})" if known else f"movement {number + 1}"

    def request(self, movement: int, focus: int) -> str:
        """Say what is asked for, e.g. "movement 2 (stir) about the red object"."""
        return f"{self.movement(movement)} about the {self.object(focus)} object"

    @cached_property
    def movement_names(self) -> tuple[str, ...]:
        """The name of each movement: given, or guessed from its shape, or empty; guessed when first asked for."""
        both = zip_longest(self.movements, self.drawings)
        return tuple(given or ("" if drawn is None else guess_shape(*drawn)) for given, drawn in both)


UNNAMED = Names()
"""Colours and numbers only."""


def check_names(names: Iterable[str | None], where: str, count: int, optional: bool = False) -> tuple[str, ...]:
    """Return names that can be printed and told from each other.

    Args:
        names: The names, in order.
        where: What they are called in the error's sentence.
        count: How many there have to be.
        optional: Whether None or an empty text may stand for "no name"; it is returned as an empty text.

    Raises:
        InvalidInputError: If one is no text of one line, too long, or there twice, or there are more or fewer.
    """
    listed = item_list(names, where)
    if len(listed) != count:
        raise InvalidInputError(where, f"{count} names", f"{len(listed)}")
    found: list[str] = []
    for number, name in enumerate(listed):
        text = "" if optional and name is None else plain_text(name, f"{where}: {number}")
        if (text or not optional) and (not text.strip() or not text.isprintable() or len(text) > _LONGEST):
            raise InvalidInputError(f"{where}: {number}", f"one line of 1 to {_LONGEST} characters", f"{text!a:.50}")
        if text and text in found:
            raise InvalidInputError(f"{where}: {number}", "a name that no other has", f"{text!a:.50} again")
        found.append(text)
    return tuple(found)


def names_from_array(array: NDArray[Any], where: str) -> list[str]:
    """Return the names that a file holds as an array of text.

    Raises:
        InvalidInputError: If it is no list of text.
    """
    if array.ndim != 1 or array.dtype.kind != "U":
        raise InvalidInputError(where, "a list of text", f"{array.dtype} values of shape {array.shape}")
    return [str(name) for name in array]


def carry_names(names: Sequence[str], before: NDArray[np.int64], after: NDArray[np.int64]) -> tuple[str, ...]:
    """Give the names of movements to the same movements among those that were found again.

    A movement is the same if most of its old demonstrations are in the new one, and of the new one's most are its own.

    Args:
        names: Name of each movement of before, an empty text for one without; empty if there are none.
        before: Movement of each demonstration, shape (N,), -1 for none.
        after: The same as found later, perhaps of more demonstrations, shape (N or more,).

    Returns:
        Name of each movement of after; empty if there are none.
    """
    if not any(names):
        return ()
    shared = np.zeros((int(before.max()) + 1, int(after.max()) + 1), dtype=np.int64)
    both = (before >= 0) & (after[: len(before)] >= 0)
    np.add.at(shared, (before[both], after[: len(before)][both]), 1)
    found = []
    for m in range(shared.shape[1]):
        old = int(shared[:, m].argmax()) if len(shared) else 0
        same = bool(shared.size) and shared[old, m] > 0 and int(shared[old].argmax()) == m
        found.append(names[old] if same else "")
    return tuple(found)
