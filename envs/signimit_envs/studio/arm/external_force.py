"""A push against the hand: a force that makes it drift although the drives hold against it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.scene import CONTROL_RATE

PUSH_SECONDS = 0.25
FASTEST = 1.0  # m/s, drift; more is cut to it
_SHARE = 0.9  # of what a drive can hold against; beyond it the arm would be thrown, not pushed


@dataclass(frozen=True, eq=False)
class Push:
    """A push that still lasts a while.

    Attributes:
        velocity: With what velocity the hand drifts, about, shape (2,), m/s.
        steps: Control steps that it still lasts.
    """

    velocity: NDArray[np.float64]
    steps: int = round(PUSH_SECONDS * CONTROL_RATE)

    def apply(self, model: mujoco.MjModel, data: mujoco.MjData) -> Push | None:
        """Set the force for the next control step, and return what is left of the push; none if it is over.

        A velocity drive resists like a damper, so the force that makes the hand drift with velocity v is
        (J K⁻¹ Jᵀ)⁻¹ v with the drives' gains K.
        """
        if self.steps <= 0:
            data.qfrc_applied[:] = 0.0
            return None
        jacobian = np.zeros((3, model.nv))
        mujoco.mj_jacSite(model, data, jacobian, None, model.site("hand").id)
        planar, gains = jacobian[:2], model.actuator_gainprm[:, 0]
        mobility = planar / gains @ planar.T + 1e-6 * np.eye(2)
        drift = self.velocity * min(1.0, FASTEST / max(1e-9, float(np.hypot(*self.velocity))))
        torques = planar.T @ np.linalg.solve(mobility, drift)
        most = _SHARE * model.actuator_forcerange[:, 1]
        data.qfrc_applied[:] = torques * min(1.0, float((most / np.maximum(np.abs(torques), 1e-9)).min()))
        return replace(self, steps=self.steps - 1)
