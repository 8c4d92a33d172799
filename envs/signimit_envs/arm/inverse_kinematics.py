"""Differential inverse kinematics by mink: hand velocities to joint velocities (paper, section II-F)."""

from __future__ import annotations

from typing import NamedTuple

import mink
import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.scene import (
    MAX_JOINT_SPEED,
    POSTURE_COST,
    POSTURE_ITERATIONS,
    POSTURE_STRIDE,
    POSTURE_TOLERANCE,
    home_posture,
)

_SOLVER = "daqp"  # of qpsolvers: exact for problems of three unknowns, and installed with mink


class JointCommand(NamedTuple):
    """Joint velocities, and the displacement of the hand that they miss.

    Attributes:
        velocities: Joint velocities, shape (3,), rad/s.
        residual: Length of the part of the wanted displacement that they miss, m.
    """

    velocities: NDArray[np.float64]
    residual: float


class HandController:
    """Hand controller: solves for joint velocities that move the hand, within the limits of joints and drives.

    The target is one control step ahead of the actual hand: a step that is over in one step needs no gain, and a
    target so near keeps its direction when a velocity limit binds.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        """Set up tasks and limits for the arm of the scene."""
        self._model = model
        self._configuration = mink.Configuration(model)
        self._data = self._configuration.data
        self._site = model.site("hand").id
        self._jacobian = np.zeros((3, model.nv))
        self._lower, self._upper = model.jnt_range.T.copy()
        self._hand = mink.FrameTask("hand", "site", position_cost=1.0, orientation_cost=0.0)
        self._posture = mink.PostureTask(model, cost=POSTURE_COST)
        self._posture.set_target(home_posture(model))
        self._tasks = [self._hand, self._posture]
        speeds = {model.joint(joint).name: MAX_JOINT_SPEED for joint in range(model.njnt)}
        self._limits = [mink.ConfigurationLimit(model), mink.VelocityLimit(model, speeds)]

    def solve(self, joints: NDArray[np.float64], displacement: NDArray[np.float64], dt: float) -> JointCommand:
        """Find joint velocities that displace the hand.

        Args:
            joints: Joint angles, shape (3,), rad; brought into their ranges first.
            displacement: Wanted displacement of the hand, shape (2,), m, table frame.
            dt: Time for it, s.

        Returns:
            The joint command; beyond the arm's limits the nearest feasible one, with a residual above 0.
        """
        self._configuration.update(np.minimum(np.maximum(joints, self._lower), self._upper))
        pose = self._configuration.get_transform_frame_to_world("hand", "site").wxyz_xyz.copy()
        pose[4:6] += displacement
        self._hand.set_target(mink.SE3(pose))
        try:
            velocities = mink.solve_ik(self._configuration, self._tasks, dt, _SOLVER, limits=self._limits)
        except mink.NoSolutionFound:
            velocities = np.zeros(self._model.nv)
        mujoco.mj_jacSite(self._model, self._data, self._jacobian, None, self._site)
        left = displacement - self._jacobian[:2] @ velocities * dt
        return JointCommand(velocities, float(np.sqrt(left @ left)))

    def posture_at(self, hand: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
        """Find joint angles that put the hand at a position, near the arm's home posture.

        Args:
            hand: Position, shape (2,), m, table frame.

        Returns:
            Joint angles, shape (3,), rad, and the remaining distance of the hand from the position, m.
        """
        joints = home_posture(self._model)
        for _ in range(POSTURE_ITERATIONS):
            self._configuration.update(joints)
            away = hand - self._data.site_xpos[self._site][:2]
            # A second a step is time enough for any drive.
            stride = away * min(1.0, POSTURE_STRIDE / max(1e-12, float(np.hypot(*away))))
            change = self.solve(joints, stride, 1.0).velocities
            joints = joints + change
            if np.abs(change).max() < POSTURE_TOLERANCE:
                break
        self._configuration.update(joints)
        return joints, float(np.hypot(*(hand - self._data.site_xpos[self._site][:2])))
