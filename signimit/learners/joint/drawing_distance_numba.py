"""The distances of `signimit.learners.joint.drawing_distance`, compiled by numba; imported when they are worthwhile."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.acceleration import compiled, share_rows

_FAR = np.float32(1e30)  # of any squared distance


def drawing_distances(shapes: NDArray[np.float32], offsets: NDArray[np.float32]) -> NDArray[np.float64]:
    """Compute the distances of `signimit.learners.joint.drawing_distance.compare_drawings`.

    Args:
        shapes: N drawings from their own centres, shape (N, S, 5): place in half sizes, then manner; S a multiple of 8.
        offsets: Those centres from each object, shape (N, O, 2), half sizes.

    Returns:
        Both ways averaged, shape (N, N, O, O), no unit.
    """
    count, frames = offsets.shape[:2]
    out = np.empty((count, count, frames, frames))
    share_rows(_drawing_rows, count, np.ascontiguousarray(shapes.transpose(0, 2, 1)), offsets, out)
    return out


def _drawing_row_block(
    first: int, step: int, shapes: NDArray[np.float32], offsets: NDArray[np.float32], out: NDArray[np.float64]
) -> None:
    """Fill rows first, first + step, ... from the diagonal on, and the columns that mirror them.

    A pair of frames only shifts one drawing against the other, by e: |a - b + e|² = |a - b|² + 2 e·a - 2 e·b + |e|².
    The first term serves all frames; for the best b of each a, one number for each b is added to it.
    """
    count, frames, samples = len(shapes), offsets.shape[1], shapes.shape[2]
    there, back = np.empty((samples, samples), np.float32), np.empty((samples, samples), np.float32)
    of_a, of_b, best = np.empty(samples, np.float32), np.empty(samples, np.float32), np.empty(samples, np.float32)
    for t in range(first, count, step):
        for k in range(t, count):
            _square_gaps(shapes[t], shapes[k], there)
            _square_gaps(shapes[k], shapes[t], back)
            for i in range(frames):
                for j in range(frames):
                    x, y = offsets[t, i, 0] - offsets[k, j, 0], offsets[t, i, 1] - offsets[k, j, 1]
                    for u in range(samples):
                        of_a[u] = np.float32(2.0) * (x * shapes[t, 0, u] + y * shapes[t, 1, u])
                        of_b[u] = np.float32(-2.0) * (x * shapes[k, 0, u] + y * shapes[k, 1, u])
                    square = x * x + y * y
                    total = _sum_of_best(there, of_b, of_a, square, best) + _sum_of_best(back, of_a, of_b, square, best)
                    out[t, k, i, j] = out[k, t, j, i] = total / (2 * samples)


def _square_gaps(a: NDArray[np.float32], b: NDArray[np.float32], out: NDArray[np.float32]) -> None:
    """Squared distance of each sample of b, along the rows, to each of a; both of shape (5, S)."""
    for v in range(b.shape[1]):
        b0, b1, b2, b3, b4 = b[0, v], b[1, v], b[2, v], b[3, v], b[4, v]
        for u in range(a.shape[1]):
            g0, g1, g2, g3, g4 = a[0, u] - b0, a[1, u] - b1, a[2, u] - b2, a[3, u] - b3, a[4, u] - b4
            out[v, u] = (g0 * g0 + g1 * g1) + (g2 * g2 + (g3 * g3 + g4 * g4))


def _sum_of_best(
    gaps: NDArray[np.float32],
    there: NDArray[np.float32],
    here: NDArray[np.float32],
    square: np.float32,
    best: NDArray[np.float32],
) -> np.float32:
    """Add up, over the columns, the roots of the least gap + there + here + square; eight rows a pass."""
    best[:] = _FAR
    for v in range(0, len(there), 8):
        t0, t1, t2, t3 = there[v], there[v + 1], there[v + 2], there[v + 3]
        t4, t5, t6, t7 = there[v + 4], there[v + 5], there[v + 6], there[v + 7]
        for u in range(len(here)):
            low = min(min(gaps[v, u] + t0, gaps[v + 1, u] + t1), min(gaps[v + 2, u] + t2, gaps[v + 3, u] + t3))
            high = min(min(gaps[v + 4, u] + t4, gaps[v + 5, u] + t5), min(gaps[v + 6, u] + t6, gaps[v + 7, u] + t7))
            best[u] = min(best[u], min(low, high))
    total = np.float32(0.0)
    for u in range(len(here)):
        total += np.sqrt(max(best[u] + here[u] + square, np.float32(0.0)))
    return total


_square_gaps = compiled(_square_gaps)
_sum_of_best = compiled(_sum_of_best)
_drawing_rows = compiled(_drawing_row_block)
