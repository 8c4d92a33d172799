"""The planar arm is where MuJoCo says that it is."""

from __future__ import annotations

import mujoco
import numpy as np

from signimit_envs.arm.batch.planar_arm import PlanarArm
from signimit_envs.arm.scene import compile_scene


def test_hands_and_ways_from_the_joints_are_those_of_mujoco() -> None:
    model = compile_scene()
    data, arm = mujoco.MjData(model), PlanarArm.from_model(model)
    site, jacobian = model.site("hand").id, np.zeros((3, 3))
    joints = np.random.default_rng(0).uniform(-np.pi, np.pi, (3, 200))
    hands, reaches = arm.hands(joints), arm.reaches(joints)
    for b in range(joints.shape[1]):
        data.qpos[:] = joints[:, b]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_jacSite(model, data, jacobian, None, site)
        np.testing.assert_allclose(hands[:, b], data.site_xpos[site, :2], atol=1e-14)
        np.testing.assert_allclose([-reaches[1, :, b], reaches[0, :, b]], jacobian[:2], atol=1e-14)


def test_ranges_and_home_are_those_of_the_scene() -> None:
    model = compile_scene()
    arm = PlanarArm.from_model(model)
    np.testing.assert_array_equal(np.hstack([arm.lower, arm.upper]), model.jnt_range)
    np.testing.assert_array_equal(arm.home[:, 0], model.key("home").qpos)
