"""Signs compared with each other, not with prototypes: every sign that was seen helps to read the next one.

Half of a sign's slant is taken out. It is then a set of samples, each with a place and the direction of the pen; where
in the sign it comes does not matter. A sample's gap is that to the sample of the other sign that is nearest in both at
once, and the distance of two signs is their mean gap. A gap never counts for more than a limit: a base line under a "1"
does not outweigh the stem that all "1" share.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import expit, logsumexp, softmax

from signimit.acceleration import find_twin
from signimit.learners.base import Reading, Understanding
from signimit.paths import resample_path
from signimit.validation import moving_points

_SAMPLES = 32
_DIRECTION = 1.2  # weight of a unit direction, against the sign's root mean square radius
_LARGEST_GAP = 1.2  # in the same unit
_MOST_SHEAR = 0.5
_FLATNESS = 0.05  # share of the width that counts as height: the slant of a flat sign is nothing
_SHARPNESS = 10.0  # a meaning weighs as the mean of distance ** -10 over its signs: near ones count, far ones hardly
_TEMPERATURE = 0.8  # of the scores of meanings
_UNKNOWN = 0.45  # nearest distance at which a sign of one person is as likely none that was taught as one
_WIDER, _WIDEST = 1.5, 0.9  # the same, in the 0.9 quantile of nearest distances among seen signs of one meaning
_KNOWN_SLOPE = 20.0  # by which the log-odds of a sign being known fall with the logarithm of its distance
_PAIRS = 2**9  # pairs that are compared at once
_SECONDS = 3e-6  # that numpy takes for a sign beside another


def sign_features(signs: Sequence[ArrayLike]) -> NDArray[np.float64]:
    """Describe N signs, each of shape (T_s, 2), any unit, free of their position and size.

    Returns:
        Place, in root mean square radii, and weighted direction of 32 samples of each sign, shape (N, 32, 4).
    """
    return np.stack([_describe(moving_points(s, f"sign {i}")) for i, s in enumerate(signs)])


def _describe(points: NDArray[np.float64]) -> NDArray[np.float64]:
    path = resample_path(_less_slanted(resample_path(points / np.abs(points).max(), 2 * _SAMPLES)), _SAMPLES)
    path = path - path.mean(axis=0)
    path /= np.sqrt((path * path).sum(axis=1).mean())
    along = np.gradient(path, axis=0)
    angle = np.arctan2(along[:, 1], along[:, 0])
    return np.column_stack([path, _DIRECTION * np.cos(angle), _DIRECTION * np.sin(angle)])


def _less_slanted(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Shear a path, shape (T, 2), until half of its slant is left: hands differ in it, but "/" is not "|"."""
    x, y = (path - path.mean(axis=0)).T
    slant = (x * y).mean() / ((y * y).mean() + _FLATNESS * (x * x).mean())
    return path - np.outer(path[:, 1], [np.clip(slant / 2, -_MOST_SHEAR, _MOST_SHEAR), 0.0])


def sign_distances(features: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the distance of all pairs of N signs, shape (N, 32, 4); returns shape (N, N), within 0 and 1.2."""
    count = len(features)
    twin = find_twin("signimit.learners.joint.sign_distance_numba", _SECONDS * count**2)
    if twin is not None:
        return np.asarray(twin.sign_distances(features.astype(np.float32), _LARGEST_GAP))
    table = np.zeros((count, count))
    rows = max(1, _PAIRS // count)
    for start in range(0, count, rows):
        table[start : start + rows, start:] = cross_sign_distances(features[start : start + rows], features[start:])
    table = np.triu(table, 1)
    return table + table.T


def cross_sign_distances(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the distance of each of A signs, shape (A, 32, 4), to each of B others; returns shape (A, B)."""
    out = np.empty((len(first), len(second)))
    columns = max(1, _PAIRS // len(out))
    for start in range(0, out.shape[1], columns):
        squares = np.minimum(_squares(first, second[start : start + columns]), _LARGEST_GAP**2)
        there, back = (np.sqrt(squares.min(axis=axis)).mean(axis=0) for axis in (1, 0))
        out[:, start : start + columns] = ((there + back) / 2).reshape(len(out), -1)
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
        features: Seen signs for each place of the utterance, each of shape (N, 32, 4).
        understanding: What they meant.
        objects: Number of objects.
    """

    features: tuple[NDArray[np.float64], ...]
    understanding: Understanding
    objects: int

    def read(self, signs: Sequence[ArrayLike]) -> Reading:
        """Read an utterance."""
        order, asked = self.understanding.word_order, self.understanding.requests
        movements = int(self.understanding.labels.max()) + 1
        movement, movement_known = self._weigh(signs[order.movement], order.movement, asked.movement, movements)
        focus, focus_known = self._weigh(signs[order.focus], order.focus, asked.focus, self.objects)
        return Reading(movement, focus, movement_known * focus_known)

    def _weigh(
        self, sign: ArrayLike, word: int, meanings: NDArray[np.int64], count: int
    ) -> tuple[NDArray[np.float64], float]:
        """Return the probability of each meaning, shape (count,), and that of the sign having any of them."""
        distances = cross_sign_distances(sign_features([sign]), self.features[word])[0] + 1e-6
        nearness = -_SHARPNESS * np.log(distances)
        scores = np.full(count, -np.inf)
        for meaning in np.unique(meanings):
            members = nearness[meanings == meaning]
            scores[meaning] = logsumexp(members) - np.log(len(members))
        farthest = max(self._farthest_known(word, meanings), 1e-6)
        known = expit(_KNOWN_SLOPE * np.log(farthest / distances.min()))
        return np.asarray(softmax(scores / _TEMPERATURE)), float(known)

    def _farthest_known(self, word: int, meanings: NDArray[np.int64]) -> float:
        """Distance to the nearest seen sign at which a sign is as likely none that was taught as one.

        It is farther where signs of one meaning differ more, as those of several people do.
        """
        measured = self.understanding.diagnostics.get("sign_distances")
        distances = sign_distances(self.features[word]) if measured is None else measured[word]
        equal = (meanings[:, None] == meanings) & ~np.eye(len(meanings), dtype=bool)
        nearest = np.where(equal, distances, np.inf).min(axis=1)
        nearest = nearest[np.isfinite(nearest)]
        if not len(nearest):
            return _UNKNOWN
        return float(np.sqrt(_UNKNOWN * _WIDER * np.quantile(nearest, _WIDEST)))
