"""Compiled distances (numba, the extra ``fast``): the same answers as the numpy code, several times as fast.

Import this module through `signimit.acceleration.find_kernels` only: it needs numba.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

_FAR = np.float32(1e30)
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
    _share_rows(_policy_rows, count, paths, objects, np.float32(_DOUBT * extent**2), out)
    return out


def drawing_distances(features: NDArray[np.float32]) -> NDArray[np.float64]:
    """Compute the one-way distances of `signimit.traces.cross_distances` of all drawings.

    Args:
        features: Drawings in their frames, shape (N, O, S, 5): place, then manner, which is the same in every frame.

    Returns:
        From each to each, shape (N, N, O, O), no unit.
    """
    count, frames = features.shape[:2]
    places = np.ascontiguousarray(features[..., :2].transpose(0, 3, 1, 2))
    manner = np.ascontiguousarray(features[:, 0, :, 2:].transpose(0, 2, 1))
    out = np.empty((count, count, frames, frames))
    _share_rows(_drawing_rows, count, places, manner, out)
    return out


def _share_rows(kernel: Callable[..., Any], count: int, *arguments: Any) -> None:
    """Let every processor fill each its rows; no two write to one place, so their number changes nothing."""
    workers = min(count, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(lambda first: kernel(first, workers, *arguments), range(workers)))


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
                    small, large = (e1, e0) if e1 < e0 else (e0, e1)
                    old, runner = best[u], second[u]
                    loser = old if small < old else small
                    runner = large if large < runner else runner
                    second[u] = loser if loser < runner else runner
                    index[u] = (v1 if e1 < e0 else v0) if small < old else index[u]
                    best[u] = small if small < old else old
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


def _drawing_row_block(
    first: int, step: int, places: NDArray[np.float32], manner: NDArray[np.float32], out: NDArray[np.float64]
) -> None:
    """Fill rows first, first + step, ...; all frames of the asking drawing go through at once."""
    count, frames, samples = places.shape[0], places.shape[2], places.shape[3]
    width = frames * samples
    base, best = np.empty((samples, width), np.float32), np.empty(width, np.float32)
    qx, qy = np.empty(width, np.float32), np.empty(width, np.float32)
    for t in range(first, count, step):
        qx[:], qy[:] = places[t, 0].ravel(), places[t, 1].ravel()
        for k in range(count):
            for b in range(samples):
                m0, m1, m2 = manner[k, 0, b], manner[k, 1, b], manner[k, 2, b]
                for a in range(samples):
                    g0, g1, g2 = manner[t, 0, a] - m0, manner[t, 1, a] - m1, manner[t, 2, a] - m2
                    base[b, a] = g0 * g0 + (g1 * g1 + g2 * g2)
                for u in range(samples, width):
                    base[b, u] = base[b, u - samples]
            for j in range(frames):
                best[:] = _FAR
                for b in range(samples):
                    x, y = places[k, 0, j, b], places[k, 1, j, b]
                    for u in range(width):
                        here = base[b, u] + ((qx[u] - x) * (qx[u] - x) + (qy[u] - y) * (qy[u] - y))
                        old = best[u]
                        best[u] = here if here < old else old
                for i in range(frames):
                    total = 0.0
                    for u in range(i * samples, (i + 1) * samples):
                        total += np.sqrt(best[u])
                    out[t, k, i, j] = total / samples


def _compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile at the first call, and keep the result on disk where there is a folder to keep it in."""
    options: dict[str, Any] = {"nogil": True, "fastmath": True, "error_model": "numpy"}
    try:
        kernel: Callable[..., Any] = numba.njit(cache=True, **options)(function)
    except RuntimeError:  # neither the package's folder nor the user's can be written to
        kernel = numba.njit(**options)(function)
    return kernel


_place_queries = _compiled(_place_queries)
_mean_squared_angles = _compiled(_mean_squared_angles)
_policy_rows = _compiled(_policy_row_block)
_drawing_rows = _compiled(_drawing_row_block)
