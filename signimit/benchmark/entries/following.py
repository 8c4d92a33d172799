"""The part that entries share which follow a policy: stepping it, once a control period."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.protocol import Observation
from signimit.policies import Policy


class Follower:
    """Base of entries that answer a command with a policy in the table frame."""

    def follow(self, policy: Policy) -> None:
        """Begin to follow a policy."""
        self._policy, self._state = policy, policy.start()

    def act(self, observation: Observation) -> NDArray[np.float64]:
        """Return the policy's velocity for the next control period, shape (2,), m/s."""
        self._state, velocity = self._policy.step(self._state, observation.hand)
        return velocity
