"""What the judge accepts: people's own redrawings, and everything that must be refused, on people who were left out.

In a session one person draws three movements, a few times each; these drawings are the judge's. Then the hand draws
about one of three objects: the same movements anew, pieces of them, the wrong way, elsewhere, in another size, and other
shapes. `choose_thresholds` chooses the judge's constants on some people; `leave_groups_out` tells how they do on others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.statistics import Share
from signimit.evaluation import COVERED, TOLERANCE, PathJudge
from signimit.exceptions import InvalidInputError
from signimit.strokes import StrokeLibrary
from signimit.teaching.composition import HALF_SIZE, compose_path
from signimit.teaching.people import MOVEMENT_LABELS, synthetic_library
from signimit.teaching.scenes import drawn_path, sample_hand, sample_scene

Array = NDArray[np.float64]

MOVEMENTS = 3  # of a session
SHOWN = 4  # drawings of each movement that the judge has
OWN = "own"  # the kind of path that must be accepted; all names that begin with it
WANTED_SHARE = 0.99  # of own redrawings that thresholds must accept
TOLERANCES = tuple(np.round(np.arange(0.15, 0.36, 0.01), 2).tolist())
COVERAGES = tuple(np.round(np.arange(0.86, 0.985, 0.01), 2).tolist())
CIRCLES, RECTANGLES = ("circle", "circle, other way"), ("rectangle", "square")
_ASIDE = 0.05  # m
_BUILT_IN_SAMPLES = 12  # drawings of each movement by a built-in person


def _piece(share: float) -> Callable[[Array], Array]:
    return lambda loop: loop[: max(2, round(share * len(loop)))]


def _to_and_fro(loop: Array) -> Array:
    half = loop[: len(loop) // 2]
    return np.concatenate([half, half[::-1], half, half[::-1]])


SPOILT: Mapping[str, Callable[[Array], Array]] = MappingProxyType(
    {
        "half of it": _piece(0.5),
        "70 % of its time": _piece(0.7),
        "three quarters of its time": _piece(0.75),
        "half of it to and fro": _to_and_fro,
        "reversed": lambda loop: loop[::-1],
        "half size": lambda loop: 0.5 * loop,
        "double size": lambda loop: 2.0 * loop,
    }
)
"""What a hand does instead of a movement, by its name in the table."""


class Trial(NamedTuple):
    """One path, and how the drawings of the movement that fits it best compare with it.

    Attributes:
        group: Name of the person, or of the people who are left out together.
        kind: What was done, e.g. ``"own, drawn once"`` or ``"reversed"``.
        label: Movement.
        right: Whether the best candidate is what the path may be taken for: if it counts, it is accepted.
        misfit: Of each comparison, shape (C,), half sizes.
        coverage: The same.
        fits: Whether size and way there are good enough, shape (C,).
    """

    group: str
    kind: str
    label: str
    right: bool
    misfit: Array
    coverage: Array
    fits: NDArray[np.bool_]

    def accepted(self, tolerance: float = TOLERANCE, covered: float = COVERED) -> bool:
        """Say whether the path is accepted with these thresholds."""
        return self.right and bool((self.fits & (self.misfit <= tolerance) & (self.coverage >= covered)).any())


class Acceptance(NamedTuple):
    """A row of the table: how many paths of a kind are accepted.

    Attributes:
        people: Whose.
        kind: What was done.
        share: Accepted, with the package's thresholds.
        left_out: Accepted, with thresholds that were chosen on other people.
    """

    people: str
    kind: str
    share: Share
    left_out: Share


def built_in_people(count: int, seed: int) -> Iterator[StrokeLibrary]:
    """Let synthetic people draw all closed movements; each has a library of their own."""
    for person in range(count):
        yield synthetic_library(MOVEMENT_LABELS, samples=_BUILT_IN_SAMPLES, rng=np.random.default_rng([seed, person]))


def run_judge(
    library: StrokeLibrary,
    group: str,
    movements: Sequence[str],
    sessions: int,
    rng: np.random.Generator,
    redrawn: bool = True,
) -> Iterator[Trial]:
    """Show drawings to the judge and let it look at paths.

    Args:
        library: Drawings of one person, or of strangers who draw as one.
        group: What trials are called by.
        movements: Labels that sessions are made of; the other labels are other shapes.
        sessions: How many.
        rng: Decides everything.
        redrawn: Whether drawings of one label are redrawings of each other. Strangers' are not: then what is redrawn is
            a drawing that was shown.

    Raises:
        InvalidInputError: If there are not enough movements, or drawings of one.
    """
    drawings = {label: library.select(label=label).strokes for label in dict.fromkeys(library.labels)}
    known = [label for label in movements if label in drawings]
    fewest = SHOWN + 2 * redrawn
    if len(known) < MOVEMENTS or min(len(drawings[label]) for label in known) < fewest:
        raise InvalidInputError(group, f"{MOVEMENTS} movements drawn {fewest} times each", f"{known}")
    for _ in range(sessions):
        chosen = [known[i] for i in rng.permutation(len(known))[:MOVEMENTS]]
        yield from _run_session(drawings, group, chosen, rng, redrawn)


def _run_session(
    drawings: Mapping[str, Sequence], group: str, chosen: Sequence[str], rng: np.random.Generator, redrawn: bool
) -> Iterator[Trial]:
    shuffled = {label: [strokes[i] for i in rng.permutation(len(strokes))] for label, strokes in drawings.items()}

    def draw(label: str, number: int) -> Array:
        return drawn_path(shuffled[label][number % len(shuffled[label])], rng.uniform(*HALF_SIZE))

    shown = [[draw(label, i) for i in range(SHOWN)] for label in chosen]
    judge, once = PathJudge(shown), PathJudge(shown, [False] * len(chosen))

    def look(kind: str, label: str, loops: Sequence[Array], movement: int, judge: PathJudge = judge) -> Iterator[Trial]:
        """Draw about an object and judge whether it is a movement about it."""
        objects, focus = sample_scene(rng), int(rng.integers(3))
        path = compose_path(sample_hand(rng), [loop + objects[focus] for loop in loops])
        found = judge.compare(path, objects)
        named, place, same = judge.best(found) if len(found.misfit) else (-1, -1, np.zeros(0, dtype=np.bool_))
        fits = judge.fits(found)

        def trial(kind: str, right: bool) -> Trial:
            return Trial(group, kind, label, right, found.misfit[same], found.coverage[same], fits[same])

        yield trial(kind, place == focus and named == movement)
        if kind.startswith(OWN):
            yield trial("taken for another movement", named != movement)
            yield trial("taken for one about another object", place != focus)

    for m, label in enumerate(chosen):
        first, second = (
            (draw(label, SHOWN), draw(label, SHOWN + 1)) if redrawn else (draw(label, 0), draw(label, 1 % SHOWN))
        )
        yield from look("own, drawn once", label, [first], m)
        yield from look("own, drawn twice", label, [first, second] if redrawn else [first, first], m)
        yield from look("own, made once and then at rest", label, [first], m, once)
        yield from look("thrice, where it is made once", label, [first, second, first], m, once)
        for kind, spoil in SPOILT.items():
            yield from look(kind, label, [spoil(second if redrawn else first)], m)
        turn = rng.uniform(0, 2 * np.pi)
        aside = _ASIDE * np.array([np.cos(turn), np.sin(turn)])
        yield from look("5 cm off", label, [first + aside], m)
    for label in drawings:
        if label in chosen:
            continue
        for m, movement in enumerate(chosen):
            kind = "another shape"
            if movement in CIRCLES and label in RECTANGLES:
                kind = "a rectangle for a circle"
            elif movement in RECTANGLES and label in CIRCLES:
                kind = "a circle for a rectangle"
            yield from look(kind, f"{label} for {movement}", [draw(label, SHOWN)], m)


def choose_thresholds(trials: Sequence[Trial]) -> tuple[float, float]:
    """Choose tolerance and coverage: of those that accept 99 % of own redrawings, the pair that refuses most else.

    If none does, the pair that accepts most own redrawings. Of equals the one that is easiest on redrawings.
    """
    groups = [[t for t in trials if t.kind.startswith(OWN) is own and t.right] for own in (True, False)]
    total = sum(t.kind.startswith(OWN) for t in trials)

    def rank(pair: tuple[float, float]) -> tuple[float, int, float, float]:
        own, other = (sum(t.accepted(*pair) for t in group) for group in groups)
        return min(own / total, WANTED_SHARE), -other, pair[0], -pair[1]

    return max(product(TOLERANCES, COVERAGES), key=rank)


def tabulate_acceptance(people: str, trials: Sequence[Trial], chosen: Mapping[str, tuple[float, float]]) -> list[Acceptance]:
    """Count what is accepted, a row for each kind.

    Args:
        people: What they are called in the table.
        trials: Their trials.
        chosen: For each group the thresholds that were chosen on others.
    """
    kinds = dict.fromkeys(t.kind for t in trials)
    return [
        Acceptance(
            people,
            kind,
            Share.of(t.accepted() for t in trials if t.kind == kind),
            Share.of(t.accepted(*chosen[t.group]) for t in trials if t.kind == kind),
        )
        for kind in kinds
    ]
