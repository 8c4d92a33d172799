"""Demonstrations of which one thing at a time is varied: senses of rotation, rounds, points, pace, scatter, reach."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit import paths
from signimit.exceptions import InvalidInputError
from signimit.policies.base import CONTROL_PERIOD, Array
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.composition import HALF_SIZE
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library
from signimit.teaching.people.choosing import Source, load_person
from signimit.teaching.people.relabelling import with_waver
from signimit.teaching.scenes import LEAST_SEPARATION, SCENE_HALF_EXTENT, drawn_path, reaching_path
from signimit.teaching.stroke_sampler import StrokeSampler

MOST_ROUNDS = 6  # drawings that are drawn for each demonstration, whether or not all are used
SAMPLES = 4 * MOST_ROUNDS  # strokes of each movement by a synthetic person: none is used twice
FULL_TABLE = 0.25  # m between objects up to which three of them are found on the table by trial; beyond, it grows
SHAPES, PACES, REACHES = ("drawn", "ideal"), ("own", "even"), ("to the beginning", "to the nearest point", "none")
ONE_SENSE, CIRCLE_AGAINST = (1, 1, 1), (1, 1, -1)
UP_AGAINST, DOWN_AGAINST = (-1, 1, 1), (1, -1, 1)


@dataclass(frozen=True, kw_only=True)
class Variation:
    """How the demonstrations of a session are drawn; the defaults are this project's composer, but for the senses.

    Attributes:
        senses: Sense of rotation of triangle up, triangle down and circle: 1 counter-clockwise, -1 clockwise. A
            drawing with the other sense is mirrored at a vertical line, which keeps the shape and its kinematics.
        shape: "drawn" by a person, or "ideal": straight sides, a true circle, closed.
        pace: "own", or "even": points at equal distances, as of a hand of constant speed.
        rounds: How often the movement is drawn in a demonstration, 1 to 6.
        density: Points in a second, as a multiple of the usual 50.
        one_drawing: Whether all drawings of a movement are the same one.
        waver: Noise added to every drawing, root mean square, in half sizes.
        sizes: Least and largest half size of a drawing, m.
        reach: Where the hand goes from its start, "to the beginning" of the drawing or "to the nearest point" of it;
            "none": it starts there.
        separation: Least distance between objects, m.
    """

    senses: tuple[int, int, int] = CIRCLE_AGAINST
    shape: str = "drawn"
    pace: str = "own"
    rounds: int = PAPER_LANGUAGE.rounds
    density: float = 1.0
    one_drawing: bool = False
    waver: float = 0.0
    sizes: tuple[float, float] = HALF_SIZE
    reach: str = "to the beginning"
    separation: float = LEAST_SEPARATION

    def __post_init__(self) -> None:
        """Check the names and numbers."""
        for name, known in (("shape", SHAPES), ("pace", PACES), ("reach", REACHES)):
            if getattr(self, name) not in known:
                raise InvalidInputError(f"variation: {name}", ", ".join(known), f"{getattr(self, name)!r}")
        if not 1 <= self.rounds <= MOST_ROUNDS:
            raise InvalidInputError("variation: rounds", f"1 to {MOST_ROUNDS}", f"{self.rounds}")


class VariedSession(NamedTuple):
    """Demonstrations, and what they were.

    Attributes:
        paths: Hand paths, each (T, 2), m, table frame.
        objects: Where the objects are, shape (N, O, 2), m, table frame.
        movement: Index of the movement of each, shape (N,).
        focus: Index of the object of each, shape (N,).
        drawings: For each movement what was drawn, each (T, 2), m, object's frame.
    """

    paths: list[Array]
    objects: Array
    movement: NDArray[np.int64]
    focus: NDArray[np.int64]
    drawings: list[list[Array]]


def compose_varied(person: StrokeLibrary, variation: Variation, seed: int) -> VariedSession:
    """Compose the paper's twelve demonstrations.

    The same seed gives the same requests, places, starts and sizes (as shares of their ranges), whatever is varied.

    Args:
        person: Strokes of both triangles and the circle by one mover.
        variation: How they are drawn.
        seed: Decides everything else.
    """
    order, places, hands, sizes, strokes = (np.random.default_rng([seed, stream]) for stream in range(5))
    language, period = PAPER_LANGUAGE, CONTROL_PERIOD / variation.density
    seen = language.seen * language.repetitions
    requests = [seen[i] for i in order.permutation(len(seen))]
    library = ideal_library() if variation.shape == "ideal" else person
    if variation.waver:
        library = with_waver(library, strokes, variation.waver)
    sampler = StrokeSampler(library)
    favourites = [sampler.draw(label, strokes) for label in language.movements]
    movement_of, focus_of = np.array(requests, dtype=np.int64).T
    session = VariedSession([], np.empty((len(seen), 3, 2)), movement_of, focus_of, [[], [], []])
    for t, (movement, focus) in enumerate(requests):
        scene, start = sample_distant_scene(places, variation.separation), hands.uniform(-1.0, 1.0, 2)
        least, largest = variation.sizes
        half_size = least + (largest - least) * sizes.random()
        drawn = sampler.draw_several(language.movements[movement], strokes, MOST_ROUNDS)[: variation.rounds]
        if variation.one_drawing:
            drawn = (favourites[movement],) * variation.rounds
        loops = [_loop(stroke, half_size, variation, variation.senses[movement], period) for stroke in drawn]
        hand = start * SCENE_HALF_EXTENT - scene[focus]
        session.objects[t] = scene
        session.paths.append(_path(hand, loops, variation.reach, period) + scene[focus])
        session.drawings[movement].extend(loops)
    return session


def _loop(stroke: Stroke, half_size: float, variation: Variation, sense: int, period: float) -> Array:
    """Draw a stroke about an object at the origin in a sense of rotation, shape (T, 2), m."""
    loop = drawn_path(stroke, half_size, period=period)
    if sense * rotation(loop) < 0:
        loop = loop * [-1.0, 1.0]
    return paths.resample_path(loop, len(loop)) if variation.pace == "even" else loop


def _path(hand: Array, loops: list[Array], reach: str, period: float) -> Array:
    """Join a hand's start, m, object's frame, and loops, as `compose_path` does where the reach is to the beginning."""
    parts = []
    for number, loop in enumerate(loops):
        if reach == "to the nearest point":
            loop = begun_near(loop, hand)
        if number or reach != "none":
            parts.append(reaching_path(hand, loop[0], period))
        parts.append(loop)
        hand = loop[-1]
    return np.concatenate(parts)


def begun_near(loop: Array, hand: Array) -> Array:
    """Close a loop, shape (T, 2), by spreading the gap over it, and begin it at its point nearest to a hand."""
    closed = loop + np.linspace(0.0, 1.0, len(loop))[:, None] * (loop[0] - loop[-1])
    first = int(np.hypot(*(closed - hand).T).argmin())
    return np.concatenate([closed[first:], closed[1 : first + 1]])


def rotation(loop: Array) -> float:
    """Compute twice the signed area of a closed path, shape (T, 2), m²: positive if it runs counter-clockwise."""
    x, y = loop.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def sample_distant_scene(rng: np.random.Generator, separation: float) -> Array:
    """Draw three places, shape (3, 2), m, at least so far apart, on the usual table or a larger one."""
    extent = np.array(SCENE_HALF_EXTENT) * max(1.0, separation / FULL_TABLE)
    while True:
        scenes = rng.uniform(-1.0, 1.0, (256, 3, 2)) * extent
        gaps = np.linalg.norm(scenes - np.roll(scenes, 1, axis=1), axis=2).min(axis=1)
        if (gaps >= separation).any():
            return np.asarray(scenes[int((gaps >= separation).argmax())])


def choose_mover(library: StrokeLibrary | None, seed: int) -> StrokeLibrary:
    """Return the strokes of the mover of a session: the library's people in turn, or a new built-in person each."""
    rng = np.random.default_rng([seed, 5])
    if library is None:
        return synthetic_library(PAPER_LANGUAGE.movements, samples=SAMPLES, rng=rng)
    writers = sorted(set(library.writers))
    return load_person(Source(library, writers[seed % len(writers)]), PAPER_LANGUAGE.movements, rng)[0]


def ideal_library() -> StrokeLibrary:
    """Return ideal drawings of unit half width at constant speed: both triangles and the circle, from the top."""
    turn = np.linspace(0.0, 2.0 * np.pi, 181) + np.pi / 2
    shapes = {
        "circle": np.column_stack([np.cos(turn), np.sin(turn)]),
        "triangle up": np.array([(0.0, 1.0), (-1.0, -0.8), (1.0, -0.8), (0.0, 1.0)]),
        "triangle down": np.array([(-1.0, 0.8), (0.0, -1.0), (1.0, 0.8), (-1.0, 0.8)]),
    }
    times = np.linspace(0.0, 2.0, 401)  # s; the speed is brought into that of hands when it is drawn
    strokes = [Stroke(paths.resample_path(corners, len(times)), times) for corners in shapes.values()]
    return StrokeLibrary(
        tuple(strokes) * SAMPLES, tuple(shapes) * SAMPLES, ("ideal",) * (3 * SAMPLES), "ideal drawings"
    )
