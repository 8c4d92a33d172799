"""The gaps of `signimit.learners.joint.drawing_dissimilarity`, compiled by numba; imported when they are worthwhile."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.acceleration import compiled, share_rows

Array = NDArray[np.float64]


def summarise_gaps(a: Array, b: Array) -> tuple[Array, Array]:
    """Compute `signimit.learners.joint.drawing_dissimilarity.summarise_gaps`: arguments and results as there."""
    mean, large = np.empty((2, len(a), len(b)))
    share_rows(_gap_rows, len(a), a, np.ascontiguousarray(b.transpose(0, 2, 1)), mean, large)
    return mean, large


def _gap_row_block(first: int, step: int, a: Array, b: Array, mean: Array, large: Array) -> None:
    """Fill rows first, first + step, ...; ``b`` has its samples last."""
    samples, width = a.shape[1], a.shape[2]
    gaps, back = np.empty(samples), np.empty(samples)
    for t in range(first, len(a), step):
        for k in range(len(b)):
            back[:] = np.inf
            total, there4, back4 = 0.0, 0.0, 0.0
            for i in range(samples):
                gaps[:] = 0.0
                for d in range(width):
                    x = a[t, i, d]
                    for j in range(samples):
                        gaps[j] += (b[k, d, j] - x) * (b[k, d, j] - x)
                least = np.inf
                for j in range(samples):
                    back[j] = min(back[j], gaps[j])
                    least = min(least, gaps[j])
                total += np.sqrt(least)
                there4 += least * least
            for j in range(samples):
                total += np.sqrt(back[j])
                back4 += back[j] * back[j]
            mean[t, k] = total / (2 * samples)
            large[t, k] = (max(there4, back4) / samples) ** 0.25


_gap_rows = compiled(_gap_row_block)
