"""An entry in closed loop: it is shown a hand 50 times a second and says how it shall move, and the hand moves so.

The hand is a point that follows exactly; what the arm's physics adds is `signimit_envs`' business.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.protocol import Entry, Observation
from signimit.exceptions import InvalidInputError
from signimit.policies import CONTROL_PERIOD, Policy, run_policy
from signimit.teaching.sessions import Command

SECONDS = 10.0  # how long a hand moves for each command
FASTEST = 1.2  # m/s along either axis, the arm's `max_hand_speed`; what is faster is slowed down as a whole


def obey(entry: Entry, command: Command, seconds: float = SECONDS) -> NDArray[np.float64]:
    """Let an entry answer a command.

    Returns:
        Where the hand was at the start and after every control period, shape (T + 1, 2), m, table frame.

    Raises:
        InvalidInputError: If the entry commands what is not a velocity.
    """
    entry.begin(command.signs, command.objects)
    return run_policy(_EntryPolicy(entry), command.hand, seconds)


class _Before(NamedTuple):
    """State of `_EntryPolicy`: the number of control steps so far, and the last velocity, m/s."""

    steps: int
    velocity: NDArray[np.float64]


class _EntryPolicy(Policy):
    """What an entry does once it was told a command, as a policy of one hand; the entry itself remembers more."""

    def __init__(self, entry: Entry) -> None:
        self._entry = entry

    def start(self) -> _Before:
        return _Before(0, np.zeros(2))

    def step(self, state: _Before, hand: ArrayLike) -> tuple[_Before, NDArray[np.float64]]:
        observation = Observation(np.array(hand), state.velocity.copy(), state.steps * CONTROL_PERIOD)
        velocity = _checked_velocity(self._entry.act(observation), state.steps)
        return _Before(state.steps + 1, velocity), velocity


def _checked_velocity(given: Any, step: int) -> NDArray[np.float64]:
    try:
        velocity = np.array(given, dtype=np.float64)
    except (TypeError, ValueError):
        velocity = np.empty(0)
    x, y = velocity.tolist() if velocity.shape == (2,) else (math.nan, math.nan)
    if not (math.isfinite(x) and math.isfinite(y)):
        raise InvalidInputError(f"act at step {step}", "a finite velocity of shape (2,), m/s", f"{given!r:.60}")
    allowed: NDArray[np.float64] = velocity / max(1.0, abs(x) / FASTEST, abs(y) / FASTEST)
    return allowed
