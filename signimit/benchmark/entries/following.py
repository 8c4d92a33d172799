"""A hand that follows a policy; policies with and without a state have one face here."""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from signimit.benchmark.protocol import Observation
from signimit.policies.frames import PlacedPolicy, StatefulPlacedPolicy


class Follower:
    """Follows one policy from the moment it is made."""

    def __init__(self, policy: PlacedPolicy) -> None:
        """Begin to follow."""
        self._policy = policy
        self._state: Any = policy.start() if isinstance(policy, StatefulPlacedPolicy) else None

    def act(self, observation: Observation) -> NDArray[Any]:
        """Return the velocity for the next control period, shape (2,), m/s."""
        if not isinstance(self._policy, StatefulPlacedPolicy):
            return self._policy(observation.hand)
        self._state, velocity = self._policy.step(self._state, observation.hand)
        return velocity
