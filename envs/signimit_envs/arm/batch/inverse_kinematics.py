"""Differential inverse kinematics of many arms at once: the problem that mink solves for one, in closed form."""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.batch.box_least_squares import LeastSquares, solve_box
from signimit_envs.arm.batch.planar_arm import PlanarArm
from signimit_envs.arm.scene import (
    MAX_JOINT_SPEED,
    POSTURE_COST,
    POSTURE_ITERATIONS,
    POSTURE_STRIDE,
    POSTURE_TOLERANCE,
)

Array = NDArray[np.float64]

_DAMPING = 1e-12  # of all joints; default of mink.solve_ik
_GAIN = 0.95  # share of the way to a joint's limit that one step may take; default of mink.ConfigurationLimit


class JointCommands(NamedTuple):
    """Joint velocities of B arms, and the displacements of the hands that they miss.

    Attributes:
        velocities: Joint velocities, shape (n, B), rad/s.
        residuals: Lengths of the parts of the wanted displacements that they miss, shape (B,), m.
    """

    velocities: Array
    residuals: Array


class ManyHandsController:
    """Controller of many hands: joint velocities that move them, within the limits of joints and drives.

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
            The joint commands; beyond an arm's limits the nearest feasible one, with a residual above 0.
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
        """Find joint angles that put hands at positions, near the arm's home posture.

        Args:
            hands: Positions, shape (2, B), m, table frame.

        Returns:
            Joint angles, shape (n, B), rad, and the remaining distances of the hands from the positions, shape (B,), m.
        """
        joints = np.repeat(self.arm.home, hands.shape[1], axis=1)
        moving = np.arange(hands.shape[1])
        for _ in range(POSTURE_ITERATIONS):
            away = hands[:, moving] - self.arm.hands(joints[:, moving])
            strides = away * np.minimum(1.0, POSTURE_STRIDE / np.maximum(np.hypot(*away), 1e-12))
            turns = self.solve(joints[:, moving], strides, 1.0).velocities
            joints[:, moving] += turns
            moving = moving[np.abs(turns).max(axis=0) >= POSTURE_TOLERANCE]
            if not len(moving):
                break
        return joints, np.hypot(*(hands - self.arm.hands(joints)))
