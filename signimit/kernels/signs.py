"""Compiled distances of signs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.kernels.compilation import FAR, compiled, share_rows

_LANES = 16  # signs that are compared with one at once


def sign_distances(courses: NDArray[np.float32], pictures: NDArray[np.float32]) -> NDArray[np.float64]:
    """Compute the distances of `signimit.learners.vocabulary.sign_distances`.

    Args:
        courses: Place and direction along N signs, shape (N, S, 4).
        pictures: Place and slope, shape (N, S, 4).

    Returns:
        Shape (N, N), no unit.
    """
    out = np.zeros((len(courses), len(courses)))
    share_rows(_sign_rows, len(courses), courses, _blocked(courses), pictures, _blocked(pictures), out)
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
    courses: NDArray[np.float32],
    course_blocks: NDArray[np.float32],
    pictures: NDArray[np.float32],
    picture_blocks: NDArray[np.float32],
    out: NDArray[np.float64],
) -> None:
    """Fill rows first, first + step, ... up to the diagonal, and the columns that mirror them."""
    course, picture = np.empty(_LANES, np.float32), np.empty(_LANES, np.float32)
    for t in range(first, len(out), step):
        for block in range(-(-t // _LANES)):
            _warp(courses[t], course_blocks[block], course)
            _match(pictures[t], picture_blocks[block], picture)
            start = block * _LANES
            for k in range(start, min(start + _LANES, t)):
                out[t, k] = out[k, t] = np.sqrt(course[k - start] * picture[k - start]) / courses.shape[1]


def _warp(course: NDArray[np.float32], others: NDArray[np.float32], totals: NDArray[np.float32]) -> None:
    """Accumulate the costs of `signimit.signs.warped_totals`, row by row, for one course and a block of others."""
    width = others.shape[1]
    above = np.full(width + _LANES, FAR, np.float32)  # totals of the last row, after a column of walls
    cost, low = np.empty(width, np.float32), np.empty(width, np.float32)
    above[:_LANES] = np.float32(0.0)
    for a in range(len(course)):
        a0, a1, a2, a3 = course[a, 0], course[a, 1], course[a, 2], course[a, 3]
        for u in range(width):
            g0, g1, g2, g3 = others[0, u] - a0, others[1, u] - a1, others[2, u] - a2, others[3, u] - a3
            cost[u] = np.sqrt((g0 * g0 + g1 * g1) + (g2 * g2 + g3 * g3))
            low[u] = min(above[u], above[u + _LANES])
        above[:_LANES] = totals[:] = FAR
        for start in range(0, width, _LANES):
            for lane in range(_LANES):
                here = min(totals[lane], low[start + lane]) + cost[start + lane]
                totals[lane] = above[start + _LANES + lane] = here


def _match(picture: NDArray[np.float32], others: NDArray[np.float32], sums: NDArray[np.float32]) -> None:
    """Add up the distances to the nearest samples, both ways averaged, of one picture and a block of others."""
    width = others.shape[1]
    gaps, nearest = np.empty(width, np.float32), np.full(width, FAR, np.float32)
    best = np.empty(_LANES, np.float32)
    sums[:] = np.float32(0.0)
    for a in range(len(picture)):
        a0, a1, a2, a3 = picture[a, 0], picture[a, 1], picture[a, 2], picture[a, 3]
        for u in range(width):
            g0, g1, g2, g3 = others[0, u] - a0, others[1, u] - a1, others[2, u] - a2, others[3, u] - a3
            gaps[u] = (g0 * g0 + g1 * g1) + (g2 * g2 + g3 * g3)
            nearest[u] = min(nearest[u], gaps[u])
        best[:] = FAR
        for start in range(0, width, _LANES):
            for lane in range(_LANES):
                best[lane] = min(best[lane], gaps[start + lane])
        sums += np.sqrt(best)
    for start in range(0, width, _LANES):
        sums += np.sqrt(nearest[start : start + _LANES])
    sums *= np.float32(0.5)


_warp = compiled(_warp)
_match = compiled(_match)
_sign_rows = compiled(_sign_row_block)
