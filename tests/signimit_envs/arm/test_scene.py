"""The scene compiles, from wherever it is installed, and the arm reaches what it must."""

from typing import Any

import mujoco
import numpy as np
import pytest

import signimit
from signimit.benchmark.running import FASTEST
from signimit.names import object_name
from signimit.policies import CONTROL_PERIOD
from signimit_envs.arm.inverse_kinematics import HandController
from signimit_envs.arm.scene import (
    CONTROL_RATE,
    MAX_HAND_SPEED,
    OBJECT_COUNTS,
    OBJECT_NAMES,
    SUBSTEPS,
    WORKSPACE,
    compile_scene,
    object_bodies,
)


@pytest.mark.parametrize("count", OBJECT_COUNTS)
def test_every_number_of_objects_compiles(count: Any) -> None:
    model = compile_scene(count)
    assert model.nmocap == count == len(set(object_bodies(model)))
    assert (model.nq, model.nv, model.nu) == (3, 3, 3)
    assert len(OBJECT_NAMES) >= count


@pytest.mark.parametrize("count", [1, 7, "3", None])
def test_other_numbers_of_objects_are_refused(count: Any) -> None:
    with pytest.raises(signimit.InvalidInputError, match="objects: expected 2 to 6, found"):
        compile_scene(count)


def test_a_control_step_of_the_simulation_takes_the_one_control_period() -> None:
    assert compile_scene().opt.timestep * SUBSTEPS == pytest.approx(CONTROL_PERIOD, abs=1e-15)
    assert 1 / CONTROL_RATE == CONTROL_PERIOD


def test_hands_without_an_arm_are_as_fast_as_those_with_one() -> None:
    assert FASTEST == MAX_HAND_SPEED


def test_names_that_others_rely_on() -> None:
    model = compile_scene()
    assert {model.camera(i).name for i in range(model.ncam)} == {"top", "perspective"}
    assert [model.joint(i).name for i in range(3)] == ["shoulder", "elbow", "wrist"]
    assert model.site("hand").id >= 0


def test_all_joints_turn_about_the_vertical_and_the_table_is_clear_of_the_base() -> None:
    model = compile_scene()
    np.testing.assert_array_equal(model.jnt_axis, np.tile([0.0, 0.0, 1.0], (3, 1)))
    table = model.geom("tabletop")
    assert model.body("base").pos[1] < -table.size[1]


def test_objects_are_below_the_hand() -> None:
    model = compile_scene(6)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    tip = data.site("hand").xpos[2] - 0.013
    of_objects = [g for g in range(model.ngeom) if model.body(model.geom_bodyid[g]).name.startswith("object")]
    tops = [data.geom_xpos[g, 2] + abs(data.geom_xmat[g].reshape(3, 3)[2]) @ model.geom_aabb[g, 3:] for g in of_objects]
    assert len(of_objects) >= 6
    assert max(tops) < tip


def test_the_hand_reaches_the_whole_workspace_with_margin() -> None:
    """On a grid, closed up to the edges: at most 90 % stretched, and at least 0.2 rad from every joint's limit."""
    model = compile_scene()
    data, controller = mujoco.MjData(model), HandController(model)
    low, high = model.jnt_range.T
    length = sum(np.hypot(*model.body(b).pos[:2]) for b in ("forearm", "hand")) + model.site("hand").pos[1]
    for x in np.linspace(-WORKSPACE[0], WORKSPACE[0], 9):
        for y in np.linspace(-WORKSPACE[1], WORKSPACE[1], 9):
            joints, away = controller.posture_at(np.array([x, y]))
            data.qpos[:] = joints
            mujoco.mj_kinematics(model, data)
            np.testing.assert_allclose(data.site("hand").xpos[:2], [x, y], atol=1e-5)
            assert away < 1e-5
            assert np.minimum(joints - low, high - joints).min() > 0.2
            assert np.hypot(*([x, y] - model.body("base").pos[:2])) < 0.9 * length


def test_everywhere_in_the_workspace_the_drives_are_fast_enough_for_the_hand() -> None:
    """1.2 m/s in any direction needs no joint faster than its drive."""
    model = compile_scene()
    data, controller, jacobian = mujoco.MjData(model), HandController(model), np.zeros((3, 3))
    directions = np.array([[np.cos(a), np.sin(a)] for a in np.linspace(0, 2 * np.pi, 24)])
    for x in np.linspace(-WORKSPACE[0], WORKSPACE[0], 7):
        for y in np.linspace(-WORKSPACE[1], WORKSPACE[1], 7):
            data.qpos[:] = controller.posture_at(np.array([x, y]))[0]
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_jacSite(model, data, jacobian, None, model.site("hand").id)
            assert np.abs(1.2 * directions @ np.linalg.pinv(jacobian[:2]).T).max() < model.actuator_ctrlrange[0, 1]


def test_objects_are_called_what_they_look_like() -> None:
    assert [object_name(number) for number in range(len(OBJECT_NAMES))] == list(OBJECT_NAMES)
