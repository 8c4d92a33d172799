"""Who plays in a session: one person makes the signs, another shows the movements."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.strokes import StrokeLibrary
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library
from signimit.teaching.people.relabelling import renamed, with_mirror_images

SIGN_SAMPLES, MOVEMENT_SAMPLES = 24, 12  # how often a synthetic person draws each label


@dataclass(frozen=True, eq=False)
class Cast:
    """The people of a session.

    Attributes:
        signs: Strokes of the interactant.
        movements: Strokes of the demonstrator.
        names: Who they are, for reports.
    """

    signs: StrokeLibrary
    movements: StrokeLibrary
    names: tuple[str, str]


class Source(NamedTuple):
    """Where a person comes from.

    Attributes:
        library: Stroke library file; none stands for a synthetic person.
        person: Who of those in the library; none for anybody.
    """

    library: str | os.PathLike[str] | None = None
    person: str | None = None


SYNTHETIC = Source()


def cast_people(
    language: Language, rng: np.random.Generator, signer: Source = SYNTHETIC, mover: Source = SYNTHETIC
) -> Cast:
    """Find an interactant and a demonstrator who draw what a language needs; synthetic ones where none is given.

    Raises:
        SignimitError: If a file or a person in it cannot be used.
    """
    needs = ((signer, sign_labels(language), SIGN_SAMPLES), (mover, language.movements, MOVEMENT_SAMPLES))
    people = []
    for source, labels, samples in needs:
        if source.library is not None:
            people.append(load_person(source, labels, rng))
        elif source.person is not None:
            raise InvalidInputError(f"person {source.person!r}", "a stroke library to find them in", "none")
        else:
            people.append((synthetic_library(labels, samples=samples, rng=rng), "a synthetic person"))
    (signs, interactant), (movements, demonstrator) = people
    return Cast(signs, movements, (interactant, demonstrator))


def load_person(source: Source, labels: Sequence[str], rng: np.random.Generator) -> tuple[StrokeLibrary, str]:
    """Take one person's strokes out of a library file.

    Where labels ask for "triangle up" and "triangle down" and the library has only "triangle", apex up, its strokes
    serve as the one and mirrored as the other.

    Args:
        source: File written by `StrokeLibrary.save`, and whose strokes; if anybody's, somebody who drew all labels.
        labels: What the person must have drawn.
        rng: Draws the person.

    Returns:
        The person's strokes, and a name for reports.

    Raises:
        FileFormatError: If it is no such file.
        UnknownNameError: If the library has no such person.
        InvalidInputError: If the person, or everybody, lacks one of the labels.
    """
    path, name = os.fspath(source.library or ""), source.person
    library = with_both_triangles(StrokeLibrary.load(path))
    if name is not None and name not in library.writers:
        raise UnknownNameError(f"person in {path}", name, sorted(set(library.writers)))
    candidates = sorted(set(library.writers)) if name is None else [name]
    drawn = Counter(zip(library.writers, library.labels, strict=True))
    able = [w for w in candidates if all(drawn[w, label] for label in labels)]
    if not able:
        lacking = [label for label in labels if not any(drawn[w, label] for w in candidates)]
        who = f"{path}: {name or 'everybody'}"
        raise InvalidInputError(who, f"strokes of {', '.join(labels)}", f"none of {', '.join(lacking) or 'some'}")
    person = able[int(rng.integers(len(able)))]
    return library.select(writer=person), f"{person} of {os.path.basename(path)}"


def with_both_triangles(library: StrokeLibrary) -> StrokeLibrary:
    """Call apex-up "triangle" "triangle up", and mirror it where there is no "triangle down"."""
    if "triangle" in library.labels and "triangle up" not in library.labels:
        library = renamed(library, {"triangle": "triangle up"})
    if "triangle up" in library.labels and "triangle down" not in library.labels:
        library = with_mirror_images(library, {"triangle up": "triangle down"})
    return library


def sign_labels(language: Language) -> tuple[str, ...]:
    """Return the labels of all signs of a language, prototypes included, once each."""
    words = (language.focus_signs, language.movement_signs, language.filler_signs, language.prototypes)
    return tuple(dict.fromkeys(label for group in words for label in group))
