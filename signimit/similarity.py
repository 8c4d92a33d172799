"""How alike two demonstrated policies are, in every pair of frames (paper, section II-B)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.acceleration import find_twin
from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.paths import nearest_points
from signimit.validation import finite_array, item_list, moving_points

DISTANCE_FLOOR = 1e-6  # rad²; keeps γ finite where two paths agree to the last bit
_SECONDS = 1e-9  # that numpy takes for a pair of points


@one_line
class DirectedPoints(NamedTuple):
    """A path as input and output of a policy: where the hand was, and which way it went from there.

    Attributes:
        positions: Where the hand was, shape (n, 2), m.
        angles: Direction of motion there, shape (n,), rad from the x axis.
    """

    positions: NDArray[np.float64]
    angles: NDArray[np.float64]


def directed_points(path: ArrayLike) -> DirectedPoints:
    """Return the positions of a path and its directions of motion.

    Departure: the paper does not say what the output of a resting hand is; it has none, so rests are left out.

    Args:
        path: Hand positions, shape (T, 2), m.

    Returns:
        n <= T - 1 directed points.

    Raises:
        InvalidInputError: If the path has fewer than two points or does not move.
    """
    points = moving_points(path, "path")
    steps = np.diff(points, axis=0)
    moves = np.any(steps != 0, axis=1)
    return DirectedPoints(points[:-1][moves], np.arctan2(steps[moves, 1], steps[moves, 0]))


def policy_distances(paths: Sequence[ArrayLike], objects: ArrayLike) -> NDArray[np.float64]:
    """Compute the distance Δ_{t;k;i;j} between all demonstrated policies in all pairs of frames.

    For each point of path t in the frame of its object i, the nearest point of path k in the frame of its object j is
    found; D_{t;k;i;j} is the mean squared angle between their directions of motion (paper, section II-B).

    Departure: the paper prints Δ = min(D_{t;k;i;j}, D_{t;k;i;j}); read as min(D_{t;k;i;j}, D_{k;t;j;i}).

    Args:
        paths: N hand paths, each (T_t, 2), m, table frame.
        objects: Object positions, shape (N, O, 2), m, table frame.

    Returns:
        Δ, shape (N, N, O, O), rad², with ``Δ[t, k, i, j] == Δ[k, t, j, i]``.

    Raises:
        InvalidInputError: If a path does not move, or objects do not fit the paths.
    """
    directed = [_directed(path, t) for t, path in enumerate(item_list(paths, "paths"))]
    places = finite_array(objects, "objects", (len(directed), None, 2))
    if not places.size:
        raise InvalidInputError("objects", "at least one in each demonstration", "none")
    pairs = (places.shape[1] * sum(len(d.angles) for d in directed)) ** 2
    twin = find_twin("signimit.similarity_numba", _SECONDS * pairs)
    if twin is None:
        one_way = _one_way_distances(directed, places)
    else:
        one_way = twin.one_way_policy_distances([d.positions for d in directed], [d.angles for d in directed], places)
    return np.minimum(one_way, one_way.transpose(1, 0, 3, 2))


def _directed(path: ArrayLike, number: int) -> DirectedPoints:
    try:
        return directed_points(path)
    except InvalidInputError as error:
        raise error.inside(f"demonstration {number}") from None


def _one_way_distances(directed: list[DirectedPoints], objects: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute D_{t;k;i;j}, shape (N, N, O, O).

    A change of frames is only a shift, so for each path k all points of all paths in all pairs of frames are queries
    against the same points: |p - q|² is least where |q|² - 2 p·q is, one matrix product and one argmin a block.
    """
    count, frames = objects.shape[:2]
    lengths = np.repeat([len(d.angles) for d in directed], frames * frames)
    starts = np.concatenate([[0], np.cumsum(lengths)[:-1]])
    local = [d.positions - objects[t][:, None] for t, d in enumerate(directed)]  # (O, n, 2)
    angles = np.concatenate([np.tile(d.angles, frames * frames) for d in directed])
    out = np.empty((count, count, frames, frames))
    for k, target in enumerate(directed):
        queries = np.concatenate([(p[:, None] + objects[k][None, :, None]).reshape(-1, 2) for p in local])
        nearest = nearest_points(queries, target.positions)
        gaps = np.abs(angles - target.angles[nearest])
        gaps = np.minimum(gaps, 2 * np.pi - gaps)
        sums = np.add.reduceat(gaps * gaps, starts)
        out[:, k] = (sums / lengths).reshape(count, frames, frames)
    return out


def check_distances(distances: ArrayLike) -> NDArray[np.float64]:
    """Copy Δ, shape (N, N, O, O), N and O at least 1.

    Raises:
        InvalidInputError: If it has another shape or is not finite.
    """
    table = finite_array(distances, "distances", (None, None, None, None))
    demonstrations, again, frames, too = table.shape
    if demonstrations != again or frames != too or not table.size:
        raise InvalidInputError("distances", "shape (N, N, O, O)", f"shape {table.shape}")
    return table


def policy_similarities(distances: ArrayLike) -> NDArray[np.float64]:
    """Compute γ_{t;k;i;j} = 1 / Δ_{t;k;i;j}, shape (N, N, O, O), 1/rad² (paper, section II-B).

    Departure: Δ is clamped at 1e-6 rad² so that γ stays finite where two demonstrations are the same.

    Raises:
        InvalidInputError: If Δ has another shape or is not finite.
    """
    return 1.0 / np.maximum(check_distances(distances), DISTANCE_FLOOR)


def maximum_similarities(distances: ArrayLike) -> NDArray[np.float64]:
    """Compute γ_{t;k} = max_{i,j} γ_{t;k;i;j}, shape (N, N), 1/rad² (paper, section II-B).

    Departure: the paper leaves γ_{t;t} undefined; it is 0, as in its figures 5 and 6.

    Raises:
        InvalidInputError: If Δ has another shape or is not finite.
    """
    best = policy_similarities(distances).max(axis=(2, 3))
    np.fill_diagonal(best, 0.0)
    return np.asarray(best)
