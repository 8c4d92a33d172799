"""The simulated arm: its state and its control steps."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.scene import CONTROL_RATE, SUBSTEPS, object_bodies

_DT = 1.0 / CONTROL_RATE  # s
BLOW_UP = "the physics blew up; the arm was put back where it was before this step"


class Arm:
    """Simulated planar arm whose three joints track velocities, over a table with objects that do not move.

    Attributes:
        model: The compiled scene.
        data: The state of the simulation.
        object_bodies: Mocap numbers of the objects, O of them.
        hand: Position of the hand, shape (2,), m, table frame; a view that follows the simulation.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        """Start the simulation of a scene that `compile_scene` made."""
        self.model, self.data = model, mujoco.MjData(model)
        self.object_bodies = object_bodies(model)
        self._site = model.site("hand").id
        self._jacobian = np.zeros((3, model.nv))
        self._ranges = model.jnt_range.tolist()
        self._take_views()
        # MuJoCo logs only the first warning of a kind. It is made to think that it has, since the arm itself says what
        # went wrong; when the physics blows up, MuJoCo resets the data and with them these numbers.
        self._already_logged = [1] * len(self._warnings)
        self._objects = np.zeros((len(self.object_bodies), 2))
        self._last_joints: list[float] = self._qpos.tolist()

    def _take_views(self) -> None:
        """Take live views: to fetch them from the data in every control step would cost more than to read them."""
        self.hand = self.data.site_xpos[self._site, :2]
        self._qpos, self._qvel, self._ctrl = self.data.qpos, self.data.qvel, self.data.ctrl
        self._warnings = self.data.warning.number
        self._planar_jacobian = self._jacobian[:2]

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Become a copy: what copying made of the views are arrays that follow nothing."""
        self.__dict__.update(state)
        self._take_views()

    def place(self, objects: NDArray[np.float64], joints: NDArray[np.float64]) -> None:
        """Put objects at positions, shape (O, 2), m, and the arm, at rest, to joint angles, shape (3,), rad."""
        self._objects, self._last_joints = objects, joints.tolist()
        self._reset()

    def track(self, velocities: NDArray[np.float64]) -> str:
        """Track joint velocities, shape (3,), rad/s, for one control step, stopping at the joints' limits.

        Returns:
            `BLOW_UP` if the physics failed, and the arm is back where it was before the step; else an empty string.
        """
        self._ctrl[:] = velocities
        # Few joints are at a limit: to look at each as a number is faster than to clip them all as arrays.
        targets = zip(velocities.tolist(), self._qpos.tolist(), self._ranges, strict=True)
        for number, (velocity, joint, (low, high)) in enumerate(targets):
            if not low <= joint + velocity * _DT <= high:
                self._ctrl[number] = min(max(velocity, (low - joint) * CONTROL_RATE), (high - joint) * CONTROL_RATE)
        mujoco.mj_step(self.model, self.data, SUBSTEPS)
        if self._warnings.tolist() != self._already_logged:
            self._reset()
            return BLOW_UP
        # What mj_step leaves behind was computed before its last integration.
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        self._last_joints = self._qpos.tolist()
        return ""

    def measure(self) -> dict[str, NDArray[np.float64]]:
        """Return copies of hand (2,), m, hand_velocity (2,), joints (3,), rad, and joint_velocities (3,)."""
        mujoco.mj_jacSite(self.model, self.data, self._jacobian, None, self._site)
        return {
            "hand": self.hand.copy(),
            "hand_velocity": self._planar_jacobian.dot(self._qvel),
            "joints": self._qpos.copy(),
            "joint_velocities": self._qvel.copy(),
        }

    def _reset(self) -> None:
        """Put objects and resting arm back to where they were last."""
        mujoco.mj_resetData(self.model, self.data)
        self._warnings[:] = self._already_logged
        self.data.qpos[:] = self._last_joints
        self.data.mocap_pos[self.object_bodies, :2] = self._objects
        mujoco.mj_forward(self.model, self.data)
