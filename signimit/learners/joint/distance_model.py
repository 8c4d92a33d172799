"""What a distance of two signs says about their meaning the same: calibrated log-likelihood ratios.

The means and spreads below were measured on real people's strokes, and the shares chosen by how many of their sessions
were understood. They are the same for everybody.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_TABLE = 2**13  # numbers of the table that ratios are read from; between them they are straight to 5e-6 nats


@dataclass(frozen=True, kw_only=True)
class DistanceModel:
    """How the logarithm of a distance is distributed among equals and among others.

    Attributes:
        equal_mean: Mean log distance of equals.
        equal_spread: Standard deviation about it.
        other_mean: Mean log distance of others.
        other_spread: Standard deviation about that.
        odd_share: Share of equals that look like others: a sign made in an unusual way, a drawing that went wrong.
        akin_share: Share of others that are akin, as a circle and a rectangle are that one person draws.
        akin_mean: Mean log distance of those.
        akin_spread: Standard deviation about that.
        chance_share: Share of others that look like equals.
    """

    equal_mean: float
    equal_spread: float
    other_mean: float
    other_spread: float
    odd_share: float
    akin_share: float = 0.0
    akin_mean: float = 0.0
    akin_spread: float = 1.0
    chance_share: float = 0.01

    def log_ratios(self, distances: NDArray[np.floating], equal_mean: float) -> NDArray[np.float64]:
        """Compute log p(distance | equal) - log p(distance | other).

        Below the typical distance of equals, and above that of others, the ratio stays what it is there: closer than
        close is no less equal.

        Args:
            distances: Any shape, not negative.
            equal_mean: Typical log distance of equals.

        Returns:
            The same shape, within log(odd_share) and -log(chance_share).
        """
        table = np.linspace(equal_mean, max(self.other_mean, equal_mean), _TABLE)
        return np.asarray(np.interp(distances, np.exp(table), self._log_ratios(table, equal_mean)))

    def _log_ratios(self, x: NDArray[np.float64], equal_mean: float) -> NDArray[np.float64]:
        equal = _log_normal(x, equal_mean, self.equal_spread)
        other = self._log_other(x)
        return np.asarray(
            np.logaddexp(np.log1p(-self.odd_share) + equal, np.log(self.odd_share) + other)
            - np.logaddexp(np.log1p(-self.chance_share) + other, np.log(self.chance_share) + equal)
        )

    def _log_other(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        plain = _log_normal(x, self.other_mean, self.other_spread)
        if not self.akin_share:
            return plain
        akin = np.log(self.akin_share) + _log_normal(x, self.akin_mean, self.akin_spread)
        return np.asarray(np.logaddexp(np.log1p(-self.akin_share) + plain, akin))


def _log_normal(x: NDArray[np.float64], mean: float, spread: float) -> NDArray[np.float64]:
    return np.asarray(-0.5 * ((x - mean) / spread) ** 2 - np.log(spread))


SIGNS = DistanceModel(
    equal_mean=-1.17,
    equal_spread=0.36,
    other_mean=-0.23,
    other_spread=0.21,
    odd_share=0.3,
    chance_share=0.05,
)
