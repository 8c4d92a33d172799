"""From hand velocities to joint velocities, for many arms at once: what mink solves, in closed form."""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.batch.box_least_squares import LeastSquares, solve_box
from signimit_envs.arm.batch.planar_arm import PlanarArm
from signimit_envs.arm.scene import MAX_JOINT_SPEED, POSTURE_COST

Array = NDArray[np.float64]

_DAMPING = 1e-12  # mink's, of all joints
_GAIN = 0.95  # mink's: of the way to a joint's limit that is allowed in one step
_STRIDE = 0.05  # m at most in one step towards a posture: the arm is far from linear over more
_STRIDES, _STILL = 60, 1e-9  # steps at most; rad, a step in which no joint moves more is the last


class JointCommands(NamedTuple):
    """What the joints of B arms should do.

    Attributes:
        velocities: Joint velocities, shape (n, B), rad/s.
        residuals: How much of the wanted displacements of the hands they leave undone, shape (B,), m.
    """

    velocities: Array
    residuals: Array


class ManyHandsController:
    """Solves for joint velocities that move many hands, within the limits of joints and drives.

    Every arm has the problem that `signimit_envs.arm.inverse_kinematics.HandController` gives to mink: its hand's
    displacement and, at a small cost, its posture. What an arm is told does not depend on the others, to
    the last bit. Arrays have their components first and the B arms last.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        """Read the arm of the scene."""
        self.arm = PlanarArm.from_model(model)

    def solve(self, joints: Array, displacements: Array, dt: float) -> JointCommands:
        """Find joint velocities that displace the hands.

        Args:
            joints: Joint angles, shape (n, B), rad; brought into their ranges first.
            displacements: Wanted displacements of the hands, shape (2, B), m, table frame.
            dt: Time for them, s.

        Returns:
            The commands; where an arm cannot do it all, the nearest it can, with a residual above 0.
        """
        arm = self.arm
        inside = joints.clip(arm.lower, arm.upper)
        reaches = arm.reaches(inside)
        fastest = MAX_JOINT_SPEED * dt
        problem = LeastSquares(
            jacobian=np.stack([-reaches[1], reaches[0]]),
            wanted=displacements,
            preferred=(arm.home - inside) * (POSTURE_COST**2 / (POSTURE_COST**2 + _DAMPING)),
            damping=POSTURE_COST**2 + _DAMPING,
            lower=np.maximum(_GAIN * (arm.lower - inside), -fastest),
            upper=np.minimum(_GAIN * (arm.upper - inside), fastest),
        )
        turns = solve_box(problem)
        left_x = displacements[0] + (reaches[1] * turns).sum(axis=0)
        left_y = displacements[1] - (reaches[0] * turns).sum(axis=0)
        return JointCommands(turns / dt, np.sqrt(left_x * left_x + left_y * left_y))

    def postures_at(self, hands: Array) -> tuple[Array, Array]:
        """Find the joint angles that put hands somewhere, in the arm's usual posture.

        Args:
            hands: Positions, shape (2, B), m, table frame.

        Returns:
            Joint angles, shape (n, B), rad, and the distances that are left, shape (B,), m.
        """
        joints = np.repeat(self.arm.home, hands.shape[1], axis=1)
        moving = np.arange(hands.shape[1])
        for _ in range(_STRIDES):
            away = hands[:, moving] - self.arm.hands(joints[:, moving])
            strides = away * np.minimum(1.0, _STRIDE / np.maximum(np.hypot(*away), 1e-12))
            turns = self.solve(joints[:, moving], strides, 1.0).velocities
            joints[:, moving] += turns
            moving = moving[np.abs(turns).max(axis=0) >= _STILL]
            if not len(moving):
                break
        return joints, np.hypot(*(hands - self.arm.hands(joints)))
