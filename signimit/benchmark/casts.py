"""Who takes part in a session: synthetic people, the same ones for the same seed in every split."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np

from signimit.benchmark.studies.cells import CROWD, wavering
from signimit.strokes import StrokeLibrary
from signimit.teaching.languages import Language
from signimit.teaching.people import Person, drawings

LARGER, FASTER, MORE_SLANTED = 1.8, 1.8, 0.9  # another style: times the size, times the speed, shear added
WAVER = 0.18  # half sizes, root mean square, where people are noisy


class Cast(NamedTuple):
    """What everybody drew.

    Attributes:
        signs: Signs made in demonstrations.
        movements: Movements shown.
        asking: Signs made in commands; the same library where the same signer goes on.
    """

    signs: StrokeLibrary
    movements: StrokeLibrary
    asking: StrokeLibrary


class Casting(Protocol):
    """A way of choosing people and letting them draw."""

    def __call__(self, language: Language, samples: int, who: np.random.Generator, how: np.random.Generator) -> Cast:
        """Let people draw all that a language needs, each label ``samples`` times; ``who`` they are and ``how``."""
        ...


def same_people(language: Language, samples: int, who: np.random.Generator, how: np.random.Generator) -> Cast:
    """One signer and one mover, who also asks in the end."""
    signer, mover = Person.sample(who), Person.sample(who)
    signs = _drawn([signer], sign_labels(language), samples, how)
    return Cast(signs, _drawn([mover], language.movements, samples, how), signs)


def another_style(language: Language, samples: int, who: np.random.Generator, how: np.random.Generator) -> Cast:
    """The same signer asks with larger, faster and more slanted signs than were seen."""
    signer, mover = Person.sample(who), Person.sample(who)
    style = signer.style
    changed = replace(style, size=LARGER * style.size, tempo=style.tempo / FASTER, slant=style.slant + MORE_SLANTED)
    signs = _drawn([signer], sign_labels(language), samples, how)
    movements = _drawn([mover], language.movements, samples, how)
    return Cast(signs, movements, _drawn([replace(signer, style=changed)], sign_labels(language), samples, how))


def strangers(language: Language, samples: int, who: np.random.Generator, how: np.random.Generator) -> Cast:
    """Every sign and every movement may be another one's of a crowd, and somebody asks who was never seen."""
    signer, mover = Person.sample(who), Person.sample(who)
    signers = [signer, *(Person.sample(who) for _ in range(CROWD - 1))]
    movers = [mover, *(Person.sample(who) for _ in range(CROWD - 1))]
    stranger = Person.sample(who)
    signs = _drawn(signers, sign_labels(language), samples, how)
    movements = _drawn(movers, language.movements, samples, how)
    return Cast(signs, movements, _drawn([stranger], sign_labels(language), samples, how))


def wavering_people(language: Language, samples: int, who: np.random.Generator, how: np.random.Generator) -> Cast:
    """The same people, and a slow waver in all that they draw."""
    signs, movements, _ = same_people(language, samples, who, how)
    signs = wavering(signs, how, WAVER)
    return Cast(signs, wavering(movements, how, WAVER), signs)


def sign_labels(language: Language) -> tuple[str, ...]:
    """Return all signs that are made in a language or span its sign space."""
    words = (*language.focus_signs, *language.movement_signs, *language.filler_signs, *language.prototypes)
    return tuple(dict.fromkeys(words))


def _drawn(people: Sequence[Person], labels: Sequence[str], samples: int, how: np.random.Generator) -> StrokeLibrary:
    libraries = [drawings(p, f"synthetic {i + 1}", labels, samples, how) for i, p in enumerate(people)]
    return sum(libraries[1:], libraries[0])
