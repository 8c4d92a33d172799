"""The people of an environment: the signer, and the mover whose drawings define success."""

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

_DRAWINGS = 2  # drawings of each movement that the success detector compares with


@dataclass(frozen=True, eq=False, repr=False)
class TabletopPeople(People[StrokeSource]):
    """`People` whose strokes are drawn with replacement: an episode depends on its seed alone, not on earlier ones.

    Attributes:
        templates: For each movement the mover's drawings, each (T, 2), m, in the object's frame.
    """

    templates: tuple[tuple[NDArray[np.float64], ...], ...] = ()


def choose_tabletop_people(
    language: Language, rng: np.random.Generator, signer: Source = SYNTHETIC, mover: Source = SYNTHETIC
) -> TabletopPeople:
    """Choose signer and mover of a language; synthetic people where no stroke library is given.

    Raises:
        UnknownNameError: If a synthetic person does not know a sign or movement of the language.
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
