"""A learned policy on the simulated arm: what it commands and where the hand goes (paper, section II-E)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, Policy, run_policy
from signimit.display import one_line
from signimit_envs.arm.scene import CONTROL_RATE, MAX_HAND_SPEED, hand_action
from signimit_envs.tabletop.env import TabletopEnv


@one_line
class HandTrack(NamedTuple):
    """How the hand moved.

    Attributes:
        path: Where it was at the start and after every control step, shape (T + 1, 2), m, table frame.
        commanded: Where each control step was to take it from where it was, shape (T, 2), m.
    """

    path: NDArray[np.float64]
    commanded: NDArray[np.float64]


def reproduce(
    env: gym.Env[Any, Any],
    policy: Policy | Callable[[NDArray[np.float64]], ArrayLike],
    objects: ArrayLike,
    hand: ArrayLike,
    seconds: float,
    each_step: Callable[[], object] | None = None,
) -> HandTrack:
    """Let a policy move the simulated hand.

    Args:
        env: ``signimit/TabletopHand-v0``, or another with ``control="hand"``, wrapped or not; it is reset, and not
            closed.
        policy: A policy, or a function of the hand's position (2,), m, that returns its velocity (2,), m/s. Of an
            object that has ``start() -> state`` and ``step(state, hand) -> (state, velocity)`` these are used.
        objects: Where to put the objects, shape (O, 2), m.
        hand: Where to put the hand, shape (2,), m.
        seconds: How long to go on; cut short by a physics error only.
        each_step: Called after the reset and after every control step, e.g. to draw a frame.

    Raises:
        InvalidInputError: If the environment is another one, the scene cannot be, or the policy commands what is not
            finite or not a velocity.
    """
    arm = hand_controlled(env)
    arm.reset(options={"objects": objects, "hand": hand})
    if each_step is not None:
        each_step()
    commanded: list[NDArray[np.float64]] = []

    def step_arm(here: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64] | None:
        action = hand_action(velocity)
        terminated = arm.step(action)[2]
        if each_step is not None:
            each_step()
        if terminated:
            return None
        commanded.append(here + action * (MAX_HAND_SPEED / CONTROL_RATE))
        return arm.hand

    path = run_policy(policy, arm.hand, seconds, step_arm)
    return HandTrack(path, np.array(commanded).reshape(-1, 2))


def hand_controlled(env: gym.Env[Any, Any]) -> TabletopEnv:
    """Return the environment behind all wrappers, whose actions are velocities of the hand.

    Raises:
        InvalidInputError: If it is another one.
    """
    arm = env.unwrapped
    if not isinstance(arm, TabletopEnv) or arm.control != "hand":
        found = f"control={arm.control!r}" if isinstance(arm, TabletopEnv) else type(arm).__name__
        raise InvalidInputError("environment", "signimit/TabletopHand-v0, or control='hand'", found)
    return arm
