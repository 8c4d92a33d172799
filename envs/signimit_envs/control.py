"""What an action means: each control turns actions in [-1, 1] into velocities of the joints."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from signimit import UnknownNameError
from signimit_envs.hand_control import HandController, JointCommand
from signimit_envs.scene import CONTROL_RATE, MAX_JOINT_SPEED

MAX_HAND_SPEED = 1.2
"""Speed of the hand in m/s along each axis that an action of 1 stands for."""


class Control(Protocol):
    """How an arm is commanded.

    Attributes:
        size: Number of elements of an action.
    """

    size: int

    def command(self, action: NDArray[np.float64], joints: NDArray[np.float64]) -> JointCommand:
        """Turn an action, shape (size,), in [-1, 1], at joint angles, shape (3,), rad, into joint velocities."""
        ...


class JointControl:
    """Velocities of shoulder, elbow and wrist, in units of 3.5 rad/s."""

    size = 3

    def __init__(self, controller: HandController) -> None:
        """Command the joints themselves; no inverse kinematics are needed."""
        self._speeds = np.full(self.size, MAX_JOINT_SPEED)

    def command(self, action: NDArray[np.float64], joints: NDArray[np.float64]) -> JointCommand:
        """Scale the action."""
        return JointCommand(np.multiply(action, self._speeds), 0.0)


class HandControl:
    """Velocity of the hand along x and y, in units of 1.2 m/s; mink solves for the joints."""

    size = 2

    def __init__(self, controller: HandController) -> None:
        """Solve with a controller."""
        self._controller = controller
        self._dt = 1.0 / CONTROL_RATE

    def command(self, action: NDArray[np.float64], joints: NDArray[np.float64]) -> JointCommand:
        """Solve for joint velocities that displace the hand for one control step."""
        return self._controller.solve(joints, action * (MAX_HAND_SPEED * self._dt), self._dt)


CONTROLS: Mapping[str, Callable[[HandController], Control]] = {"hand": HandControl, "joint": JointControl}


def make_control(name: str, controller: HandController) -> Control:
    """Return a control by its name.

    Raises:
        UnknownNameError: If there is none of that name.
    """
    if name not in CONTROLS:
        raise UnknownNameError("control", name, CONTROLS)
    return CONTROLS[name](controller)
