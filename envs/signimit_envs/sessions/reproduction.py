"""A learned policy on the simulated arm: what it commands and where the hand goes (paper, section II-E)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError
from signimit_envs.arm.scene import CONTROL_RATE, MAX_HAND_SPEED
from signimit_envs.tabletop.env import TabletopEnv

Policy = Callable[[NDArray[np.float64]], ArrayLike]


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
    policy: Policy,
    objects: ArrayLike,
    hand: ArrayLike,
    seconds: float,
    each_step: Callable[[], object] | None = None,
) -> HandTrack:
    """Let a policy move the simulated hand.

    Args:
        env: ``signimit/TabletopHand-v0``, or another with ``control="hand"``, wrapped or not; it is reset, and not
            closed.
        policy: Hand position (2,), m, to hand velocity (2,), m/s. One that keeps a state has ``start() -> state`` and
            ``step(state, hand) -> (state, velocity)``, and these are used.
        objects: Where to put the objects, shape (O, 2), m.
        hand: Where to put the hand, shape (2,), m.
        seconds: How long to go on; cut short by a physics error only.
        each_step: Called after the reset and after every control step, e.g. to draw a frame.

    Raises:
        InvalidInputError: If the environment is another one, the scene cannot be, or the policy commands what is not
            finite or not a velocity.
    """
    arm = env.unwrapped
    if not isinstance(arm, TabletopEnv) or arm.control != "hand":
        found = f"control={arm.control!r}" if isinstance(arm, TabletopEnv) else type(arm).__name__
        raise InvalidInputError("environment", "signimit/TabletopHand-v0, or control='hand'", found)
    arm.reset(options={"objects": objects, "hand": hand})
    move = hand_velocities(policy)
    path, commanded = [arm.hand], []
    for _ in range(round(seconds * CONTROL_RATE)):
        if each_step is not None:
            each_step()
        action = hand_action(move(path[-1]))
        terminated = arm.step(action)[2]
        if terminated:
            break
        commanded.append(path[-1] + action * (MAX_HAND_SPEED / CONTROL_RATE))
        path.append(arm.hand)
    if each_step is not None:
        each_step()
    return HandTrack(np.array(path), np.array(commanded).reshape(-1, 2))


def hand_action(velocity: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the actions with ``control="hand"`` for velocities of hands, both of shape (..., 2), m/s.

    A velocity beyond the arm's is slowed down as a whole, so that its direction stays.

    Raises:
        InvalidInputError: If they are of another shape.
    """
    if velocity.shape[-1:] != (2,):
        raise InvalidInputError("policy", "velocities along x and y", f"shape {velocity.shape}")
    action: NDArray[np.float64] = velocity / np.maximum(MAX_HAND_SPEED, np.abs(velocity).max(axis=-1, keepdims=True))
    return action


def hand_velocities(policy: Any) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    """Give policies with and without a state one face: hand (2,), m, to velocity (2,), m/s, from one call to the next.

    Args:
        policy: One that keeps a state has ``start() -> state`` and ``step(state, hand) -> (state, velocity)``.
    """
    if not (hasattr(policy, "start") and hasattr(policy, "step")):
        return lambda hand: np.asarray(policy(hand), dtype=np.float64)
    state = policy.start()

    def move(hand: NDArray[np.float64]) -> NDArray[np.float64]:
        nonlocal state
        state, velocity = policy.step(state, hand)
        return np.asarray(velocity, dtype=np.float64)

    return move
