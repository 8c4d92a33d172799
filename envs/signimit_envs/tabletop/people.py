"""The people of the environments: one who makes the signs, and one whose drawings the judge compares with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from signimit import UnknownNameError
from signimit.teaching.composition import movement_templates
from signimit.teaching.languages import Language
from signimit.teaching.people import MOVEMENT_LABELS, Person, synthetic_library
from signimit.teaching.people.choosing import SYNTHETIC, People, Source, load_person
from signimit.teaching.people.glyphs import GLYPHS
from signimit.teaching.stroke_sampler import ReplacingSampler, StrokeSource

_DRAWINGS = 2  # of each movement


@dataclass(frozen=True, eq=False)
class TabletopPeople(People[StrokeSource]):
    """`People` whose signs depend on the generator alone, so that a seed decides an episode whatever was before.

    Attributes:
        templates: For each movement the mover's drawings, each (T, 2), m, in the object's frame.
    """

    templates: tuple[tuple[NDArray[np.float64], ...], ...] = ()


def choose_tabletop_people(
    language: Language, rng: np.random.Generator, signer: Source = SYNTHETIC, mover: Source = SYNTHETIC
) -> TabletopPeople:
    """Choose two people who know a language; synthetic ones where no strokes are given.

    Raises:
        UnknownNameError: If synthetic people should draw what they do not know.
        SignimitError: If a file or a person in it cannot be used.
    """
    if mover == SYNTHETIC:
        _check_known("movement", language.movements, MOVEMENT_LABELS)
        drawings = synthetic_library(language.movements, samples=2 * _DRAWINGS, rng=rng)
    else:
        drawings, _ = load_person(mover, language.movements, rng)
    templates = movement_templates(language, drawings, rng, _DRAWINGS)
    words = (*language.focus_signs, *language.movement_signs, *language.filler_signs)
    signs: StrokeSource
    if signer == SYNTHETIC:
        _check_known("sign", words, tuple(GLYPHS))
        signs = Person.sample(rng)
    else:
        signs = ReplacingSampler(load_person(signer, words, rng)[0])
    return TabletopPeople(language, signs, ReplacingSampler(drawings), templates=templates)


def _check_known(what: str, labels: Sequence[str], known: Sequence[str]) -> None:
    for label in labels:
        if label not in known:
            raise UnknownNameError(what, label, known)
