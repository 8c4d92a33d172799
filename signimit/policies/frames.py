"""Policies seen from the table: a policy lives in the frame of an object, a hand on the table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.policies import Policy
from signimit.policies.base import check_hand


@dataclass(frozen=True, eq=False)
class PlacedPolicy:
    """A policy about an object, called with hands in the table frame.

    Attributes:
        policy: Velocity, m/s, of a hand in the object's frame.
        origin: Where the object is, shape (2,), m, table frame.
    """

    policy: Policy
    origin: NDArray[np.float64]

    def __call__(self, hand: ArrayLike) -> NDArray[np.float64]:
        """Return the velocity, m/s, of hands of shape (2,) or (B, 2), m, table frame."""
        return self.policy(check_hand(hand) - self.origin)


class StatefulPlacedPolicy(PlacedPolicy):
    """A `PlacedPolicy` whose policy remembers how far it is along the movement."""

    def start(self) -> Any:
        """Return the state before the first step."""
        return self.policy.start()  # type: ignore[attr-defined]

    def step(self, state: Any, hand: ArrayLike) -> tuple[Any, NDArray[np.float64]]:
        """Return the next state, and the velocity, m/s, of hands in the table frame."""
        state, velocity = self.policy.step(state, check_hand(hand) - self.origin)  # type: ignore[attr-defined]
        return state, velocity


def on_table(policy: Policy, origin: NDArray[np.float64]) -> PlacedPolicy:
    """Place a policy at an object; it keeps its state if it has one."""
    wrapper = StatefulPlacedPolicy if hasattr(policy, "step") else PlacedPolicy
    return wrapper(policy, origin)
