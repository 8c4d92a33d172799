"""The paper's policy: the mean output of the nearest demonstrated points (section II-E)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from signimit.exceptions import InvalidInputError
from signimit.policies.base import Array, check_hand, demonstrated_velocities
from signimit.policies.storage import StoredPolicy
from signimit.strokes import Stroke
from signimit.validation import FARTHEST, finite_array

NEIGHBOURS = 50  # points; section II-E
_UNIT = 1 + 1e-9  # largest coordinate of a unit vector that was rounded


@dataclass(frozen=True, eq=False, repr=False)
class KNearestPolicy(StoredPolicy):
    """Move in the mean direction of the nearest demonstrated points, 50 in the paper.

    Departure: the paper's output is a direction, and says nothing of speed; ours is scaled to the mean demonstrated
    speed. Directions that cancel leave the hand slow or at rest, as they do in the paper.

    Attributes:
        points: Demonstrated points that move, shape (n, 2), m, object's frame.
        directions: Direction of motion at each, unit vectors, shape (n, 2).
        speed: Mean speed of the demonstrators, m/s.
        neighbours: How many points are averaged. More of them smooth corners and crossings away; fewer follow the noise
            of a single demonstration.
    """

    kind: ClassVar[str] = "knn"
    points: Array
    directions: Array
    speed: float
    neighbours: int = NEIGHBOURS
    _tree: cKDTree = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the arrays and index the points."""
        super().__post_init__()
        finite_array(self.points, "policy: points", (None, 2), FARTHEST)
        finite_array(self.directions, "policy: directions", self.points.shape, _UNIT)
        if self.speed < 0:
            raise InvalidInputError("policy: speed", "0 or more", f"{self.speed:g}")
        object.__setattr__(self, "_tree", cKDTree(self.points))

    @classmethod
    def learn(cls, demonstrations: Sequence[Stroke], *, neighbours: int = NEIGHBOURS) -> Self:
        """Collect the points of all demonstrations; a resting hand has no direction and is left out."""
        points = np.concatenate([d.points for d in demonstrations])
        velocity = np.concatenate([demonstrated_velocities(d) for d in demonstrations])
        speed = np.hypot(*velocity.T)
        moving = speed > 1e-6 * speed.max()
        return cls(points[moving], velocity[moving] / speed[moving, None], float(speed[moving].mean()), neighbours)

    def step(self, state: None, hand: ArrayLike) -> tuple[None, Array]:
        """Return no state, and velocities, shape (2,) or (B, 2), m/s, for hands of the same shape, m."""
        hands, count = check_hand(hand), min(self.neighbours, len(self.points))
        _, nearest = self._tree.query(hands, k=count)
        mean: Array = self.directions[nearest].reshape(*hands.shape[:-1], count, 2).mean(axis=-2)
        return None, mean * self.speed
