"""Synthetic people: each has a style of drawing, and draws nothing twice the same way."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from signimit.display import one_line
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.paths import headings, wrap_angles
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.people.glyphs import GLYPHS, SIGNS, Glyph
from signimit.teaching.people.kinematics import MotorPlan, total_duration, trajectory

SAMPLE_TIME = 0.01  # s
SIGN_HALF_SIZE = 0.02  # m, a digit written
MOVEMENT_HALF_SIZE = 0.1  # m, a movement about an object
ISOCHRONY = 0.5  # duration of a stroke grows with this power of its length
CORNER = np.radians(50.0)  # a junction that turns by more is drawn as a corner


@one_line
@dataclass(frozen=True, kw_only=True)
class Style:
    """Drawing style of a person. Lengths are in half sizes of the drawing.

    Attributes:
        size: Size of drawings, 1 is average.
        aspect: Width over height, 1 is average.
        slant: Horizontal shear of signs.
        tilt: Rotation of everything, rad.
        tempo: Duration of an aimed stroke of 2 cm, s.
        fluency: Overlap of strokes where the path goes on smoothly, in [0, 1).
        roundness: Overlap of strokes at corners, in [0, 1): 0 draws sharp ones.
        bow: Angle that strokes meant to be straight turn through, rad.
        asymmetry: Skewness of the speed of a stroke, in (0, 1).
        closing: Where a closed figure ends, from where it began, shape (2,).
        sloppiness: Deviation of virtual targets from one sample to the next.
        tremor: Amplitude of the 8-12 Hz tremor.
    """

    size: float
    aspect: float
    slant: float
    tilt: float
    tempo: float
    fluency: float
    roundness: float
    bow: float
    asymmetry: float
    closing: tuple[float, float]
    sloppiness: float
    tremor: float

    @classmethod
    def sample(cls, rng: np.random.Generator, spread: float = 1.0) -> Style:
        """Draw a style.

        Args:
            rng: Decides which.
            spread: How far people are from each other in what has no bounds, times the usual; `choosing.CLUMSY` is as
                far as players of Quick, Draw! are.
        """
        gap = rng.normal(0.0, 0.15 * spread, 2)
        return cls(
            size=float(np.exp(rng.normal(0.0, 0.12 * spread))),
            aspect=float(np.exp(rng.normal(0.0, 0.12 * spread))),
            slant=rng.normal(0.08, 0.12 * spread),
            tilt=rng.normal(0.0, 0.05 * spread),
            tempo=float(0.30 * np.exp(rng.normal(0.0, 0.15 * spread))),
            fluency=rng.uniform(0.5, 0.62),
            roundness=rng.uniform(0.2, 0.5),
            bow=rng.normal(0.0, 0.12 * spread),
            asymmetry=rng.uniform(0.02, 0.1),
            closing=(float(gap[0]), float(gap[1])),
            sloppiness=rng.uniform(0.02, 0.05),
            tremor=rng.uniform(0.0004, 0.0015),
        )


@one_line
@dataclass(frozen=True, eq=False)
class Person:
    """A synthetic person: a drawing style and habits.

    Attributes:
        style: The style.
        habits: For each label how this person's glyph differs from the usual one: how far its targets are from the
            usual ones, shape (K + 1, 2).
    """

    style: Style
    habits: Mapping[str, NDArray[np.float64]]

    @classmethod
    def sample(cls, rng: np.random.Generator, spread: float = 1.0) -> Person:
        """Draw a person, whose style and habits are so many times as far from other people's as usual."""
        style = Style.sample(rng, spread)
        habits = {label: rng.normal(0.0, 0.08 * spread, glyph.targets.shape) for label, glyph in GLYPHS.items()}
        for habit in habits.values():
            habit.setflags(write=False)
        return cls(style, habits)

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Draw a glyph once.

        Args:
            label: One of `SIGN_LABELS`, `MOVEMENT_LABELS` and `GOAL_LABELS`.
            rng: Where this sample's deviations come from.

        Returns:
            Points in m, y up, every 10 ms. Signs are some 4 cm high, movements some 20 cm.

        Raises:
            UnknownNameError: If there is no such glyph.
        """
        if label not in GLYPHS:
            raise UnknownNameError("glyph", label, GLYPHS)
        sign = label in SIGNS
        size = self.style.size * (SIGN_HALF_SIZE if sign else MOVEMENT_HALF_SIZE)
        plan = self._plan(GLYPHS[label], self.habits[label], size, rng)
        times = np.arange(0.0, total_duration(plan), SAMPLE_TIME)
        points = trajectory(plan, times) + self._tremor(times, rng)
        return Stroke(size * points @ self._shape(sign).T, times)

    def draw_several(self, label: str, rng: np.random.Generator, count: int) -> tuple[Stroke, ...]:
        """Draw a glyph so many times, as `draw` does."""
        return tuple(self.draw(label, rng) for _ in range(count))

    def _plan(self, glyph: Glyph, habit: NDArray[np.float64], size: float, rng: np.random.Generator) -> MotorPlan:
        """Aim at this sample's targets.

        A stroke n times as long lasts n^0.5 times as long: the isochrony principle (P. Viviani and G. McCollum,
        Neuroscience 10, 1983, doi:10.1016/0306-4522(83)90094-5).
        """
        style = self.style
        targets = glyph.targets + habit + rng.normal(0.0, style.sloppiness, habit.shape)
        if np.array_equal(glyph.targets[0], glyph.targets[-1]):
            targets[-1] = targets[0] + style.closing + rng.normal(0.0, style.sloppiness, 2)
        arcs = glyph.arcs + rng.normal(0.0, 0.12, len(glyph.arcs)) + np.where(glyph.arcs == 0, style.bow, 0.0)
        lengths = np.linalg.norm(np.diff(targets, axis=0), axis=1)
        durations = style.tempo * (lengths * size / SIGN_HALF_SIZE) ** ISOCHRONY
        durations *= np.exp(rng.normal(0.0, 0.08, len(lengths)))
        overlaps = np.where(corners(targets, arcs), style.roundness, style.fluency)
        return MotorPlan(targets, arcs, durations, overlaps, style.asymmetry)

    def _shape(self, sign: bool) -> NDArray[np.float64]:
        """Return the matrix that gives a drawing this person's aspect, slant and tilt, shape (2, 2)."""
        c, s = np.cos(self.style.tilt), np.sin(self.style.tilt)
        root = np.sqrt(self.style.aspect)
        shear = np.array([[root, self.style.slant if sign else 0.0], [0.0, 1.0 / root]])
        shape: NDArray[np.float64] = np.array([[c, -s], [s, c]]) @ shear
        return shape

    def _tremor(self, times: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
        """Return physiological tremor, a narrow band about 10 Hz, shape (T, 2)."""
        frequencies = rng.uniform(8.0, 12.0, (4, 2))
        phases = rng.uniform(0.0, 2.0 * np.pi, (4, 2))
        waves = np.sin(2.0 * np.pi * frequencies * times[:, None, None] + phases)
        return np.asarray(self.style.tremor * waves.sum(axis=1) / np.sqrt(2.0))


def corners(targets: NDArray[np.float64], arcs: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell at which strokes the path turns a corner as they begin, shape (K,); the first does not."""
    heading = headings(np.diff(targets, axis=0))
    turn = (heading[1:] - arcs[1:] / 2.0) - (heading[:-1] + arcs[:-1] / 2.0)
    return np.concatenate([[False], np.abs(wrap_angles(turn)) > CORNER])


def synthetic_library(
    labels: Iterable[str], *, writers: int = 1, samples: int = 20, rng: np.random.Generator
) -> StrokeLibrary:
    """Let synthetic people draw.

    Args:
        labels: What to draw: `SIGN_LABELS`, `MOVEMENT_LABELS`, `GOAL_LABELS` or some of them.
        writers: How many people, called ``"synthetic 1"`` and so on.
        samples: How often each person draws each label.
        rng: Who they are and how they draw; the same generator state gives the same library.

    Raises:
        InvalidInputError: If there are no writers or no samples.
        UnknownNameError: If a label is not known.
    """
    labels = tuple(labels)
    for name, count in (("writers", writers), ("samples", samples)):
        if count < 1:
            raise InvalidInputError(f"synthetic library: {name}", "at least 1", f"{count}")
    libraries = [drawings(Person.sample(rng), f"synthetic {n}", labels, samples, rng) for n in range(1, writers + 1)]
    return sum(libraries[1:], libraries[0])


def drawings(
    person: Person, writer: str, labels: Iterable[str], samples: int, rng: np.random.Generator
) -> StrokeLibrary:
    """Let one synthetic person draw.

    Args:
        person: Who draws.
        writer: What this person is called.
        labels: What to draw.
        samples: How often each.
        rng: Where the deviations come from.

    Raises:
        UnknownNameError: If a label is not known.
    """
    names = tuple(label for label in labels for _ in range(samples))
    strokes = tuple(person.draw(label, rng) for label in names)
    return StrokeLibrary(strokes, names, (writer,) * len(names), "synthetic")
