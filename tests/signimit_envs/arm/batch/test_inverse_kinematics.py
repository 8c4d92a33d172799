"""All arms at once are told what mink tells each of them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit_envs.arm.batch.inverse_kinematics import ManyHandsController
from signimit_envs.arm.inverse_kinematics import HandController
from signimit_envs.arm.scene import MAX_JOINT_SPEED, WORKSPACE, compile_scene

DT = 0.02
Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def mink() -> HandController:
    return HandController(compile_scene())


@pytest.fixture(scope="module")
def many() -> ManyHandsController:
    return ManyHandsController(compile_scene())


def joints_of(where: str, count: int) -> Array:
    """Joint angles anywhere in their ranges, or with most of them at a limit or a little beyond."""
    rng, (lower, upper) = np.random.default_rng(0), compile_scene().jnt_range.T
    inside = rng.uniform(lower, upper, (count, 3))
    if where == "inside":
        return inside.T.copy()
    limits = np.where(rng.random((count, 3)) < 0.5, lower, upper) + rng.normal(0, 0.02, (count, 3))
    return np.where(rng.random((count, 3)) < 0.6, limits, inside).T.copy()


@pytest.mark.parametrize("where", ["inside", "at the limits"])
@pytest.mark.parametrize("stride", [0.004, 0.024, 0.3])
def test_joint_velocities_are_those_of_mink(
    mink: HandController, many: ManyHandsController, where: str, stride: float
) -> None:
    """Strides of a drawing, of the fastest action, and far beyond the drives, so that every limit binds somewhere."""
    joints = joints_of(where, 400)
    displacements = np.random.default_rng(1).normal(0.0, stride, (2, 400))
    velocities, residuals = many.solve(joints, displacements, DT)
    each = [mink.solve(q, d, DT) for q, d in zip(joints.T, displacements.T, strict=True)]
    np.testing.assert_allclose(velocities.T, [command.velocities for command in each], atol=1e-5)
    np.testing.assert_allclose(residuals, [command.residual for command in each], atol=1e-9)


def test_limits_bind_in_what_is_compared(many: ManyHandsController) -> None:
    joints = joints_of("at the limits", 400)
    velocities, _ = many.solve(joints, np.random.default_rng(1).normal(0.0, 0.024, (2, 400)), DT)
    room = 0.95 * np.stack([many.arm.lower - joints, many.arm.upper - joints])
    at_range = (np.abs(velocities * DT - room) < 1e-12).any(axis=(0, 1))
    at_speed = (np.abs(np.abs(velocities) - MAX_JOINT_SPEED) < 1e-9).any(axis=0)
    assert at_range.sum() > 100
    assert at_speed.sum() > 100
    assert (np.abs(velocities) <= MAX_JOINT_SPEED + 1e-9).all()


def test_hands_are_put_where_mink_puts_them_in_the_same_posture(
    mink: HandController, many: ManyHandsController
) -> None:
    corners = np.array([[x, y] for x in (-1, 0, 1) for y in (-1, 0, 1)]) * WORKSPACE
    hands = np.vstack([corners, np.random.default_rng(2).uniform(-WORKSPACE, WORKSPACE, (11, 2))])
    joints, away = many.postures_at(hands.T.copy())
    assert away.max() < 1e-6
    np.testing.assert_allclose(joints.T, [mink.posture_at(hand)[0] for hand in hands], atol=1e-6)


def test_an_arm_is_told_the_same_whatever_the_others_do(many: ManyHandsController) -> None:
    joints, ahead = joints_of("at the limits", 100), np.random.default_rng(3).normal(0.0, 0.02, (2, 100))
    together = many.solve(joints, ahead, DT)
    for chosen in ([13], [5, 99], list(range(99, -1, -1))):
        some = many.solve(joints[:, chosen], ahead[:, chosen], DT)
        np.testing.assert_array_equal(some.velocities, together.velocities[:, chosen])
        np.testing.assert_array_equal(some.residuals, together.residuals[chosen])
