"""The synthetic people of the environments: who makes the signs, and whose drawings show the movements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.people import MOVEMENT_LABELS, Person

MOVEMENTS = ("triangle up", "triangle down", "circle")
_DIGITS = "1234567890"
_DRAWINGS = 3  # of each movement; the judge takes the two that fit best


@dataclass(frozen=True, eq=False)
class People:
    """An interactant who signs and a demonstrator whose movements count as right; both synthetic.

    Their language is the paper's: the first word names the object, the second the movement, words are digits, the
    first ones for objects and the next for movements.

    Attributes:
        interactant: Who makes the signs.
        objects: Number of objects that there are words for.
        movements: Labels of the movements.
        templates: For each movement the demonstrator's drawings, each (T, 2), m, in the object's frame.
    """

    interactant: Person
    objects: int
    movements: tuple[str, ...]
    templates: list[list[NDArray[np.float64]]]

    @classmethod
    def sample(cls, objects: int, movements: Sequence[str], rng: np.random.Generator) -> People:
        """Draw two people.

        Raises:
            UnknownNameError: If somebody should make a movement that nobody knows.
            InvalidInputError: If there are no movements, or more requests than words.
        """
        for movement in movements:
            if movement not in MOVEMENT_LABELS:
                raise UnknownNameError("movement", movement, MOVEMENT_LABELS)
        if not 1 <= len(movements) <= len(_DIGITS) - objects:
            raise InvalidInputError("movements", f"1 to {len(_DIGITS) - objects} labels", f"{len(movements)}")
        interactant, demonstrator = Person.sample(rng), Person.sample(rng)
        templates = [[demonstrator.draw(m, rng).points for _ in range(_DRAWINGS)] for m in movements]
        return cls(interactant, objects, tuple(movements), templates)

    def speak(self, movement: int, focus: int, rng: np.random.Generator) -> list[NDArray[np.float64]]:
        """Make the signs of a request: two strokes, each (T, 2), m, never the same twice."""
        words = (_DIGITS[focus], _DIGITS[self.objects + movement])
        return [self.interactant.draw(word, rng).points for word in words]
