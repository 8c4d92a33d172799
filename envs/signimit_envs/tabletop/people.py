"""The people of the environments: who makes the signs, and whose drawings show the movements."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from signimit import UnknownNameError
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.composition import movement_templates
from signimit.teaching.languages import Language, Request
from signimit.teaching.people import MOVEMENT_LABELS, Person, synthetic_library
from signimit.teaching.people.casting import SYNTHETIC, Source, load_person
from signimit.teaching.people.glyphs import GLYPHS
from signimit_envs.tabletop.language_options import MOVEMENTS as MOVEMENTS

_DRAWINGS = 2  # of each movement


class Signer(Protocol):
    """Somebody who draws signs."""

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Draw a sign once."""
        ...


class RecordedPerson:
    """Somebody whose strokes were recorded, and come at random.

    Unlike a `signimit.teaching.stroke_sampler.StrokeSampler` it remembers nothing, so that a seed decides an episode
    whatever was before.
    """

    def __init__(self, library: StrokeLibrary) -> None:
        """Take a person's strokes."""
        self._strokes: defaultdict[str, list[Stroke]] = defaultdict(list)
        for label, stroke in zip(library.labels, library, strict=True):
            self._strokes[label].append(stroke)

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Return one of the strokes with a label."""
        strokes = self._strokes[label]
        return strokes[int(rng.integers(len(strokes)))]


@dataclass(frozen=True, eq=False)
class People:
    """An interactant who signs and a demonstrator whose movements count as right.

    Attributes:
        language: What they speak.
        interactant: Who makes the signs.
        templates: For each movement the demonstrator's drawings, each (T, 2), m, in the object's frame.
    """

    language: Language
    interactant: Signer
    templates: tuple[tuple[NDArray[np.float64], ...], ...]

    @classmethod
    def sample(
        cls, language: Language, rng: np.random.Generator, signer: Source = SYNTHETIC, mover: Source = SYNTHETIC
    ) -> People:
        """Draw two people who know a language; synthetic ones where no strokes are given.

        Raises:
            UnknownNameError: If synthetic people should draw what they do not know.
            SignimitError: If a file or a person in it cannot be used.
        """
        drawings = _drawings(language, rng, mover)
        templates = movement_templates(language, drawings, rng, _DRAWINGS)
        return cls(language, _signer(language, rng, signer), templates)

    def speak(self, request: Request, rng: np.random.Generator) -> list[NDArray[np.float64]]:
        """Make the signs of a request: one stroke a word, each (T, 2), any unit, seldom or never the same twice."""
        language = self.language
        words = [""] * language.words
        if language.filler_signs:
            words = [language.filler_signs[int(rng.integers(len(language.filler_signs)))]] * language.words
        words[language.focus_word] = language.focus_signs[request.focus]
        words[language.movement_word] = language.movement_signs[request.movement]
        return [self.interactant.draw(word, rng).points for word in words]


def _drawings(language: Language, rng: np.random.Generator, mover: Source) -> StrokeLibrary:
    if mover != SYNTHETIC:
        return load_person(mover, language.movements, rng)[0]
    _check_known("movement", language.movements, MOVEMENT_LABELS)
    return synthetic_library(language.movements, samples=2 * _DRAWINGS, rng=rng)


def _signer(language: Language, rng: np.random.Generator, signer: Source) -> Signer:
    words = (*language.focus_signs, *language.movement_signs, *language.filler_signs)
    if signer != SYNTHETIC:
        return RecordedPerson(load_person(signer, words, rng)[0])
    _check_known("sign", words, tuple(GLYPHS))
    return Person.sample(rng)


def _check_known(what: str, labels: Sequence[str], known: Sequence[str]) -> None:
    for label in labels:
        if label not in known:
            raise UnknownNameError(what, label, known)
