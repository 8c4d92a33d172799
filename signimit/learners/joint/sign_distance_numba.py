"""The distances of `signimit.learners.joint.sign_distance`, compiled by numba; imported when they are worthwhile."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.acceleration import compiled, share_rows

_LANES = 16  # signs that are compared with one at once


def sign_distances(features: NDArray[np.float32], largest_gap: float) -> NDArray[np.float64]:
    """Compute the distances of `signimit.learners.joint.sign_distance.sign_distances`.

    Args:
        features: Place and direction along N signs, shape (N, S, 4).
        largest_gap: A sample counts as at most so far from the other sign.

    Returns:
        Shape (N, N), no unit.
    """
    out = np.zeros((len(features), len(features)))
    limit = np.float32(largest_gap)
    share_rows(_sign_rows, len(features), features, _blocked(features), limit, out)
    return out


def _blocked(features: NDArray[np.float32]) -> NDArray[np.float32]:
    """Put `_LANES` signs side by side: shape (N / _LANES rounded up, 4, S * _LANES), the last block filled with 0."""
    count, samples, width = features.shape
    blocks = -(-count // _LANES)
    padded = np.zeros((blocks * _LANES, samples, width), np.float32)
    padded[:count] = features
    return np.ascontiguousarray(padded.reshape(blocks, _LANES, samples, width).transpose(0, 3, 2, 1)).reshape(
        blocks, width, samples * _LANES
    )


def _sign_row_block(
    first: int,
    step: int,
    features: NDArray[np.float32],
    blocks: NDArray[np.float32],
    limit: np.float32,
    out: NDArray[np.float64],
) -> None:
    """Fill rows first, first + step, ... up to the diagonal, and the columns that mirror them."""
    sums = np.empty(_LANES, np.float32)
    for t in range(first, len(out), step):
        for block in range(-(-t // _LANES)):
            _match(features[t], blocks[block], limit, sums)
            start = block * _LANES
            for k in range(start, min(start + _LANES, t)):
                out[t, k] = out[k, t] = sums[k - start] / features.shape[1]


def _match(
    sign: NDArray[np.float32], others: NDArray[np.float32], limit: np.float32, sums: NDArray[np.float32]
) -> None:
    """Add up the distances to the nearest samples, both ways averaged, of one sign and a block of others."""
    width = others.shape[1]
    most = limit * limit
    gaps, nearest = np.empty(width, np.float32), np.full(width, most, np.float32)
    best = np.empty(_LANES, np.float32)
    sums[:] = np.float32(0.0)
    for a in range(len(sign)):
        a0, a1, a2, a3 = sign[a, 0], sign[a, 1], sign[a, 2], sign[a, 3]
        for u in range(width):
            g0, g1, g2, g3 = others[0, u] - a0, others[1, u] - a1, others[2, u] - a2, others[3, u] - a3
            gaps[u] = (g0 * g0 + g1 * g1) + (g2 * g2 + g3 * g3)
            nearest[u] = min(nearest[u], gaps[u])
        best[:] = most
        for start in range(0, width, _LANES):
            for lane in range(_LANES):
                best[lane] = min(best[lane], gaps[start + lane])
        sums += np.sqrt(best)
    for start in range(0, width, _LANES):
        sums += np.sqrt(nearest[start : start + _LANES])
    sums *= np.float32(0.5)


_match = compiled(_match)
_sign_rows = compiled(_sign_row_block)
