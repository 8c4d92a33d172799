"""How far built-in people are from each other, beside real ones: two people's drawings of one thing, compared.

People of usual spread draw much more alike than strangers do. `signimit.teaching.people.choosing.CLUMSY` is the spread
at which built-in people's drawings are as unlike as those of players of Quick, Draw!.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from signimit.benchmark.scoring import WORST
from signimit.benchmark.studies.varied_demonstrations import rotation
from signimit.benchmark.tables import markdown_table
from signimit.evaluation import PathJudge
from signimit.exceptions import InvalidInputError
from signimit.learners.joint.drawing_dissimilarity import compare_drawings, describe_ink
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.people import Person
from signimit.teaching.people.relabelling import with_both_triangles
from signimit.teaching.scenes import drawn_path

Array = NDArray[np.float64]

SHAPES = ("circle", "triangle up", "square", "star")  # closed ones that both draw; zigzags have any number of turns
MEASURES = ("dissimilarity", "misfit")
REAL = "real people"
QUANTILES = (10, 50, 90)  # per cent, that are tabulated
_HALF_SIZE = 0.1  # m; neither measure depends on it
_LEAST = 3  # people who draw a thing
_LEFT_RIGHT = np.array([-1.0, 1.0])


class Strangers(NamedTuple):
    """People of whom each draws each thing once, and how unlike two of them draw it.

    Attributes:
        people: Who they are.
        drawings: By thing, each (T, 2), m, all drawn counter-clockwise by mirroring.
        dissimilarity: Of each pair's drawings, by thing, shape (P,), nats: `compare_drawings`.
        misfit: Of each one's drawing to each other one's, by thing, shape (2 P,), half sizes, `WORST` at most: the
            judge's.
    """

    people: str
    drawings: Mapping[str, tuple[Array, ...]]
    dissimilarity: Mapping[str, Array]
    misfit: Mapping[str, Array]

    def measured(self, measure: str) -> Mapping[str, Array]:
        """Return what was measured, by thing; one of `MEASURES`."""
        return {"dissimilarity": self.dissimilarity, "misfit": self.misfit}[measure]


def compare_strangers(people: str, strokes: Mapping[str, Sequence[Stroke]]) -> Strangers:
    """Compare what people drew, a stroke of each person by thing.

    Raises:
        InvalidInputError: If fewer than three people drew a thing.
    """
    drawings, dissimilarity, misfit = {}, {}, {}
    for label, mine in strokes.items():
        if len(mine) < _LEAST:
            raise InvalidInputError(f"drawings of {people}", f"{label} by at least {_LEAST} people", f"{len(mine)}")
        paths = tuple(_counter_clockwise(drawn_path(stroke, _HALF_SIZE)) for stroke in mine)
        drawings[label] = paths
        unlike = compare_drawings([describe_ink(path) for path in paths])
        dissimilarity[label] = unlike[np.triu_indices(len(paths), 1)]
        misfit[label] = _misfits(paths)[~np.eye(len(paths), dtype=bool)]
    return Strangers(people, drawings, dissimilarity, misfit)


def _counter_clockwise(path: Array) -> Array:
    return path if rotation(path) > 0 else path * _LEFT_RIGHT


def _misfits(paths: Sequence[Array]) -> Array:
    """Judge every drawing by every other one, shape (n, n), half sizes."""
    judge = PathJudge([[path] for path in paths], [False] * len(paths))
    misfits = np.full((len(paths), len(paths)), WORST)
    for drawn, path in enumerate(paths):
        found = judge.compare(path, np.zeros((1, 2)))
        np.minimum.at(misfits[drawn], judge.movement[found.template], found.misfit)
    return misfits


def real_strangers(library: StrokeLibrary, shapes: Sequence[str] = SHAPES) -> Strangers:
    """Compare the people of a library: the first drawing by each of each thing.

    Raises:
        InvalidInputError: If fewer than three people drew one of the things.
    """
    library = with_both_triangles(library)
    first: dict[str, dict[str, Stroke]] = {label: {} for label in shapes}
    for stroke, label, writer in zip(library, library.labels, library.writers, strict=True):
        if label in first:
            first[label].setdefault(writer, stroke)
    return compare_strangers(REAL, {label: tuple(by.values()) for label, by in first.items()})


def built_in_strangers(spread: float, count: int, seed: int, shapes: Sequence[str] = SHAPES) -> Strangers:
    """Compare so many built-in people, who are ``spread`` times as far from each other as usual."""
    rng = np.random.default_rng(seed)
    people = [Person.sample(rng, spread) for _ in range(count)]
    drawn = {label: [person.draw(label, rng) for person in people] for label in shapes}
    return compare_strangers(f"built-in people, spread {spread:g}", drawn)


def distance_to(real: Strangers, other: Strangers) -> dict[str, float]:
    """Compute how far two distributions are apart, by measure: Kolmogorov's distance, its mean over the things."""
    return {
        measure: float(
            np.mean(
                [
                    stats.ks_2samp(values, other.measured(measure)[label]).statistic
                    for label, values in real.measured(measure).items()
                ]
            )
        )
        for measure in MEASURES
    }


def nearest_spread(real: Strangers, built_in: Mapping[float, Strangers]) -> float:
    """Return the spread at which built-in people are nearest to real ones, by the sum of both distances."""
    return min(built_in, key=lambda spread: sum(distance_to(real, built_in[spread]).values()))


def clumsiness_table(real: Strangers, built_in: Sequence[Strangers]) -> str:
    """Return quantiles over pairs of people, things counting the same, and the distance to real people, in Markdown."""
    lines = []
    for one in (real, *built_in):
        far = distance_to(real, one)
        cells: list[object] = [one.people]
        for measure in MEASURES:
            of_things = np.percentile([*_equally_many(one.measured(measure))], QUANTILES)
            cells += [" / ".join(f"{value:.2f}" for value in of_things), "" if one is real else f"{far[measure]:.2f}"]
        lines.append(cells)
    quantiles = " / ".join(map(str, QUANTILES))
    return markdown_table(
        ("", f"dissimilarity, nats: {quantiles} %", "distance", f"misfit, half sizes: {quantiles} %", "distance"), lines
    )


def _equally_many(values: Mapping[str, Array], count: int = 1000) -> Array:
    """Return so many quantiles of each thing's values, so that all things count the same, shape (things * count,)."""
    shares = (np.arange(count) + 0.5) / count
    return np.concatenate([np.quantile(of_thing, shares) for of_thing in values.values()])
