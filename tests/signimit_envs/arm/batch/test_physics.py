"""Many arms move as the one in the environment does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from signimit_envs.arm.batch.physics import ManyArms, QuietLog, compile_arm
from signimit_envs.arm.scene import SUBSTEPS, compile_scene

HOME = np.array([-1.05, 1.32, 1.20])


def wandering(steps: int, arms: int) -> Any:
    return np.random.default_rng(0).uniform(-2.0, 2.0, (steps, 3, arms))


@pytest.mark.parametrize("objects", [2, 3, 6])
def test_what_is_left_out_of_the_scene_moves_nothing(objects: int) -> None:
    scene, arm = compile_scene(objects), compile_arm()
    assert arm.ngeom == arm.nmocap == arm.ncam == 0
    states = []
    for model in (scene, arm):
        data = mujoco.MjData(model)
        data.qpos[:] = HOME
        mujoco.mj_forward(model, data)
        for velocities in wandering(60, 1):
            data.ctrl[:] = velocities[:, 0]
            mujoco.mj_step(model, data, SUBSTEPS)
        states.append(np.concatenate([data.qpos, data.qvel]))
    np.testing.assert_allclose(states[0], states[1], atol=1e-12)


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_every_arm_moves_bit_for_bit_as_mj_step_moves_it(threads: int) -> None:
    model, commands = compile_arm(), 0.3 * wandering(20, 7)
    arms = ManyArms(model, np.repeat(HOME[:, None], 7, axis=1), threads)
    for velocities in commands:
        joints, sound = arms.simulate(velocities)
    assert sound.all()
    for b in range(7):
        data = mujoco.MjData(model)
        data.qpos[:] = HOME
        mujoco.mj_forward(model, data)
        for velocities in commands:
            data.ctrl[:] = velocities[:, b]
            mujoco.mj_step(model, data, SUBSTEPS)
        np.testing.assert_array_equal(joints[:, b], data.qpos)


def test_joints_stop_at_their_limits() -> None:
    model = compile_arm()
    arms = ManyArms(model, np.repeat(HOME[:, None], 2, axis=1), 1)
    for _ in range(100):
        joints, sound = arms.simulate(np.array([[-3.5, 3.5]] * 3))
    assert sound.all()
    np.testing.assert_allclose(joints.T, model.jnt_range.T, atol=0.02)


def test_an_arm_whose_physics_fails_rests_where_it_was_and_the_others_go_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # where MuJoCo would write its log
    failing, whole = (ManyArms(compile_arm(), np.repeat(HOME[:, None], 3, axis=1), 2) for _ in range(2))
    commands = 0.3 * wandering(4, 3)
    for arms in (failing, whole):
        before, _ = arms.simulate(commands[0])
    failing._qvel[:, 1] = np.nan
    for velocities in commands[1:]:
        with QuietLog():
            joints, sound = failing.simulate(velocities)
        expected, _ = whole.simulate(velocities)
        assert sound.tolist() == [True, False, True]
        np.testing.assert_array_equal(joints[:, 1], before[:, 1])
        np.testing.assert_array_equal(joints[:, [0, 2]], expected[:, [0, 2]])
    assert not list(tmp_path.iterdir())
