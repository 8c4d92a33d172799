"""Alignment of paths with drawings, in order, and the measures that follow from it; used by `signimit.evaluation`.

The constants were set on built-in people and on those of the $1 logs; `study judge` measures what they lead to.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_STRAIGHT = 1 - np.cos(np.deg2rad(30.0))  # until a hand turns by more, it may still be on its way to what goes round
_BEGINNING = 0.06  # of a drawing: where the hand comes from elsewhere, it need not pass so much
DIRECTION_WEIGHT = 2.0  # half sizes that a mean of 1 - cos of the angle between directions counts as
_NEAR = 0.4  # half sizes within which a sample passes its point of the drawing
_TURNING = 0.5  # half sizes that 1 - cos of an angle between directions costs in an alignment
_UNEVEN = 0.02  # half sizes that a sample costs at the same point as the one before, or a point that is skipped
_LEAVING_OUT = 0.2  # half sizes that leaving out an early sample costs
_MOST_STEPS = 3  # points that the next sample may be ahead


class DrawingAlignment:
    """Samples of C paths put in order to points of C drawings, in half sizes, by dynamic programming.

    The cost of a sample at a point is the gap plus half of 1 - cos of the angle between directions. The next sample is
    at the same point or up to three ahead; early samples may be left out.
    """

    def __init__(self, hands: Array, drawings: Array, directions: Array, drawn: Mask, rounds: Mask) -> None:
        """Align; arrays of shape (C, n, 2), (C, n, 2), (C, n, 2), (C, n), (C,)."""
        self._hands, self._drawings, self._drawn, self._rounds = hands, drawings, drawn, rounds
        count, samples = hands.shape[:2]
        tangents = np.gradient(hands, axis=1)
        tangents /= np.linalg.norm(tangents, axis=2, keepdims=True) + 1e-12
        self._tangents = tangents
        squares = (hands**2).sum(axis=2)[:, :, None] + (drawings**2).sum(axis=2)[:, None]
        gaps = np.sqrt(np.maximum(squares - 2 * hands @ drawings.transpose(0, 2, 1), 0.0))
        turns = 1 - tangents @ directions.transpose(0, 2, 1)
        costs = gaps + _TURNING * turns
        steps = self._best_steps(costs)
        each, points = np.arange(count), np.empty((count, samples), dtype=np.intp)
        points[:, -1] = self._last
        begun = np.zeros(count, dtype=np.intp)
        for i in range(samples - 1, 0, -1):
            step = steps[i, each, points[:, i] % samples]
            begun = np.where((step < 0) & (begun == 0), i, begun)
            points[:, i - 1] = points[:, i] - np.maximum(step, 0)
        self.begun = begun
        self._points, self._used = points, np.arange(samples) >= begun[:, None]
        self._weights = self._used / self._used.sum(axis=1, keepdims=True)
        at = each[:, None], np.arange(samples), points % samples
        self._gaps, self._turns = gaps[at], turns[at]
        back = np.where(self._used[:, :, None], gaps, np.inf).min(axis=1)
        self._gap_back = (back * drawn).sum(axis=1) / drawn.sum(axis=1)

    def _best_steps(self, costs: Array) -> NDArray[np.int8]:
        """Return how many points each sample at each point is ahead of the one before; -1 where it is the first."""
        count, samples, _ = costs.shape
        steps = np.zeros((samples, count, samples), dtype=np.int8)
        padded = np.empty((count, samples + _MOST_STEPS))  # the last points again before the first
        total, open_ends = costs[:, 0].copy(), ~self._rounds
        for i in range(1, samples):
            padded[:, _MOST_STEPS:] = total
            padded[:, :_MOST_STEPS] = total[:, -_MOST_STEPS:]
            padded[open_ends, :_MOST_STEPS] = np.inf
            best, taken = total + _UNEVEN, steps[i]
            for step in range(1, _MOST_STEPS + 1):
                other = padded[:, _MOST_STEPS - step : -step] + _UNEVEN * (step - 1)
                better = other < best
                np.copyto(best, other, where=better)
                taken[better] = step
            taken[best > _LEAVING_OUT * i] = -1
            total = np.minimum(best, _LEAVING_OUT * i) + costs[:, i]
        self._last = total.argmin(axis=1)
        return steps

    def misfit(self) -> Array:
        """Half of the mean gaps there and back, plus twice the mean of 1 - cos between directions, shape (C,)."""
        there = (self._gaps * self._weights).sum(axis=1)
        return np.asarray((there + self._gap_back) / 2 + DIRECTION_WEIGHT * (self._turns * self._weights).sum(axis=1))

    def size(self) -> Array:
        """Size of the path relative to the drawing: regression of samples on their points, shape (C,)."""
        matched = np.take_along_axis(self._drawings, (self._points % self._points.shape[1])[:, :, None], axis=1)
        weights = self._weights[:, :, None]
        hands = self._hands - (self._hands * weights).sum(axis=1, keepdims=True)
        matched = matched - (matched * weights).sum(axis=1, keepdims=True)
        return np.asarray(
            (hands * matched * weights).sum(axis=(1, 2)) / ((matched**2 * weights).sum(axis=(1, 2)) + 1e-12)
        )

    def coverage(self) -> Array:
        """Share of the drawn points between samples near them, without the way of joining a round, shape (C,)."""
        count, samples = self._points.shape
        turned = self._used & (
            1 - (self._tangents * self._tangents[np.arange(count), self.begun, None]).sum(2) > _STRAIGHT
        )
        joining = self._rounds[:, None] & ~np.logical_or.accumulate(turned, axis=1)
        near = self._used & (self._gaps < _NEAR) & ~joining
        passed = np.zeros((count, samples), dtype=np.bool_)
        between = near[:, 1:] & near[:, :-1]
        for back in range(_MOST_STEPS):
            points = self._points - back
            here = near if back == 0 else np.zeros_like(near)
            here[:, 1:] |= between & (points[:, 1:] > self._points[:, :-1])
            pair, sample = np.nonzero(here)
            passed[pair, points[pair, sample] % samples] = True
        counted = self._drawn & (self._rounds[:, None] | (np.arange(samples) >= _BEGINNING * samples))
        return np.asarray((passed & counted).sum(axis=1) / counted.sum(axis=1))
