"""Incremental local online Gaussian mixture regression: the first author's own answer to the paper's future work.

Cederborg, Li, Baranes and Oudeyer 2010, doi:10.1109/IROS.2010.5652040. Nothing is fitted beforehand; at each call a
small mixture is fitted to the demonstrated points nearest to the hand, so new demonstrations only have to be added.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from signimit.exceptions import InvalidInputError
from signimit.policies.base import Array, check_hand
from signimit.policies.gaussian_mixture import fit_mixture, regress, within_speed
from signimit.policies.gmr import position_velocity, speed_limit
from signimit.policies.storage import StoredPolicy
from signimit.strokes import Stroke
from signimit.validation import FARTHEST, finite_array

NEIGHBOURS = 50  # points of a local mixture, as many as the paper's policy has
STEPS = 4  # of expectation maximisation; not tuned
BLOCK = 256  # hands at once


@dataclass(frozen=True, eq=False, repr=False)
class ILOGMRPolicy(StoredPolicy):
    """Expected velocity under a mixture of two, fitted to the nearest points at every call.

    Departure: the components start from the two sides of the widest spread of velocity, not at random.

    Attributes:
        data: Demonstrated positions and velocities, shape (n, 4), m and m/s.
        limit: Fastest demonstrated speed (99th percentile), m/s, never exceeded.
        neighbours: How many points a mixture is fitted to. More of them make it a smoother, more global model.
    """

    kind: ClassVar[str] = "ilo-gmr"
    data: Array
    limit: float
    neighbours: int = NEIGHBOURS
    _tree: cKDTree = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the shape and index the points."""
        super().__post_init__()
        finite_array(finite_array(self.data, "policy: data", (None, 4))[:, :2], "policy: data", (None, 2), FARTHEST)
        if self.limit <= 0:
            raise InvalidInputError("policy: limit", "a speed above 0", f"{self.limit:g}")
        object.__setattr__(self, "_tree", cKDTree(self.data[:, :2]))

    @classmethod
    def learn(cls, demonstrations: Sequence[Stroke], *, neighbours: int = NEIGHBOURS) -> Self:
        """Keep the demonstrations."""
        data = position_velocity(demonstrations)
        return cls(data, speed_limit(data), neighbours)

    def step(self, state: None, hand: ArrayLike) -> tuple[None, Array]:
        """Return no state, and velocities, shape (2,) or (B, 2), m/s, for hands of the same shape, m."""
        hands = check_hand(hand)
        flat = hands.reshape(-1, 2)
        blocks = [self._local(flat[i : i + BLOCK]) for i in range(0, len(flat), BLOCK)]
        return None, np.concatenate([np.zeros((0, 2)), *blocks]).reshape(hands.shape)

    def _local(self, hands: Array) -> Array:
        _, nearest = self._tree.query(hands, k=min(self.neighbours, len(self.data)))
        near = self.data[nearest.reshape(len(hands), -1)]  # (B, k, 4)
        velocity = near[..., 2:] - near[..., 2:].mean(axis=1, keepdims=True)
        _, axes = np.linalg.eigh(np.swapaxes(velocity, 1, 2) @ velocity)
        side = (velocity @ axes[..., -1:])[..., 0] > 0
        mixture = fit_mixture(near, np.stack([side, ~side], axis=-1).astype(np.float64), STEPS)
        return within_speed(regress(mixture, hands[:, None])[:, 0], self.limit)
