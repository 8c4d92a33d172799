"""Actions: joint control and hand control of the arm."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit_envs.arm.inverse_kinematics import HandController, JointCommand
from signimit_envs.arm.scene import CONTROL_RATE, MAX_HAND_SPEED, MAX_JOINT_SPEED


class Control(Protocol):
    """Control mode: turns actions in [-1, 1] into joint velocities.

    Attributes:
        size: Number of elements of an action.
    """

    size: int

    def command(self, action: NDArray[np.float64], joints: NDArray[np.float64]) -> JointCommand:
        """Turn an action, shape (size,), in [-1, 1], at joint angles, shape (3,), rad, into joint velocities."""
        ...


class JointControl:
    """Joint control: velocities of shoulder, elbow and wrist, in units of `MAX_JOINT_SPEED`."""

    size = 3

    def __init__(self, controller: HandController) -> None:
        """Take no notice of the controller: joints are commanded as they are."""
        self._speeds = np.full(self.size, MAX_JOINT_SPEED)

    def command(self, action: NDArray[np.float64], joints: NDArray[np.float64]) -> JointCommand:
        """Scale the action."""
        return JointCommand(np.multiply(action, self._speeds), 0.0)


class HandControl:
    """Hand control: velocity along x and y in units of `MAX_HAND_SPEED`; mink solves for the joints."""

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
    """Return a control mode by its name in `CONTROLS`.

    Raises:
        UnknownNameError: If there is no control mode of that name.
    """
    if name not in CONTROLS:
        raise UnknownNameError("control", name, CONTROLS)
    return CONTROLS[name](controller)


def checked_action(action: ArrayLike, size: int) -> NDArray[np.float64]:
    """Return an action as an array of shape (size,), clipped to [-1, 1].

    Raises:
        InvalidInputError: If it has another shape or is not finite.
    """
    try:
        values = np.asarray(action, dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != (size,):
        raise InvalidInputError("action", f"{size} numbers in [-1, 1]", repr(action))
    if all(-1.0 <= value <= 1.0 for value in values.tolist()):  # false for NaN; so few numbers are fastest in a loop
        return values
    if not np.isfinite(values).all():
        raise InvalidInputError("action", f"{size} finite numbers in [-1, 1]", repr(values))
    return values.clip(-1.0, 1.0)
