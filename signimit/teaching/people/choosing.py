"""The people of a session: one person makes the signs, another shows the movements."""

from __future__ import annotations

import os
import reprlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import Demonstration
from signimit.display import one_line
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.strokes import StrokeLibrary
from signimit.teaching.composition import SceneSampler, Strokes, compose_demonstration, compose_utterance
from signimit.teaching.languages import Language, Request
from signimit.teaching.people.person import Person, drawings, synthetic_library
from signimit.teaching.people.relabelling import with_both_triangles, with_waver
from signimit.teaching.scenes import sample_scene

SIGN_SAMPLES, MOVEMENT_SAMPLES = 24, 12  # how often a synthetic person draws each label
CROWD = 6  # synthetic people, where each sign and movement may be another one's
CLUMSY = 2.25  # times the usual spread: as far from each other as players of Quick, Draw! (`study clumsiness`)
LARGER, FASTER, MORE_SLANTED = 1.8, 1.8, 0.9  # another style: times the size, times the speed, shear added
WAVER = 0.18  # half sizes, root mean square, where people are noisy


StrokesT = TypeVar("StrokesT", bound=Strokes, covariant=True)


@dataclass(frozen=True, eq=False)
class People(Generic[StrokesT]):
    """The signer and the mover of a session, who share a language.

    Attributes:
        language: What they speak.
        signs: Strokes of the signer (the paper's interactant).
        movements: Strokes of the mover (the paper's demonstrator).
        asking: Strokes that commands are signed with; left out, the signer's go on.
        names: What signer and mover are called in reports.
    """

    language: Language
    signs: StrokesT
    movements: StrokesT
    asking: StrokesT | None = None
    names: tuple[str, str] = ("a synthetic person", "a synthetic person")

    def __repr__(self) -> str:
        """Say who they are, e.g. ``People(signer='writer 13', mover='writer 2')``."""
        signer, mover = map(reprlib.repr, self.names)
        return f"{type(self).__name__}(signer={signer}, mover={mover})"

    def speak(self, request: Request, rng: np.random.Generator) -> tuple[NDArray[np.float64], ...]:
        """Let the signer ask for something: W signs, each (T_s, 2), any unit, as `compose_utterance` makes them."""
        return compose_utterance(self.language, self.signs, *request, rng)

    def demonstrate(
        self, request: Request, rng: np.random.Generator, scenes: SceneSampler = sample_scene
    ) -> Demonstration:
        """Let the signer ask for something and the mover do it, as `compose_demonstration` says."""
        return compose_demonstration(self.language, self.signs, self.movements, request, rng, scenes)[0]


@one_line
class Source(NamedTuple):
    """Where a person's strokes come from.

    Attributes:
        library: Strokes of people, or a file of them; none stands for a synthetic person.
        person: Which of the library's writers; none for any who drew all that is needed.
    """

    library: StrokeLibrary | str | os.PathLike[str] | None = None
    person: str | None = None


SYNTHETIC = Source()


def choose_people(
    language: Language,
    rng: np.random.Generator,
    signer: Source = SYNTHETIC,
    mover: Source = SYNTHETIC,
    samples: tuple[int, int] = (SIGN_SAMPLES, MOVEMENT_SAMPLES),
) -> People[StrokeLibrary]:
    """Choose a signer and a mover who draw what a language needs.

    Args:
        language: What is spoken.
        rng: Draws the people, and the strokes of synthetic ones.
        signer: Who signs.
        mover: Who moves.
        samples: How often a synthetic signer and a synthetic mover draw each label.

    Raises:
        SignimitError: If a file or a person in it cannot be used.
    """
    needs = ((signer, language.signs, samples[0]), (mover, language.movements, samples[1]))
    people = []
    for source, labels, count in needs:
        if source.library is not None:
            people.append(load_person(source, labels, rng))
        elif source.person is not None:
            raise InvalidInputError(f"person {source.person!r}", "a stroke library to find them in", "none")
        else:
            people.append((synthetic_library(labels, samples=count, rng=rng), "a synthetic person"))
    (signs, interactant), (movements, demonstrator) = people
    return People(language, signs, movements, names=(interactant, demonstrator))


def load_person(
    source: Source, labels: Sequence[str], rng: np.random.Generator, least: int = 1
) -> tuple[StrokeLibrary, str]:
    """Take one person's strokes out of a library.

    Where labels ask for "triangle up" and "triangle down" and the library has only "triangle", apex up, its strokes
    serve as the one and mirrored as the other.

    Args:
        source: A library, or a file written by `StrokeLibrary.save`, and whose strokes; if no person is named, any
            who drew all labels.
        labels: What the person must have drawn.
        rng: Draws the person.
        least: How often the person must have drawn each label.

    Returns:
        The person's strokes, and a name for reports.

    Raises:
        FileFormatError: If it is no such file.
        UnknownNameError: If the library has no such person.
        InvalidInputError: If the person, or everybody, lacks one of the labels.
    """
    name = source.person
    if isinstance(source.library, StrokeLibrary):
        library, where, title = source.library, "stroke library", source.library.source
    else:
        where = os.fspath(source.library or "")
        library, title = StrokeLibrary.load(where), os.path.basename(where)
    library = with_both_triangles(library)
    if name is not None and name not in library.writers:
        raise UnknownNameError(f"person in {where}", name, sorted(set(library.writers)))
    candidates = sorted(set(library.writers)) if name is None else [name]
    drawn = Counter(zip(library.writers, library.labels, strict=True))
    able = [w for w in candidates if all(drawn[w, label] >= least for label in labels)]
    if not able:
        lacking = [label for label in labels if not any(drawn[w, label] >= least for w in candidates)]
        who = f"{where}: {name or 'everybody'}"
        wanted, found = ("strokes", "none") if least == 1 else (f"at least {least} strokes each", "fewer")
        raise InvalidInputError(who, f"{wanted} of {', '.join(labels)}", f"{found} of {', '.join(lacking) or 'some'}")
    person = able[int(rng.integers(len(able)))]
    return library.select(writer=person), f"{person} of {title}"


class PeopleChooser(Protocol):
    """A way of choosing the people of a session."""

    def __call__(
        self, language: Language, samples: int, who: np.random.Generator, how: np.random.Generator
    ) -> People[StrokeLibrary]:
        """Choose people and let them draw.

        Args:
            language: What they speak.
            samples: How often each person draws each label.
            who: Decides who they are.
            how: Decides how each of their strokes turns out.
        """
        ...


def same_people(
    language: Language,
    samples: int,
    who: np.random.Generator,
    how: np.random.Generator,
    *,
    further: Sequence[str] = (),
) -> People[StrokeLibrary]:
    """One signer and one mover, who draws ``further`` things besides the movements; the signer also asks in the end."""
    signer, mover = Person.sample(who), Person.sample(who)
    signs = _draw_all([signer], language.signs, samples, how)
    return People(language, signs, _draw_all([mover], (*language.movements, *further), samples, how))


def another_style(
    language: Language, samples: int, who: np.random.Generator, how: np.random.Generator
) -> People[StrokeLibrary]:
    """The same signer asks with larger, faster and more slanted signs than were shown."""
    signer, mover = Person.sample(who), Person.sample(who)
    style = signer.style
    changed = replace(style, size=LARGER * style.size, tempo=style.tempo / FASTER, slant=style.slant + MORE_SLANTED)
    signs = _draw_all([signer], language.signs, samples, how)
    movements = _draw_all([mover], language.movements, samples, how)
    return People(language, signs, movements, _draw_all([replace(signer, style=changed)], language.signs, samples, how))


def strangers(
    language: Language, samples: int, who: np.random.Generator, how: np.random.Generator
) -> People[StrokeLibrary]:
    """Every sign and every movement may be another one's of a crowd; a person who was never seen asks."""
    signer, mover = Person.sample(who), Person.sample(who)
    signers = [signer, *(Person.sample(who) for _ in range(CROWD - 1))]
    movers = [mover, *(Person.sample(who) for _ in range(CROWD - 1))]
    stranger = Person.sample(who)
    signs = _draw_all(signers, language.signs, samples, how)
    movements = _draw_all(movers, language.movements, samples, how)
    return People(language, signs, movements, _draw_all([stranger], language.signs, samples, how))


def clumsy_strangers(
    language: Language, samples: int, who: np.random.Generator, how: np.random.Generator
) -> People[StrokeLibrary]:
    """Everything is drawn by somebody else, and people are as far from each other as `CLUMSY` says.

    There are so many people as one would draw ``samples``. Each makes every sign once, and draws every movement in one
    demonstration; signs of those who have not made them yet ask.
    """
    signers = [Person.sample(who, CLUMSY) for _ in range(samples)]
    movers = [Person.sample(who, CLUMSY) for _ in range(samples)]
    signs = _draw_all(signers, language.signs, 1, how)
    return People(language, signs, _draw_all(movers, language.movements, language.rounds, how))


def wavering_people(
    language: Language, samples: int, who: np.random.Generator, how: np.random.Generator
) -> People[StrokeLibrary]:
    """The same people, and a slow waver in all that they draw."""
    signer, mover = Person.sample(who), Person.sample(who)
    signs = _draw_all([signer], language.signs, samples, how)
    movements = _draw_all([mover], language.movements, samples, how)
    return People(language, with_waver(signs, how, WAVER), with_waver(movements, how, WAVER))


def _draw_all(people: Sequence[Person], labels: Sequence[str], samples: int, how: np.random.Generator) -> StrokeLibrary:
    libraries = [drawings(p, f"synthetic {i + 1}", labels, samples, how) for i, p in enumerate(people)]
    return sum(libraries[1:], libraries[0])
