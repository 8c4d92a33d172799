"""The cells of the study: kinds of sessions, and sessions of a kind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.paths import half_size
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.composition import GroundTruth, compose_demonstrations, compose_prototypes, compose_utterance
from signimit.teaching.languages import Language, Request
from signimit.teaching.people import synthetic_library
from signimit.teaching.scenes import sample_scene
from signimit.teaching.stroke_sampler import StrokeSampler

CONDITIONS = ("plain", "noise", "unbalanced", "swapped", "filler", "constant filler", "unseen third", "mixed")
FOCUS_SIGNS = ("1", "2", "3", "0", "6", "5")
MOVEMENT_SIGNS = ("4", "5", "6", "0", "7", "8", "9", "2")  # the same digit may mean different things as another word
FILLER_SIGNS = ("7", "8", "9")
SYNTHETIC_MOVEMENTS = (
    "triangle up", "triangle down", "circle", "square", "star", "figure eight", "zigzag", "spiral",
)  # fmt: skip
REAL_MOVEMENTS = (
    "triangle up", "triangle down", "circle", "rectangle", "star", "circle, other way", "pigtail",
)  # fmt: skip
NOISE = 0.06  # half sizes, root mean square of the waver that "noise" adds to every stroke
CROWD = 6  # synthetic people where each sign and movement may be another one's
SAMPLES = 16  # strokes of each label by a synthetic person
FEW, MANY = 1, 3  # demonstrations of a pair of odd and of even movements where counts are unbalanced


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A kind of sessions.

    Attributes:
        movements: How many.
        objects: How many.
        repetitions: Demonstrations of each pair that is shown; ignored where counts are unbalanced.
        condition: One of `CONDITIONS`.
        people: ``"synthetic"`` or ``"real"``.
    """

    movements: int
    objects: int
    repetitions: int
    condition: str = "plain"
    people: str = "synthetic"

    def __post_init__(self) -> None:
        """Check.

        Raises:
            InvalidInputError: If nobody knows so many signs or movements, or not the condition.
        """
        most = len(REAL_MOVEMENTS if self.people == "real" else SYNTHETIC_MOVEMENTS)
        if not (1 <= self.movements <= most and 1 <= self.objects <= len(FOCUS_SIGNS)):
            expected = f"up to {most} movements and {len(FOCUS_SIGNS)} objects"
            raise InvalidInputError("cell", expected, f"{self.movements} and {self.objects}")
        if self.condition not in CONDITIONS:
            raise InvalidInputError("cell: condition", ", ".join(CONDITIONS), repr(self.condition))

    @property
    def name(self) -> str:
        """What it is called in files."""
        return f"{self.people} {self.movements}x{self.objects}x{self.repetitions} {self.condition}"

    @property
    def language(self) -> Language:
        """What is spoken in it."""
        names = REAL_MOVEMENTS if self.people == "real" else SYNTHETIC_MOVEMENTS
        pairs = [Request(m, f) for m in range(self.movements) for f in range(self.objects)]
        unseen = tuple(p for p in pairs if sum(p) % 3 == 0) if self.condition == "unseen third" else ()
        focus_word, movement_word = {"swapped": (1, 0), "filler": (2, 0), "constant filler": (2, 0)}.get(
            self.condition, (0, 1)
        )
        fillers = {"filler": FILLER_SIGNS, "constant filler": FILLER_SIGNS[:1]}.get(self.condition, ())
        return Language(
            focus_signs=FOCUS_SIGNS[: self.objects],
            movement_signs=MOVEMENT_SIGNS[: self.movements],
            movements=names[: self.movements],
            filler_signs=fillers,
            focus_word=focus_word,
            movement_word=movement_word,
            unseen=unseen,
            repetitions=MANY if self.condition == "unbalanced" else self.repetitions,
        )


PLAIN_SIZES = (
    (2, 2, 1), (2, 3, 2), (3, 3, 1), (3, 3, 2), (3, 3, 4), (5, 3, 1), (5, 4, 1), (8, 3, 1), (8, 2, 2), (3, 6, 1),
    (5, 6, 1), (3, 3, 6), (2, 4, 5), (6, 2, 3), (8, 6, 1),
)  # fmt: skip


def study_cells(real: bool) -> list[Cell]:
    """Return all cells: sizes in the plain condition, and every other condition at two sizes."""
    cells = [Cell(movements=m, objects=o, repetitions=r) for m, o, r in PLAIN_SIZES]
    for condition in CONDITIONS[1:]:
        cells.append(Cell(movements=3, objects=3, repetitions=2, condition=condition))
    cells += [Cell(movements=5, objects=4, repetitions=1, condition=c) for c in CONDITIONS[1:]]
    if real:
        sizes = ((3, 3, 1), (3, 3, 2), (5, 4, 1), (7, 3, 1), (3, 3, 5), (7, 6, 1))
        cells.append(Cell(movements=7, objects=3, repetitions=1, condition="mixed", people="real"))
        cells += [Cell(movements=m, objects=o, repetitions=r, people="real") for m, o, r in sizes]
        cells += [Cell(movements=3, objects=3, repetitions=2, condition=c, people="real") for c in CONDITIONS[1:]]
        cells += [Cell(movements=5, objects=4, repetitions=1, condition=c, people="real") for c in CONDITIONS[1:]]
    return cells


class People(NamedTuple):
    """Recordings of real people, if any."""

    signs: StrokeLibrary
    movements: StrokeLibrary


class StudySession(NamedTuple):
    """A session and what it is judged by.

    Attributes:
        demonstrations: What the imitator sees.
        prototypes: For methods that need them.
        truth: What it is not told.
        commands: Every pair, signed once more: the request, the signs, the objects.
    """

    demonstrations: DemonstrationSet
    prototypes: tuple[Stroke, ...]
    truth: GroundTruth
    commands: tuple[tuple[Request, tuple[NDArray[np.float64], ...], NDArray[np.float64]], ...]


def compose_session(cell: Cell, seed: int, people: People | None = None) -> StudySession:
    """Compose a session of a cell; the same cell and seed give the same session.

    Args:
        cell: Its kind.
        seed: Decides who takes part and everything else.
        people: Whose strokes; synthetic people draw where there are none.

    Raises:
        InvalidInputError: If nobody drew all that the language needs.
    """
    rng = np.random.default_rng([seed, cell.movements, cell.objects, cell.repetitions])
    language = cell.language
    signs, movements = cast_strokes(cell, rng, people, SAMPLES)
    deck = StrokeSampler(signs)
    prototypes = compose_prototypes(language, deck, rng)
    demonstrations, truth = compose_demonstrations(language, deck, movements, rng)
    if cell.condition == "unbalanced":
        demonstrations, truth = _unbalanced(demonstrations, truth)
    commands = tuple(
        (pair, compose_utterance(language, deck, *pair, rng), sample_scene(rng, cell.objects))
        for pair in language.requests
    )
    return StudySession(demonstrations, prototypes, truth, commands)


def cast_strokes(
    cell: Cell, rng: np.random.Generator, people: People | None, samples: int
) -> tuple[StrokeLibrary, StrokeLibrary]:
    """Choose who signs and who moves in a session of a cell.

    Args:
        cell: Its kind.
        rng: Decides who.
        people: Whose strokes; synthetic people draw where there are none.
        samples: How many strokes of each label a synthetic person draws.

    Raises:
        InvalidInputError: If nobody drew all that the language needs.
    """
    language, crowd = cell.language, cell.condition == "mixed"
    words = (*language.focus_signs, *language.movement_signs, *language.filler_signs, *language.prototypes)
    labels = tuple(dict.fromkeys(words))
    if people is None:
        writers = CROWD if crowd else 1
        signs = synthetic_library(labels, writers=writers, samples=samples // writers, rng=rng)
        movements = synthetic_library(language.movements, writers=writers, samples=samples, rng=rng)
    elif crowd:
        signs, movements = people
    else:
        signs = choose_person(people.signs, labels, rng)
        movements = choose_person(people.movements, language.movements, rng)
    if cell.condition == "noise":
        signs, movements = wavering(signs, rng), wavering(movements, rng)
    return signs, movements


def choose_person(
    library: StrokeLibrary, labels: Sequence[str], rng: np.random.Generator, least: int = 1
) -> StrokeLibrary:
    """Choose somebody who drew all labels at least so often.

    Raises:
        InvalidInputError: If nobody did.
    """
    drawn = Counter(zip(library.writers, library.labels, strict=True))
    able = [w for w in sorted(set(library.writers)) if all(drawn[w, label] >= least for label in labels)]
    if not able:
        raise InvalidInputError("stroke library", f"somebody who drew {', '.join(labels)}", "nobody")
    return library.select(writer=able[int(rng.integers(len(able)))])


def wavering(library: StrokeLibrary, rng: np.random.Generator, noise: float = NOISE) -> StrokeLibrary:
    """Add a slow random waver to every stroke, another one each time: three waves in each direction.

    Args:
        library: The strokes.
        rng: Decides the waves.
        noise: Root mean square of the waver, in half sizes of a stroke.
    """
    strokes = []
    for stroke in library.strokes:
        half = half_size(stroke.points)
        share = np.linspace(0, 1, len(stroke.points))[:, None, None]
        waves = np.sin(2 * np.pi * (rng.uniform(0.5, 4, (3, 2)) * share + rng.random((3, 2)))).sum(axis=1)
        strokes.append(Stroke(stroke.points + noise * half * waves * np.sqrt(2 / 3), stroke.times))
    return StrokeLibrary(tuple(strokes), library.labels, library.writers, library.source)


def _unbalanced(demonstrations: DemonstrationSet, truth: GroundTruth) -> tuple[DemonstrationSet, GroundTruth]:
    """Keep all demonstrations of even movements and one a pair of odd ones."""
    kept, counts = [], Counter[Request]()
    for t, pair in enumerate(truth.requests):
        counts[pair] += 1
        if counts[pair] <= (FEW if pair.movement % 2 else MANY):
            kept.append(t)
    fewer = DemonstrationSet([demonstrations[t] for t in kept])
    return fewer, GroundTruth(truth.language, truth.movement[kept], truth.focus[kept], truth.templates)
