"""The synthetic people of the environments: who makes the signs, and whose drawings show the movements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.composition import movement_templates
from signimit.languages import Language, Request
from signimit.people import MOVEMENT_LABELS, Person, synthetic_library

MOVEMENTS = ("triangle up", "triangle down", "circle")
_DIGITS = "1234567890"
_DRAWINGS = 2  # of each movement


@dataclass(frozen=True, eq=False)
class People:
    """An interactant who signs and a demonstrator whose movements count as right; both synthetic.

    Attributes:
        language: What they speak: as in the paper the first sign names the object and the second the movement; signs
            are digits, the first ones for the objects and the next for the movements.
        interactant: Who makes the signs.
        templates: For each movement the demonstrator's drawings, each (T, 2), m, in the object's frame.
    """

    language: Language
    interactant: Person
    templates: tuple[tuple[NDArray[np.float64], ...], ...]

    @classmethod
    def sample(cls, objects: int, movements: Sequence[str], rng: np.random.Generator) -> People:
        """Draw two people.

        Raises:
            UnknownNameError: If somebody should make a movement that nobody knows.
            InvalidInputError: If there are no movements, or more objects and movements than digits.
        """
        for movement in movements:
            if movement not in MOVEMENT_LABELS:
                raise UnknownNameError("movement", movement, MOVEMENT_LABELS)
        words = len(_DIGITS) - objects
        if not 1 <= len(movements) <= words:
            raise InvalidInputError("movements", f"1 to {words} labels", f"{len(movements)}")
        language = Language(
            focus_signs=tuple(_DIGITS[:objects]),
            movement_signs=tuple(_DIGITS[objects : objects + len(movements)]),
            movements=tuple(movements),
        )
        drawings = synthetic_library(language.movements, samples=2 * _DRAWINGS, rng=rng)
        templates = movement_templates(language, drawings, rng, _DRAWINGS)
        return cls(language, Person.sample(rng), templates)

    def speak(self, request: Request, rng: np.random.Generator) -> list[NDArray[np.float64]]:
        """Make the signs of a request: two strokes, each (T, 2), m, never the same twice."""
        language = self.language
        words = (language.focus_signs[request.focus], language.movement_signs[request.movement])
        return [self.interactant.draw(word, rng).points for word in words]
