"""Signs compared with each other, not with prototypes: every sign that was seen helps to read the next one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import logsumexp, softmax

from signimit.signs import resampled_path, warped_totals
from signimit.understanding import Reading, Understanding
from signimit.validation import moving_points

_SAMPLES = 32
_DIRECTION = 2.0  # weight of a unit direction against the sign's root mean square radius
_SHARPNESS = 6.0  # a meaning weighs as the mean of distance ** -6 over its signs: near ones count, far ones hardly
_PAIRS = 2**10  # pairs that are warped at once


def sign_features(signs: Sequence[ArrayLike]) -> NDArray[np.float64]:
    """Describe signs by place and direction, free of their position and size, shape (N, 32, 4)."""
    return np.stack([_features(moving_points(s, f"sign {i}")) for i, s in enumerate(signs)])


def _features(points: NDArray[np.float64]) -> NDArray[np.float64]:
    path = resampled_path(points / np.abs(points).max(), _SAMPLES)
    path = path - path.mean(axis=0)
    path /= np.sqrt((path * path).sum(axis=1).mean())
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-12
    return np.column_stack([path, _DIRECTION * along])


def sign_distances(features: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the warped distance of all pairs of signs, shape (N, N), no unit."""
    first, second = np.triu_indices(len(features), 1)
    out = np.zeros((len(features),) * 2)
    out[first, second] = _warped(features[first], features[second])
    return out + out.T


def _warped(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the warped distances of pairs of signs, each of shape (B, 32, 4)."""
    out = np.empty(len(first))
    for start in range(0, len(first), _PAIRS):
        a, b = first[start : start + _PAIRS], second[start : start + _PAIRS]
        squares = (a * a).sum(-1)[:, :, None] - 2 * a @ b.transpose(0, 2, 1) + (b * b).sum(-1)[:, None, :]
        cost = np.sqrt(np.maximum(squares, 0.0)).transpose(1, 2, 0).copy()
        out[start : start + _PAIRS] = warped_totals(cost) / _SAMPLES
    return out


@dataclass(frozen=True, eq=False)
class VocabularyReader:
    """Reads a sign by its distances to all signs of each meaning.

    Attributes:
        features: Seen signs for each place of the utterance, W of shape (N, 32, 4).
        understanding: What they meant.
        objects: Number of objects.
    """

    features: tuple[NDArray[np.float64], ...]
    understanding: Understanding
    objects: int

    def read(self, signs: Sequence[ArrayLike]) -> Reading:
        """Read an utterance."""
        labels, focus, order, _ = self.understanding
        heard = sign_features([signs[order.movement], signs[order.focus]])
        movement = self._weigh(heard[0], order.movement, labels, int(labels.max()) + 1)
        return Reading(movement, self._weigh(heard[1], order.focus, focus, self.objects))

    def _weigh(
        self, heard: NDArray[np.float64], word: int, meanings: NDArray[np.int64], count: int
    ) -> NDArray[np.float64]:
        known = self.features[word]
        nearness = -_SHARPNESS * np.log(_warped(np.broadcast_to(heard, known.shape), known) + 1e-6)
        scores = np.full(count, -np.inf)
        for meaning in np.unique(meanings):
            members = nearness[meanings == meaning]
            scores[meaning] = logsumexp(members) - np.log(len(members))
        return np.asarray(softmax(scores))
