"""Signs: dynamic time warping, and the space of similarities to prototypes (paper, section II-A)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.paths import box_centre, resample_path
from signimit.strokes import Stroke
from signimit.validation import finite_array, item_list, moving_points

SAMPLES = 64
_BLOCK = 2**19  # local costs worked on at once, 4 MB


def dtw_distance(a: ArrayLike, b: ArrayLike) -> float:
    """Compute the dynamic-time-warping distance of two strokes (paper, section II-A).

    Convention: Euclidean distance as local cost, steps (1, 0), (0, 1), (1, 1) of equal weight, the sum along the
    cheapest alignment, neither squared nor divided by its length, no window.

    Args:
        a: Points, shape (n, 2), any unit.
        b: Points, shape (m, 2), the same unit.

    Returns:
        The distance in that unit: 0 for equal strokes, symmetric, unchanged when both are shifted alike.

    Raises:
        InvalidInputError: If either is empty, not finite or not (n, 2).
    """
    first, second = finite_array(a, "first stroke", (None, 2)), finite_array(b, "second stroke", (None, 2))
    for name, stroke in (("first stroke", first), ("second stroke", second)):
        if not len(stroke):
            raise InvalidInputError(name, "at least 1 point", "0")
    gaps = (first[:, None] - second[None]).transpose(2, 0, 1)
    return float(warped_totals(np.hypot(*gaps)[..., None])[0])


def pairwise_dtw(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute `dtw_distance` between all strokes of two stacks at once.

    Args:
        first: Strokes of equal length, shape (A, T, 2).
        second: Strokes of equal length, shape (B, T', 2).

    Returns:
        Distances, shape (A, B).
    """
    out = np.empty((len(first), len(second)))
    rows = max(1, _BLOCK // max(1, first.shape[1] * second[..., 0].size))
    x, y = second.transpose(2, 1, 0)[:, None, :, None]  # (1, T', 1, B); pairs come last, so that they are contiguous
    for start in range(0, len(first), rows):
        block = first[start : start + rows].transpose(2, 1, 0)[:, :, None, :, None]  # (2, T, 1, rows, 1)
        cost = np.hypot(block[0] - x, block[1] - y)
        out[start : start + rows] = warped_totals(cost.reshape(*cost.shape[:2], -1)).reshape(-1, len(second))
    return out


def warped_totals(cost: NDArray[np.float64]) -> NDArray[np.float64]:
    """Accumulate local costs, shape (n, m, B), along anti-diagonals; return the totals, shape (B,)."""
    n, m, count = cost.shape
    cells = cost.reshape(n * m, count)  # cell (i, d - i) of diagonal d is row d + i (m - 1)
    older, last, current = np.full((3, n + 2, count), np.inf)  # three diagonals; row i + 1 holds cell i
    older[0] = 0.0
    for d in range(n + m - 1):
        low, high = max(0, d - m + 1), min(n, d + 1)
        total = current[low + 1 : high + 1]
        np.minimum(last[low:high], last[low + 1 : high + 1], out=total)
        np.minimum(total, older[low:high], out=total)
        total += cells[d + low * (m - 1) : d + (high - 1) * (m - 1) + 1 : max(1, m - 1)]
        current[low] = current[high + 1] = np.inf
        older, last, current = last, current, older
    return np.asarray(last[n])


def normalised_sign(sign: ArrayLike, samples: int = SAMPLES) -> NDArray[np.float64]:
    """Resample a sign evenly along its length, centre it, and scale it to a largest half extent of 1.

    Args:
        sign: Points, shape (T, 2), any unit.
        samples: Number of points of the result.

    Returns:
        Shape (samples, 2), no unit, within [-1, 1]; the same for the sign shifted or scaled.

    Raises:
        InvalidInputError: If the sign has fewer than two points, does not move or is not finite.
    """
    return _normalised(moving_points(sign, "sign"), samples)


def _normalised(points: NDArray[np.float64], samples: int = SAMPLES) -> NDArray[np.float64]:
    resampled = resample_path(points / np.abs(points).max(), samples)
    centred = resampled - box_centre(resampled)
    return np.asarray(centred / np.abs(centred).max())


def prototype_points(prototypes: Sequence[Stroke | ArrayLike]) -> tuple[NDArray[np.float64], ...]:
    """Copy prototype strokes as points, each of shape (T, 2).

    Raises:
        InvalidInputError: If there are none, or one is not a stroke.
    """
    return tuple(
        moving_points(p.points if isinstance(p, Stroke) else p, f"prototype {i}")
        for i, p in enumerate(item_list(prototypes, "prototypes"))
    )


@one_line
@dataclass(frozen=True, eq=False)
class SignSpace:
    """The space whose coordinates are similarities to a few prototype signs (paper, section II-A).

    Attributes:
        prototypes: Normalised prototype strokes, shape (P, 64, 2).
    """

    prototypes: NDArray[np.float64]

    def __init__(self, prototypes: Sequence[Stroke | ArrayLike]) -> None:
        """Normalise the prototypes.

        Raises:
            InvalidInputError: If there are none, or one is not a stroke.
        """
        stacked = np.stack([_normalised(points) for points in prototype_points(prototypes)])
        stacked.setflags(write=False)
        object.__setattr__(self, "prototypes", stacked)

    def embed(self, sign: ArrayLike) -> NDArray[np.float64]:
        """Turn one sign into a point.

        Args:
            sign: Points, shape (T, 2), any unit.

        Returns:
            Similarity to each prototype, shape (P,), in (0, 1].
        """
        return np.asarray(self.embed_all([sign])[0])

    def embed_all(self, signs: Sequence[ArrayLike]) -> NDArray[np.float64]:
        """Turn signs into points, shape (len(signs), P).

        Departure: the paper says only "similarity (after dynamic time warping)". Here both strokes are resampled to
        64 points and brought to a common size, and the similarity is 1 / (1 + DTW distance / 64).
        """
        points = [moving_points(s, f"sign {i}") for i, s in enumerate(item_list(signs, "signs"))]
        strokes = np.stack([_normalised(p) for p in points])
        return np.asarray(1.0 / (1.0 + pairwise_dtw(strokes, self.prototypes) / SAMPLES))
