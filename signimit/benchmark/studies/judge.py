"""What the judge accepts: people's own redrawings, and everything that must be refused, on people who were left out.

In a session one person draws three movements, a few times each; these drawings are the judge's. Then the hand draws
about one of three objects: the same movements anew, pieces of them, the wrong way, elsewhere, in another size, and
other shapes. `choose_thresholds` chooses the judge's constants on some people, `leave_groups_out` for each on the
others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.statistics import Share
from signimit.benchmark.tables import markdown_table
from signimit.evaluation import COVERED, TOLERANCE, PathJudge
from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.composition import HALF_SIZE, compose_path
from signimit.teaching.people import MOVEMENT_LABELS, synthetic_library
from signimit.teaching.scenes import drawn_path, sample_hand, sample_scene

Array = NDArray[np.float64]

MOVEMENTS = 3  # of a session
SHOWN = 4  # drawings of each movement that the judge has
STRANGERS = "strangers"  # whose drawings of one label are not redrawings of each other
OWN = "own"  # the kind of path that must be accepted; all names that begin with it
WANTED_SHARE = 0.99  # of own redrawings that thresholds must accept
TOLERANCES = np.round(np.arange(0.15, 0.36, 0.01), 2)  # half sizes, that are tried
COVERAGES = np.round(np.arange(0.86, 0.985, 0.01), 2)  # shares, that are tried
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

    @property
    def own(self) -> bool:
        """Whether it is a redrawing, which must be accepted."""
        return self.kind.startswith(OWN)

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


def people_of(library: StrokeLibrary, movements: Sequence[str]) -> dict[str, StrokeLibrary]:
    """Return each writer's drawings, or all as one group of strangers if nobody drew enough of them."""
    alone = {writer: library.select(writer=writer) for writer in sorted(set(library.writers))}

    def often(one: StrokeLibrary) -> int:
        return sum(one.labels.count(label) >= SHOWN + 2 for label in movements)

    return {w: one for w, one in alone.items() if often(one) >= MOVEMENTS} or {STRANGERS: library}


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
    fewest = SHOWN + 2 * redrawn
    known = [label for label in movements if len(drawings.get(label, ())) >= fewest]
    if len(known) < MOVEMENTS:
        raise InvalidInputError(group, f"{MOVEMENTS} movements drawn {fewest} times each", f"{known}")
    for _ in range(sessions):
        chosen = [known[i] for i in rng.permutation(len(known))[:MOVEMENTS]]
        yield from _run_session(drawings, group, chosen, rng, redrawn)


def _run_session(
    drawings: Mapping[str, Sequence[Stroke]], group: str, chosen: Sequence[str], rng: np.random.Generator, redrawn: bool
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


class Counts(NamedTuple):
    """How many paths are accepted with each pair of `TOLERANCES` and `COVERAGES`.

    Attributes:
        own: Own redrawings, shape (tolerances, coverages).
        redrawings: How many there are in all.
        others: Paths that should be refused, shape (tolerances, coverages).
    """

    own: NDArray[np.int64]
    redrawings: int
    others: NDArray[np.int64]


def count_accepted(trials: Sequence[Trial]) -> Counts:
    """Count accepted paths with each pair of thresholds."""
    own, others = (np.zeros((len(TOLERANCES), len(COVERAGES)), dtype=np.int64) for _ in range(2))
    for trial in trials:
        if trial.right:
            good = trial.misfit[trial.fits, None] <= TOLERANCES, trial.coverage[trial.fits, None] >= COVERAGES
            accepted = (good[0][:, :, None] & good[1][:, None]).any(axis=0)
            (own if trial.own else others)[accepted] += 1
    return Counts(own, sum(trial.own for trial in trials), others)


def choose_thresholds(counts: Sequence[Counts]) -> tuple[float, float]:
    """Choose tolerance and coverage: of the pairs that accept 99 % of own redrawings, the one that refuses most else.

    If none does, the pair that accepts most own redrawings. Of equals the one that is easiest on redrawings.
    """
    own = np.mean([c.own / max(1, c.redrawings) for c in counts], axis=0)  # every person counts the same
    others = np.sum([c.others for c in counts], axis=0)

    def rank(pair: tuple[int, int]) -> tuple[float, ...]:
        return min(own[pair], WANTED_SHARE), -others[pair], pair[0], -pair[1]

    tolerance, covered = max(np.ndindex(len(TOLERANCES), len(COVERAGES)), key=rank)
    return float(TOLERANCES[tolerance]), float(COVERAGES[covered])


def leave_groups_out(trials: Sequence[Trial]) -> dict[str, tuple[float, float]]:
    """Choose thresholds for each group on all other groups."""
    counts = {group: count_accepted([t for t in trials if t.group == group]) for group in {t.group for t in trials}}
    if len(counts) < 2:
        raise InvalidInputError("judge", "at least 2 people or groups of them", str(len(counts)))
    return {group: choose_thresholds([c for other, c in counts.items() if other != group]) for group in counts}


def tabulate_acceptance(
    people: str, trials: Sequence[Trial], chosen: Mapping[str, tuple[float, float]]
) -> list[Acceptance]:
    """Count what is accepted, a row for each kind.

    Args:
        people: What they are called in the table.
        trials: Their trials.
        chosen: For each group the thresholds that were chosen on others.
    """
    rows = []
    for kind in dict.fromkeys(t.kind for t in trials):
        mine = [t for t in trials if t.kind == kind]
        left_out = Share.of(t.accepted(*chosen[t.group]) for t in mine)
        rows.append(Acceptance(people, kind, Share.of(t.accepted() for t in mine), left_out))
    return rows


def acceptance_table(rows: Sequence[Acceptance]) -> str:
    """Return the rows as Markdown: accepted with the package's thresholds, and with those chosen on other people."""
    cells = []
    for people, kind, share, left_out in rows:
        low, high = share.interval
        shares = f"{share.count / share.total:.1%}", f"{low:.1%} to {high:.1%}", f"{left_out.count / share.total:.1%}"
        cells.append((people, kind, share.total, *shares))
    return markdown_table(("people", "what the hand draws", "n", "accepted", "95 % interval", "left out"), cells)
