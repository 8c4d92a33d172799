"""Signs compared with each other, not with prototypes: every sign that was seen helps to read the next one.

Two signs are compared twice: as courses, by dynamic time warping of place and direction, and as pictures, by the
nearest point of like slope whatever the order of drawing, for people who begin a sign at another end still draw the
same picture. The distance is the geometric mean of both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import logsumexp, softmax

from signimit.acceleration import kernels_for
from signimit.signs import resampled_path, warped_totals
from signimit.understanding import Reading, Understanding
from signimit.validation import moving_points

_SAMPLES = 32
_DIRECTION = 2.0  # weight of a unit direction in a course, against the sign's root mean square radius
_SLOPE = 0.7  # weight of the slope in a picture
_NARROWEST = 0.2  # share of its size below which a sign's width or height counts as this much
_SHARPNESS = 10.0  # a meaning weighs as the mean of distance ** -10 over its signs: near ones count, far ones hardly
_PAIRS = 2**9  # pairs that are compared at once
_SECONDS = 1e-5  # that numpy takes for a sign beside another


class SignFeatures(NamedTuple):
    """Signs, free of their position and size.

    Attributes:
        courses: Place and direction along each sign, shape (N, 32, 4).
        pictures: Place, with width and height brought nearer to each other, and slope, shape (N, 32, 4).
    """

    courses: NDArray[np.float64]
    pictures: NDArray[np.float64]

    def take(self, which: slice) -> Self:
        """Return the features of some of the signs."""
        return type(self)(self.courses[which], self.pictures[which])


def sign_features(signs: Sequence[ArrayLike]) -> SignFeatures:
    """Describe N signs, each of shape (T_s, 2), any unit."""
    described = [_describe(moving_points(s, f"sign {i}")) for i, s in enumerate(signs)]
    courses, pictures = zip(*described, strict=True)
    return SignFeatures(np.stack(courses), np.stack(pictures))


def _describe(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    path = resampled_path(points / np.abs(points).max(), _SAMPLES)
    path = path - path.mean(axis=0)
    path /= _radius(path)
    extents = np.sqrt(np.maximum(path.std(axis=0), _NARROWEST))
    squared = path / extents
    squared /= _radius(squared)
    slope = _angles(squared)
    course = np.column_stack([path, _DIRECTION * _unit(_angles(path))])
    return course, np.column_stack([squared, _SLOPE * _unit(2 * slope)])  # twice the angle: up and down are one slope


def _radius(path: NDArray[np.float64]) -> float:
    return float(np.sqrt((path * path).sum(axis=1).mean()))


def _angles(path: NDArray[np.float64]) -> NDArray[np.float64]:
    along = np.gradient(path, axis=0)
    return np.asarray(np.arctan2(along[:, 1], along[:, 0]))


def _unit(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.column_stack([np.cos(angles), np.sin(angles)])


def sign_distances(features: SignFeatures) -> NDArray[np.float64]:
    """Compute the distance of all pairs of signs, shape (N, N), no unit."""
    count = len(features.courses)
    kernels = kernels_for(_SECONDS * count**2)
    if kernels is not None:
        return np.asarray(kernels.sign_distances(*(part.astype(np.float32) for part in features)))
    table = np.zeros((count, count))
    rows = max(1, _PAIRS // count)
    for start in range(0, count, rows):
        some, rest = features.take(slice(start, start + rows)), features.take(slice(start, None))
        table[start : start + rows, start:] = cross_sign_distances(some, rest)
    table = np.triu(table, 1)
    return table + table.T


def cross_sign_distances(first: SignFeatures, second: SignFeatures) -> NDArray[np.float64]:
    """Compute the distance of each of A signs to each of B others, shape (A, B), no unit."""
    out = np.empty((len(first.courses), len(second.courses)))
    columns = max(1, _PAIRS // len(out))
    for start in range(0, out.shape[1], columns):
        part = second.take(slice(start, start + columns))
        course = warped_totals(np.sqrt(_squares(first.courses, part.courses))) / _SAMPLES
        gaps = _squares(first.pictures, part.pictures)
        there, back = (np.sqrt(gaps.min(axis=axis)).mean(axis=0) for axis in (1, 0))
        out[:, start : start + columns] = np.sqrt(course * (there + back) / 2).reshape(len(out), -1)
    return out


def _squares(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Squared distances between all samples of signs, (A, 32, 4) and (B, 32, 4), shape (32 of b, 32 of a, A B)."""
    one_a, one_b = np.ones((*a.shape[:2], 1)), np.ones((*b.shape[:2], 1))
    left = np.concatenate([-2 * a, one_a, (a * a).sum(-1, keepdims=True)], axis=2)
    right = np.concatenate([b, (b * b).sum(-1, keepdims=True), one_b], axis=2)
    squares = left[:, None] @ right.transpose(1, 2, 0)  # (A, 32, 32, B); small products: none is worth a thread
    return np.asarray(np.maximum(squares, 0.0).transpose(1, 2, 0, 3).reshape(_SAMPLES, _SAMPLES, -1))


@dataclass(frozen=True, eq=False)
class VocabularyReader:
    """Reads a sign by its distances to all signs of each meaning.

    Attributes:
        features: Seen signs for each place of the utterance.
        understanding: What they meant.
        objects: Number of objects.
    """

    features: tuple[SignFeatures, ...]
    understanding: Understanding
    objects: int

    def read(self, signs: Sequence[ArrayLike]) -> Reading:
        """Read an utterance."""
        labels, focus, order, _ = self.understanding
        movement = self._weigh(signs[order.movement], order.movement, labels, int(labels.max()) + 1)
        return Reading(movement, self._weigh(signs[order.focus], order.focus, focus, self.objects))

    def _weigh(self, sign: ArrayLike, word: int, meanings: NDArray[np.int64], count: int) -> NDArray[np.float64]:
        known = self.features[word]
        nearness = -_SHARPNESS * np.log(cross_sign_distances(sign_features([sign]), known)[0] + 1e-6)
        scores = np.full(count, -np.inf)
        for meaning in np.unique(meanings):
            members = nearness[meanings == meaning]
            scores[meaning] = logsumexp(members) - np.log(len(members))
        return np.asarray(softmax(scores))
