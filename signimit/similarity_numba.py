"""The one-way distances of `signimit.similarity`, compiled by numba; imported when they are worthwhile."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.acceleration import compiled, share_rows

_FAR = np.float32(1e30)  # of any squared distance
_DOUBT = 1e-6  # of the squared extent; nearer than this, single precision cannot tell which of two points is nearest


def one_way_policy_distances(
    positions: list[NDArray[np.float64]], angles: list[NDArray[np.float64]], objects: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute D_{t;k;i;j} of `signimit.similarity`, shape (N, N, O, O), rad².

    The nearest point is searched for in single precision; where the runner-up is too near to tell, again in double.

    Args:
        positions: N paths, each (n, 2), m, table frame.
        angles: Their directions, each (n,), rad.
        objects: Shape (N, O, 2), m, table frame.
    """
    count, frames = objects.shape[:2]
    points = np.concatenate(positions)
    points -= points.mean(axis=0)
    starts = np.concatenate([[0], np.cumsum([len(a) for a in angles])])
    extent = float(np.abs(points).max() + 2 * np.abs(objects - objects.mean(axis=(0, 1))).max())
    out = np.empty((count, count, frames, frames))
    paths = _Paths(points[:, 0].copy(), points[:, 1].copy(), np.concatenate(angles), starts)
    share_rows(_policy_rows, count, paths, objects, np.float32(_DOUBT * extent**2), out)
    return out


class _Paths(NamedTuple):
    """All paths end to end; ``starts`` has one number more than there are paths."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    angles: NDArray[np.float64]
    starts: NDArray[np.int64]


def _policy_row_block(
    first: int, step: int, paths: _Paths, objects: NDArray[np.float64], doubt: np.float32, out: NDArray[np.float64]
) -> None:
    """Fill rows first, first + step, ...; all frames of a pair are one list of queries, two targets a pass."""
    x, y, starts, frames = paths.x, paths.y, paths.starts, objects.shape[1]
    room = np.max(np.diff(starts)) * frames * frames
    qx, qy = np.empty(room, np.float32), np.empty(room, np.float32)
    best, second, index = np.empty(room, np.float32), np.empty(room, np.float32), np.empty(room, np.int32)
    for t in range(first, len(objects), step):
        for k in range(len(objects)):
            width = _place_queries(t, k, paths, objects, qx, qy)
            best[:], second[:] = _FAR, _FAR
            for v in range(starts[k], starts[k + 1], 2):
                z = min(v + 1, starts[k + 1] - 1)
                v0, v1 = np.int32(v), np.int32(z)
                x0, y0 = np.float32(-2.0 * x[v]), np.float32(-2.0 * y[v])
                x1, y1 = np.float32(-2.0 * x[z]), np.float32(-2.0 * y[z])
                z0 = np.float32(x[v] * x[v] + y[v] * y[v])
                z1 = np.float32(x[z] * x[z] + y[z] * y[z]) if z > v else _FAR
                for u in range(width):  # no branches, no calls: eight queries go through at once
                    e0 = qx[u] * x0 + (qy[u] * y0 + z0)
                    e1 = qx[u] * x1 + (qy[u] * y1 + z1)
                    small, large, near = min(e0, e1), max(e0, e1), v1 if e1 < e0 else v0
                    old, known = best[u], index[u]
                    second[u] = min(min(second[u], large), max(old, small))
                    index[u] = near if small < old else known
                    best[u] = min(old, small)
            for u in range(width):
                index[u] = -1 if second[u] - best[u] < doubt else index[u]
            _mean_squared_angles(t, k, paths, objects, index, out)


def _place_queries(
    t: int, k: int, paths: _Paths, objects: NDArray[np.float64], qx: NDArray[np.float32], qy: NDArray[np.float32]
) -> int:
    """Put the points of path t as they lie beside path k, for all pairs of frames; return how many."""
    width = 0
    for i in range(objects.shape[1]):
        for j in range(objects.shape[1]):
            sx, sy = objects[k, j, 0] - objects[t, i, 0], objects[k, j, 1] - objects[t, i, 1]
            for u in range(paths.starts[t], paths.starts[t + 1]):
                qx[width], qy[width] = np.float32(paths.x[u] + sx), np.float32(paths.y[u] + sy)
                width += 1
    return width


def _mean_squared_angles(
    t: int, k: int, paths: _Paths, objects: NDArray[np.float64], index: NDArray[np.int32], out: NDArray[np.float64]
) -> None:
    """Average over each pair of frames; -1 stands for a nearest point still to be found, in double precision."""
    x, y, angles = paths.x, paths.y, paths.angles
    a, b, w = paths.starts[t], paths.starts[t + 1], 0
    for i in range(objects.shape[1]):
        for j in range(objects.shape[1]):
            sx, sy, total = objects[k, j, 0] - objects[t, i, 0], objects[k, j, 1] - objects[t, i, 1], 0.0
            for u in range(a, b):
                near, least = int(index[w]), 1e300
                if near < 0:
                    for v in range(paths.starts[k], paths.starts[k + 1]):
                        gx, gy = x[v] - x[u] - sx, y[v] - y[u] - sy
                        if gx * gx + gy * gy < least:
                            least, near = gx * gx + gy * gy, v
                gap = abs(angles[u] - angles[near])
                gap = min(gap, 2.0 * np.pi - gap)
                total += gap * gap
                w += 1
            out[t, k, i, j] = total / (b - a)


_place_queries = compiled(_place_queries)
_mean_squared_angles = compiled(_mean_squared_angles)
_policy_rows = compiled(_policy_row_block)
