"""Reproductions on many simulated arms at once, one control step of all arms at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, Policy, run_policy
from signimit.display import one_line
from signimit.validation import finite_array, item_list
from signimit_envs.arm.batch.inverse_kinematics import ManyHandsController
from signimit_envs.arm.batch.physics import ManyArms, QuietLog, compile_arm
from signimit_envs.arm.batch.policy_batch import PolicyBatch
from signimit_envs.arm.scene import CONTROL_RATE, MAX_HAND_SPEED, WORKSPACE, hand_action

Array = NDArray[np.float64]

MAX_SECONDS = 3600.0  # s, of a reproduction; a longer one is a mistake in the unit


@one_line
class HandTracks(NamedTuple):
    """Reproductions of B hands.

    Attributes:
        paths: Positions of the hands at the start and after every control step, shape (B, T + 1, 2), m, table frame.
        commanded: Position that each control step was to take a hand to, shape (B, T, 2), m.
        joints: Joint angles at the times of the paths, shape (B, T + 1, 3), rad.
        steps: Number of control steps that each hand did, shape (B,): T, or fewer where the physics failed; from then
            on the hand rests.
    """

    paths: Array
    commanded: Array
    joints: Array
    steps: NDArray[np.int64]


def reproduce_many(
    policies: Sequence[Policy | Callable[[Array], ArrayLike]], hands: ArrayLike, seconds: float, threads: int = 0
) -> HandTracks:
    """Let policies move many simulated hands, each on a table of its own.

    The paths are those of `signimit_envs.reproduce`, which asks mink for one arm at a time, to within 0.5 mm; only a
    policy that magnifies the last digit, as gmr and ilo-gmr do, may part them, and parts hands that start 1e-12 m
    beside each other as far. A reproduction does not depend on the others, and the same call gives the same bits. No
    objects are simulated: the policies know their positions.

    Args:
        policies: One a reproduction, hands (G, 2), m, table frame, to velocities (G, 2), m/s. What `signimit` learns is
            such, with and without a state. One that several reproductions share is called for all of them at once.
        hands: Start positions of the hands, shape (B, 2), m.
        seconds: Duration, s.
        threads: Number of threads that compute the physics, 0 for one a processor; the result does not depend on it.

    Raises:
        InvalidInputError: If there are not as many hands as policies, a hand is out of reach, or a policy commands
            what is not finite or not one velocity a hand.
    """
    movers = item_list(policies, "policies")
    starts = _checked_hands(hands, len(movers))
    if not 0.0 <= seconds <= MAX_SECONDS:  # a comparison with NaN is false
        raise InvalidInputError("seconds", f"0 to {MAX_SECONDS:g}", f"{seconds}")
    if threads < 0:
        raise InvalidInputError("threads", "0 or more", f"{threads}")
    model, batch = compile_arm(), PolicyBatch(movers)
    controller = ManyHandsController(model)
    arms = ManyArms(model, controller.postures_at(starts.T)[0], threads)
    commanded: list[Array] = []
    joints, steps = [arms.joints], np.zeros(len(movers), dtype=np.int64)

    def step_arms(here: Array, velocities: Array) -> Array:
        ahead = hand_action(velocities) * (MAX_HAND_SPEED / CONTROL_RATE)
        commanded.append(here + ahead)
        moved, sound = arms.simulate(controller.solve(joints[-1], ahead.T, 1.0 / CONTROL_RATE).velocities)
        steps[sound] += 1
        joints.append(moved)
        return np.ascontiguousarray(controller.arm.hands(moved).T)

    with QuietLog():
        path = run_policy(batch, np.ascontiguousarray(controller.arm.hands(joints[0]).T), seconds, step_arms)
    return HandTracks(
        paths=np.ascontiguousarray(path.swapaxes(0, 1)),
        commanded=np.ascontiguousarray(np.reshape(commanded, (-1, len(movers), 2)).swapaxes(0, 1)),
        joints=np.ascontiguousarray(np.transpose(joints, (2, 0, 1))),
        steps=steps,
    )


def _checked_hands(value: ArrayLike, count: int) -> Array:
    """Return start positions of hands, shape (``count``, 2), m, that lie in the workspace."""
    hands = finite_array(value, "hands", (count, 2))
    outside = np.flatnonzero((np.abs(hands) > WORKSPACE + 1e-9).any(axis=1))
    if len(outside):
        x, y = hands[outside[0]]
        area = f"positions with |x| <= {WORKSPACE[0]:g} m and |y| <= {WORKSPACE[1]:g} m"
        raise InvalidInputError(f"hands: reproduction {outside[0]}", area, f"({x:g}, {y:g})")
    return hands
