"""The closed loop of a policy and the hands that it moves, one control period after the other (paper, section II-E).

The only loop of its kind: a simulated arm, an exact point and a recorded path differ in what carries out a velocity,
which is the argument ``advance``. A loop that is not ours to run, e.g. that of an arm in real time, calls
`Policy.step` itself.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from signimit.policies.base import CONTROL_PERIOD, Array, Policy, as_policy, check_hand

Advance = Callable[[Array, Array], Array | None]
"""Hands and their velocities, m and m/s, to the hands one control period later, or None where the motion ends."""


def move_exactly(hands: Array, velocities: Array) -> Array:
    """Return points that did as they were told for one control period, shape of ``hands``, m."""
    moved: Array = hands + CONTROL_PERIOD * velocities
    return moved


def count_steps(seconds: float) -> int:
    """Return the number of control periods in a time, to the nearest."""
    return round(seconds / CONTROL_PERIOD)


def run_policy(
    policy: Policy | Callable[[Array], ArrayLike], hands: ArrayLike, seconds: float, advance: Advance = move_exactly
) -> Array:
    """Let a policy move hands, all at once.

    Args:
        policy: A policy, or what `as_policy` makes one of, e.g. a function of hand positions.
        hands: Where the hands start, shape (2,) or (B, 2), m, in the policy's frame.
        seconds: How long.
        advance: What carries out the velocities of one control period: hands, m, and velocities, m/s, to where the
            hands then are, or to None to end early. Without it hands are points that do exactly as they are told.

    Returns:
        Where the hands were at the start and after every control period, shape (T + 1, 2) or (T + 1, B, 2), m.

    Raises:
        InvalidInputError: If a hand is not a finite position, or the policy is none.
    """
    mover = as_policy(policy)
    path, state = [np.array(check_hand(hands))], mover.start()
    for _ in range(count_steps(seconds)):
        state, velocities = mover.step(state, path[-1])
        moved = advance(path[-1], velocities)
        if moved is None:
            break
        path.append(moved)
    return np.array(path)
