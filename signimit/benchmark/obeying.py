"""An entry in closed loop: it sees a hand, says how it shall move, 50 times a second, and the hand moves so.

The hand is a point that follows exactly; what the arm's physics adds is `signimit_envs`' business.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.commands import Command
from signimit.benchmark.protocol import CONTROL_PERIOD, Entry, Observation
from signimit.exceptions import InvalidInputError

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
    steps = round(seconds / CONTROL_PERIOD)
    path = np.empty((steps + 1, 2))
    path[0], velocity = command.hand, np.zeros(2)
    for step in range(steps):
        observation = Observation(path[step].copy(), velocity.copy(), step * CONTROL_PERIOD)
        velocity = _checked_velocity(entry.act(observation), step)
        path[step + 1] = path[step] + CONTROL_PERIOD * velocity
    return path


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
