"""How unlike two drawings are, whoever drew them: log-odds of features that people who draw one thing share.

Strangers draw one thing in other proportions, from another beginning, and in other manners; one person repeats
themselves closely. Features are what drawings of one thing have in common: where ink lies and which way it goes, how it
turns, how it is spread about its middle. Their weights were learned by logistic regression on pairs of real people's
drawings, one person's and strangers' (`study drawing-weights`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.acceleration import find_twin
from signimit.paths import box_centre, half_size, headings, resample_path, step_lengths, unit_tangents, wrap_angles
from signimit.segmentation import find_drawing

Array = NDArray[np.float64]

SAMPLES = 48
_FINE = 160  # samples in which a second round is looked for
_ROUND = (0.3, 0.72)  # shares of a drawing's length between which its first round ends
_SAME = 0.35  # mean gap, half sizes, between two rounds of one drawing
_FLAT = 0.25  # least height of a box, in widths, when a drawing is stretched to a square
_DIRECTIONS = 16  # of the histogram of directions
_SHARPNESS = 4.0  # of one direction in it: concentration of a von Mises density
_CORNER = np.deg2rad(50.0)  # turned within 0.25 half sizes
_CORNER_LENGTH = 0.25  # half sizes
_HARMONICS = (1, 2, 3, 4, 5, 6, -1, -2, -3, -4, -5, -6)
_FLOOR = 0.02  # added before logarithms: nearer is no nearer
_SECONDS = 1e-4  # that numpy takes for a pair

MATCHED = ("gap", "largest gap", "largest gap in a square")
SPREAD = ("directions", "outline")
SCALARS = ("turning", "corners", "turning spread", "aspect", "radius spread", "least radius", "opening", "length")
FEATURES = (*MATCHED, *SPREAD, *SCALARS)


class DrawingWeights(NamedTuple):
    """What features say about two drawings being two things.

    Attributes:
        weights: Of `FEATURES`, shape (13,), nats for each unit.
        offset: Added to their weighted sum, nats.
    """

    weights: Array
    offset: float


DRAWINGS = DrawingWeights(
    np.array([1.139, 1.188, 1.64, -1.144, 2.047, 0.592, 0.196, 2.12, 0.065, 2.659, 3.232, 1.268, -0.783]), 1.086
)


class Drawing(NamedTuple):
    """What is compared of a drawing.

    Attributes:
        points: Evenly along it, in half sizes from its middle, shape (48, 2).
        directions: Unit directions there, shape (48, 2).
        square: The points when its box is stretched to a square, shape (48, 2).
        histogram: Share of its length in each of 16 directions, shape (16,).
        outline: Magnitudes of the harmonics of one round, shape (12,), half sizes.
        scalars: The other features, shape (8,).
        centre: Middle of its bounding box, shape (2,), m, table frame.
        half_size: Half of its larger extent, m.
    """

    points: Array
    directions: Array
    square: Array
    histogram: Array
    outline: Array
    scalars: Array
    centre: Array
    half_size: float


def describe_drawing(path: Array, times: Array) -> Drawing:
    """Describe the drawing in a demonstrated path, shape (T, 2), m, with its times, shape (T,), s."""
    return describe_ink(path[find_drawing(path, times)])


def describe_ink(ink: Array) -> Drawing:
    """Describe a drawing without a reach or a way home, shape (T, 2), m, table frame."""
    centre, unit = box_centre(ink), half_size(ink)
    ink = (ink - centre) / unit
    extents = np.maximum(np.ptp(ink, axis=0) / 2, _FLAT)
    points = resample_path(ink, SAMPLES)
    directions = unit_tangents(points)
    heading = headings(directions)
    bins = np.linspace(-np.pi, np.pi, _DIRECTIONS, endpoint=False)
    histogram = np.exp(_SHARPNESS * (np.cos(heading[:, None] - bins) - 1)).sum(axis=0)
    first = _first_round(resample_path(ink, _FINE))
    closed = resample_path(np.concatenate([first, first[:1]]), 64 + 1)[:-1] @ np.array([1.0, 1.0j])
    outline = np.abs(np.fft.fft(closed))[list(_HARMONICS)] / len(closed)
    radii = np.linalg.norm(points, axis=1)
    aspect = np.log(extents[0] / extents[1])
    scalars = np.array([*_turning(first), aspect, radii.std(), radii.min(), *_opening(first)])
    return Drawing(points, directions, points / extents, histogram / histogram.sum(), outline, scalars, centre, unit)


def _first_round(points: Array) -> Array:
    """Return the first round of a drawing that repeats itself, all of any other; points evenly spaced, shape (n, 2)."""
    count = len(points)
    lags = range(int(_ROUND[0] * count), int(_ROUND[1] * count))
    gaps = [np.linalg.norm(points[lag:] - points[: count - lag], axis=1).mean() for lag in lags]
    best = int(np.argmin(gaps))
    return points[: lags[best]] if gaps[best] < _SAME else points


def _turning(points: Array) -> tuple[float, float, float]:
    """Return turning for each half size of length, corners for each three, and the spread of turning, rad."""
    even = resample_path(points, 2 * SAMPLES)
    length = float(step_lengths(even).sum())
    turned = np.concatenate([[0.0], np.cumsum(wrap_angles(np.diff(headings(unit_tangents(even)))))])
    window = min(max(1, round(_CORNER_LENGTH * (2 * SAMPLES - 1) / length)), len(turned) - 1)
    turns = turned[window:] - turned[:-window]
    sharp = np.abs(turns) > _CORNER
    corners = int(sharp[0]) + int((np.diff(sharp.astype(int)) == 1).sum())
    return float(turned[-1]) / length, 3 * corners / length, float(turns.std())


def _opening(points: Array) -> tuple[float, float]:
    """Return the gap between a round's ends, at most 1.5, and the logarithm of its length; in half sizes."""
    return min(float(np.linalg.norm(points[-1] - points[0])), 1.5), float(np.log(step_lengths(points).sum()))


def compare_drawings(
    drawings: Sequence[Drawing], others: Sequence[Drawing] | None = None, model: DrawingWeights = DRAWINGS
) -> Array:
    """Compute how unlike drawings are: log-odds of being two things, given as many pairs of one as of two.

    Args:
        drawings: A of them.
        others: B of them; left out, the same.
        model: What the features say.

    Returns:
        Shape (A, B); symmetric where both are the same.
    """
    return np.asarray(pair_features(drawings, others) @ model.weights + model.offset)


def pair_features(drawings: Sequence[Drawing], others: Sequence[Drawing] | None = None) -> Array:
    """Compute the features of all pairs, shape (A, B, 13), in the order of `FEATURES`; greater is more unlike."""
    second = drawings if others is None else others
    a, b = _stack(drawings), _stack(second)
    columns = [np.log(gaps + _FLOOR) for gaps in _nearest_gaps(a, b)]
    for one, other in ((a.histogram, b.histogram), (a.outline, b.outline)):
        columns.append(np.log(np.abs(one[:, None] - other).sum(axis=2) + _FLOOR))
    columns.extend(np.moveaxis(np.abs(a.scalars[:, None] - b.scalars), 2, 0))
    return np.stack(columns, axis=2)


class _Stack(NamedTuple):
    """Fields of many drawings, each with the drawings first."""

    plain: Array
    square: Array
    histogram: Array
    outline: Array
    scalars: Array


def _stack(drawings: Sequence[Drawing]) -> _Stack:
    plain = [np.concatenate([d.points, d.directions], axis=1) for d in drawings]
    rest = zip(*((d.square, d.histogram, d.outline, d.scalars) for d in drawings), strict=True)
    return _Stack(np.stack(plain), *(np.stack(values) for values in rest))


def _nearest_gaps(a: _Stack, b: _Stack) -> tuple[Array, Array, Array]:
    """Return the features of `MATCHED`, each of shape (A, B): how far it is to what is nearest in the other drawing."""
    seconds = _SECONDS * len(a.plain) * len(b.plain)
    twin = find_twin("signimit.learners.joint.drawing_dissimilarity_numba", seconds)
    summarise = summarise_gaps if twin is None else twin.summarise_gaps
    mean, large = summarise(a.plain, b.plain)
    return mean, large, summarise(a.square, b.square)[1]


def summarise_gaps(a: Array, b: Array) -> tuple[Array, Array]:
    """Compute the mean, and the fourth root of the mean fourth power, of gaps from samples to the nearest of others.

    Args:
        a: Samples of A drawings, shape (A, n, d).
        b: Samples of B drawings, shape (B, n, d).

    Returns:
        Means, both ways averaged, and the larger of both ways' roots, which tells large gaps; each of shape (A, B).
    """
    mean, large = np.empty((2, len(a), len(b)))
    squares_b = (b * b).sum(axis=2)
    for row, one in enumerate(a):
        squares = (one * one).sum(axis=1)[:, None] - 2 * one @ b.transpose(0, 2, 1) + squares_b[:, None]  # (B, n, n)
        ways = [np.maximum(squares.min(axis=axis), 0.0) for axis in (1, 2)]
        mean[row] = (np.sqrt(ways[0]).mean(axis=1) + np.sqrt(ways[1]).mean(axis=1)) / 2
        large[row] = np.maximum(*((way * way).mean(axis=1) ** 0.25 for way in ways))
    return mean, large
