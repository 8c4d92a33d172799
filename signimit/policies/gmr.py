"""Gaussian mixture regression, the number of components chosen by BIC (the paper's [12] and [15]).

Calinon, Guenter and Billard 2007, doi:10.1109/TSMCB.2006.886952; written here on numpy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from signimit.exceptions import InvalidInputError
from signimit.policies.base import Array, check_hand, demonstrated_velocities
from signimit.policies.gaussian_mixture import (
    Mixture,
    bayesian_information,
    fit_mixture,
    regress,
    within_speed,
)
from signimit.policies.storage import StoredPolicy
from signimit.strokes import Stroke
from signimit.validation import FARTHEST, finite_array, whole_numbers

COMPONENTS = (1, 2, 3, 4, 6, 8, 10, 12, 16)  # numbers of components to choose from
POINTS_EACH = 10  # data points that a component needs: its mean and covariance have 14 numbers
STEPS = 30  # of expectation maximisation
_LEAST_VARIANCE = 1e-10  # m², of positions in any direction; fitted ones have 1e-9 at least
MOST_POINTS = 800  # evenly taken from all demonstrations; enough for 16 components over four features


@dataclass(frozen=True, eq=False, repr=False)
class GMRPolicy(StoredPolicy):
    """Expected velocity given the position, under a mixture over (position, velocity).

    Attributes:
        weights: Priors, shape (K,).
        means: Over (x, y, vx, vy), shape (K, 4), m and m/s.
        covariances: Shape (K, 4, 4).
        limit: Fastest demonstrated speed (99th percentile), m/s, never exceeded.
    """

    kind: ClassVar[str] = "gmr"
    weights: Array
    means: Array
    covariances: Array
    limit: float

    def __post_init__(self) -> None:
        """Check the shapes, and that the positions have densities."""
        super().__post_init__()
        count = len(finite_array(self.weights, "policy: weights", (None,)))
        finite_array(
            finite_array(self.means, "policy: means", (count, 4))[:, :2], "policy: means", (count, 2), FARTHEST
        )
        shared = finite_array(self.covariances, "policy: covariances", (count, 4, 4))[:, :2, :2]
        if (self.weights <= 0).any() or self.limit <= 0:
            raise InvalidInputError("policy: weights, limit", "numbers above 0", "others")
        if not _have_densities(shared):
            raise InvalidInputError("policy: covariances", "symmetric, positive definite matrices", "others")

    @classmethod
    def learn(cls, demonstrations: Sequence[Stroke], *, components: Sequence[int] = COMPONENTS) -> Self:
        """Fit mixtures of several sizes and keep the one with the least BIC.

        Args:
            demonstrations: Of one movement, in the object's frame.
            components: Numbers of components to choose from; those that there are too few points for are left out.

        Raises:
            InvalidInputError: If ``components`` are no numbers, or there are too few points for each of them.
        """
        data = position_velocity(demonstrations)
        limit = speed_limit(data)
        data = data[:: max(1, -(-len(data) // MOST_POINTS))]
        most = max(len(data) // POINTS_EACH, 1)
        counts = [int(count) for count in whole_numbers(components, "components", (None,)) if 1 <= count <= most]
        if not counts:
            raise InvalidInputError("components", f"a number from 1 to {most}, a tenth of the points", f"{components}")
        fits = [_fit(data, count) for count in counts]
        best = min(fits, key=lambda mixture: bayesian_information(mixture, data))
        return cls(best.weights, best.means, best.covariances, limit)

    def step(self, state: None, hand: ArrayLike) -> tuple[None, Array]:
        """Return no state, and velocities, shape (2,) or (B, 2), m/s, for hands of the same shape, m."""
        hands = check_hand(hand)
        mixture = Mixture(self.weights, self.means, self.covariances)
        return None, within_speed(regress(mixture, hands.reshape(-1, 2)), self.limit).reshape(hands.shape)


def _have_densities(covariances: Array) -> bool:
    """Tell whether matrices, shape (K, 2, 2), are covariances of positions, m², as far as rounding lets them."""
    apart = np.abs(covariances - covariances.swapaxes(1, 2)).max(axis=(1, 2))
    if (apart > 1e-9 * np.abs(covariances).max(axis=(1, 2))).any():
        return False
    try:
        precisions = np.linalg.inv(covariances)
    except np.linalg.LinAlgError:
        return False
    if (np.abs(precisions) > 1 / _LEAST_VARIANCE).any():
        return False
    inverse = np.linalg.eigvalsh(precisions + precisions.swapaxes(1, 2)) / 2
    return bool(((inverse > 0) & (inverse < 1 / _LEAST_VARIANCE)).all())


def position_velocity(demonstrations: Sequence[Stroke]) -> Array:
    """Return all demonstrated positions and velocities, shape (n, 4), m and m/s."""
    parts = [np.hstack([d.points, demonstrated_velocities(d)]) for d in demonstrations]
    return np.concatenate(parts)


def speed_limit(data: Array) -> float:
    """Return the 99th percentile of the demonstrated speeds, m/s."""
    return float(np.percentile(np.hypot(data[:, 2], data[:, 3]), 99)) + 1e-9


def _fit(data: Array, count: int) -> Mixture:
    """Run expectation maximisation from the clusters about points far from each other."""
    scaled = data / (data.std(axis=0) + 1e-12)
    gaps = np.full((len(data), count), np.inf)
    for k in range(count):
        far = int(gaps.min(axis=1).argmax())
        gaps[:, k] = np.sqrt(((scaled - scaled[far]) ** 2).sum(axis=1))
    return fit_mixture(data, np.eye(count)[gaps.argmin(axis=1)], STEPS)
