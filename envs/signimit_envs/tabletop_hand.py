"""`signimit/TabletopHand-v0`: signs to obey with the hand of a planar arm; its joints follow."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from signimit_envs.hand_control import JointCommand
from signimit_envs.scene import CONTROL_RATE
from signimit_envs.tabletop import TabletopEnv


class TabletopHandEnv(TabletopEnv):
    """Obey two signs with hand velocities; everything but the action is as in `TabletopEnv`.

    Action space:
        ``Box(-1, 1, (2,), float32)``: velocity of the hand along x and y, in units of `max_hand_speed`, for 1/50 s.
        mink solves for the joints, one control step ahead of the actual hand, within the limits of joints and drives.
        Beyond its reach the hand goes as far as it can, and ``info["ik_residual"]`` says how much of the displacement
        is missing, m.

    Version history:
        v0: first version.
    """

    _action_size: ClassVar[int] = 2
    max_hand_speed: ClassVar[float] = 1.2
    """Speed in m/s along each axis that an action of 1 stands for."""

    def _command(self, action: NDArray[np.float64]) -> JointCommand:
        dt = 1.0 / CONTROL_RATE
        return self.controller.solve(self.data.qpos, action * (self.max_hand_speed * dt), dt)
