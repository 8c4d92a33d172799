"""Demonstrations composed from strokes, and separately their ground truth (paper, section II-A).

The `GroundTruth` is for evaluators. Nothing in a `DemonstrationSet` leads to it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.languages import Language, Request
from signimit.teaching.people.glyphs import GOAL_LABELS
from signimit.teaching.scenes import drawn_path, reaching_path, sample_hand, sample_scene, sample_times
from signimit.teaching.stroke_sampler import StrokeSource, as_source

HALF_SIZE = (0.09, 0.12)  # m, half the larger side of a drawn movement
Strokes = StrokeLibrary | StrokeSource
SceneSampler = Callable[[np.random.Generator, int], NDArray[np.float64]]
Scalar = TypeVar("Scalar", bound=np.generic)


@one_line
@dataclass(frozen=True, eq=False)
class GroundTruth:
    """Ground truth of demonstrations: the requests and the drawings. For evaluators, never for a learner.

    Attributes:
        language: The language that was spoken.
        movement: Index of the movement, shape (N,); read-only.
        focus: Index of the object, shape (N,); read-only.
        templates: For each movement the loops that were demonstrated, each (T, 2), m, object's frame;
            read-only.
        spoilt: Numbers of the demonstrations in which the hand does not do what the words ask for, shape (S,);
            read-only. Movement and focus are what they ask for.
    """

    language: Language
    movement: NDArray[np.int64]
    focus: NDArray[np.int64]
    templates: tuple[tuple[NDArray[np.float64], ...], ...]
    spoilt: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    def __post_init__(self) -> None:
        """Copy and make read-only."""
        object.__setattr__(self, "movement", _read_only(self.movement))
        object.__setattr__(self, "focus", _read_only(self.focus))
        object.__setattr__(self, "spoilt", _read_only(self.spoilt))
        templates = tuple(tuple(_read_only(drawing) for drawing in drawings) for drawings in self.templates)
        object.__setattr__(self, "templates", templates)

    @property
    def movement_names(self) -> tuple[str, ...]:
        """Label of the movement of each demonstration."""
        return tuple(self.language.movements[m] for m in self.movement)

    @property
    def requests(self) -> tuple[Request, ...]:
        """What was asked for in each demonstration."""
        return tuple(Request(int(m), int(f)) for m, f in zip(self.movement, self.focus, strict=True))

    @property
    def sound(self) -> NDArray[np.bool_]:
        """Whether each demonstration does what it asks for, shape (N,)."""
        return ~np.isin(np.arange(len(self.movement)), self.spoilt)

    def select(self, kept: NDArray[np.int64]) -> GroundTruth:
        """Return the truth of some demonstrations, by their numbers, shape (K,)."""
        spoilt = np.flatnonzero(~self.sound[kept])
        return GroundTruth(self.language, self.movement[kept], self.focus[kept], self.templates, spoilt)


def compose_demonstrations(
    language: Language,
    signs: Strokes,
    movements: Strokes,
    rng: np.random.Generator,
    scenes: SceneSampler = sample_scene,
) -> tuple[DemonstrationSet, GroundTruth]:
    """Make the demonstrations of a session, in random order.

    Each is an utterance, a random scene, and a hand that starts anywhere, reaches for the movement's first point and
    draws the movement about the object asked for, `Language.rounds` times.

    Args:
        language: What is spoken.
        signs: Strokes of the interactant; a `StrokeSampler` remembers which were used before.
        movements: Strokes of the demonstrator.
        rng: Decides everything.
        scenes: Draws where the objects are, shape (O, 2), m, table frame, from a generator and their number.

    Returns:
        What the imitator may see, and the truth.

    Raises:
        UnknownNameError: If a library lacks a sign or a movement of the language.
    """
    signs, movements = as_source(signs), as_source(movements)
    requests = [
        language.seen[i % len(language.seen)] for i in rng.permutation(len(language.seen) * language.repetitions)
    ]
    templates: list[list[NDArray[np.float64]]] = [[] for _ in language.movements]
    demonstrations = []
    for request in requests:
        demonstration, loops = compose_demonstration(language, signs, movements, request, rng, scenes)
        demonstrations.append(demonstration)
        templates[request.movement] += loops
    movement_of, focus_of = np.array(requests, dtype=np.int64).T
    truth = GroundTruth(language, movement_of, focus_of, tuple(tuple(t) for t in templates))
    return DemonstrationSet(demonstrations), truth


def compose_demonstration(
    language: Language,
    signs: Strokes,
    movements: Strokes,
    request: Request,
    rng: np.random.Generator,
    scenes: SceneSampler = sample_scene,
) -> tuple[Demonstration, list[NDArray[np.float64]]]:
    """Make one demonstration: arguments as of `compose_demonstrations`.

    Returns:
        The demonstration, and the loops that were drawn in it, each (T, 2), m, object's frame.

    Raises:
        UnknownNameError: If the strokes lack a sign or a movement.
    """
    utterance = compose_utterance(language, signs, *request, rng)
    objects = scenes(rng, language.objects)
    loops = compose_loops(language, movements, request.movement, rng)
    hand = compose_path(sample_hand(rng), [loop + objects[request.focus] for loop in loops])
    return Demonstration(utterance, objects, hand, sample_times(len(hand))), loops


def compose_utterance(
    language: Language, signs: Strokes, movement: int, focus: int, rng: np.random.Generator
) -> tuple[NDArray[np.float64], ...]:
    """Let the interactant ask for a movement about an object.

    Returns:
        W signs, each of shape (T_s, 2), in the order they are made.

    Raises:
        InvalidInputError: If the language has no such movement or object.
        UnknownNameError: If the strokes lack a sign.
    """
    for name, value, count in (("movement", movement, len(language.movements)), ("focus", focus, language.objects)):
        if not 0 <= value < count:
            raise InvalidInputError(name, f"an index below {count}", f"{value}")
    source = as_source(signs)
    means = {
        language.focus_word: language.focus_signs[focus],
        language.movement_word: language.movement_signs[movement],
    }
    fillers, words = language.filler_signs, []
    for place in range(language.words):
        words.append(means[place] if place in means else fillers[int(rng.integers(len(fillers)))])
    return tuple(source.draw(word, rng).points for word in words)


def compose_loops(
    language: Language, movements: Strokes, movement: int, rng: np.random.Generator
) -> list[NDArray[np.float64]]:
    """Let the demonstrator draw a movement about an object at the origin, twice in most languages, each (T, 2), m."""
    return draw_loops(movements, language.movements[movement], language.rounds, rng)


def draw_loops(movements: Strokes, label: str, rounds: int, rng: np.random.Generator) -> list[NDArray[np.float64]]:
    """Let the demonstrator draw what has this label so many times about the origin, each (T, 2), m.

    All are of one random size and by one writer, different strokes where there are as many. A reach for a goal is made
    once.
    """
    goal = label in GOAL_LABELS
    half_size = rng.uniform(*HALF_SIZE)
    strokes = as_source(movements).draw_several(label, rng, 1 if goal else rounds)
    return [drawn_path(stroke, half_size, end_at_object=goal) for stroke in strokes]


def compose_path(start: NDArray[np.float64], loops: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Join a hand's start and the loops it draws by minimum-jerk reaches, shape (T, 2), every 20 ms."""
    parts, hand = [], start
    for loop in loops:
        parts += [reaching_path(hand, loop[0]), loop]
        hand = loop[-1]
    return np.concatenate(parts)


def movement_templates(
    language: Language, movements: Strokes, rng: np.random.Generator, count: int = 4
) -> tuple[tuple[NDArray[np.float64], ...], ...]:
    """Draw each movement ``count`` times about an object at the origin, to judge performances by.

    Returns:
        For each movement its drawings, each (T, 2), m, object's frame.
    """
    source = as_source(movements)
    drawings = [
        [compose_loops(language, source, m, rng)[0] for _ in range(count)] for m in range(len(language.movements))
    ]
    return tuple(tuple(drawing) for drawing in drawings)


def compose_prototypes(language: Language, signs: Strokes, rng: np.random.Generator) -> tuple[Stroke, ...]:
    """Let the interactant draw the language's prototype signs once."""
    source = as_source(signs)
    return tuple(source.draw(label, rng) for label in language.prototypes)


def _read_only(array: NDArray[Scalar]) -> NDArray[Scalar]:
    copy = array.copy()
    copy.setflags(write=False)
    return copy
