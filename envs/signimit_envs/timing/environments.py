"""Control steps of the environments beside the bare simulator, ways to step several of them, and rendered frames."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import gymnasium as gym
import mink
import mujoco
import numpy as np

from signimit_envs import ENV_IDS
from signimit_envs.arm.scene import CONTROL_RATE, MAX_JOINT_SPEED, POSTURE_COST, SUBSTEPS, home_posture
from signimit_envs.tabletop.env import TabletopEnv
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.measuring import Timing, time_in_turns
from signimit_envs.video.rendering import OffscreenView

STEP_LIMITS = dict(zip(ENV_IDS, (1.5, 1.3), strict=True))  # times the bare simulator
FRAME_LIMIT = 0.012  # s


def time_steps(env_id: str, turns: int, steps: int = 300) -> Timing:
    """Time control steps of an environment, as ``gym.make`` gives it, beside the bare simulator.

    The bare loop does as many ``mj_step`` with the joint velocities that the same actions ask for; for the hand it
    solves the same inverse kinematics with one ``mink.solve_ik`` a control step. Resets are not counted.
    """
    env = gym.make(env_id, max_episode_steps=10**9)
    arm = env.unwrapped
    assert isinstance(arm, TabletopEnv)
    model, data = arm.model, mujoco.MjData(arm.model)
    solve = _bare_inverse_kinematics(model, arm.max_hand_speed) if isinstance(arm, TabletopHandEnv) else None
    actions = np.random.default_rng(0).uniform(-0.5, 0.5, (steps, *(env.action_space.shape or ()))).astype(np.float32)

    def restart(turn: int) -> None:
        env.reset(seed=turn)
        mujoco.mj_resetData(model, data)
        data.qpos[:] = arm.data.qpos
        mujoco.mj_forward(model, data)

    def bare() -> None:
        for action in actions:
            data.ctrl[:] = action * MAX_JOINT_SPEED if solve is None else solve(data.qpos, action)
            mujoco.mj_step(model, data, SUBSTEPS)

    ways: dict[str, Callable[[], object]] = {"ours": partial(_call_with_each, env.step, actions), "bare": bare}
    times = time_in_turns(ways, turns, dict.fromkeys(ways, restart))
    env.close()
    limit = STEP_LIMITS[env_id]
    return Timing.of(f"a step of {env_id}", times["ours"], times["bare"], limit=limit, pieces=steps)


def _call_with_each(function: Callable[[Any], object], arguments: Iterable[Any]) -> None:
    for argument in arguments:
        function(argument)


def _bare_inverse_kinematics(model: mujoco.MjModel, max_hand_speed: float) -> Callable[[Any, Any], Any]:
    """Return mink's joint velocities as a function of joint angles and an action of the hand."""
    configuration, dt = mink.Configuration(model), 1.0 / CONTROL_RATE
    hand, posture = mink.FrameTask("hand", "site", 1.0, 0.0), mink.PostureTask(model, POSTURE_COST)
    posture.set_target(home_posture(model))
    speeds = {model.joint(i).name: MAX_JOINT_SPEED for i in range(model.njnt)}
    limits = [mink.ConfigurationLimit(model), mink.VelocityLimit(model, speeds)]

    def solve(joints: Any, action: Any) -> Any:
        configuration.update(joints)
        pose = configuration.get_transform_frame_to_world("hand", "site").wxyz_xyz.copy()
        pose[4:6] += action * (max_hand_speed * dt)
        hand.set_target(mink.SE3(pose))
        return mink.solve_ik(configuration, [hand, posture], dt, "daqp", limits=limits)

    return solve


def time_vector_envs(count: int, turns: int, steps: int = 200) -> list[Timing]:
    """Time a control step of several environments, by Gymnasium's ways and by a loop over bare ones, beside a loop.

    Args:
        count: How many environments.
        turns: How often everything is timed.
        steps: Control steps in a turn; resets are not counted.
    """
    env_id = "signimit_envs:signimit/TabletopHand-v0"  # by this name a spawned process registers it
    loops: dict[str, list[gym.Env[Any, Any]]] = {
        "a loop over gym.make": [gym.make(env_id) for _ in range(count)],
        "a loop over TabletopHandEnv": [TabletopHandEnv() for _ in range(count)],
    }
    vectors = {
        name: gym.make_vec(env_id, num_envs=count, vectorization_mode=mode, vector_kwargs=kwargs)
        for name, mode, kwargs in (("SyncVectorEnv", "sync", {}), ("AsyncVectorEnv", "async", {"context": "spawn"}))
    }
    actions = np.random.default_rng(0).uniform(-0.3, 0.3, (steps, count, 2)).astype(np.float32)

    def reset_each(envs: list[gym.Env[Any, Any]], seed: int) -> None:
        for number, env in enumerate(envs):
            env.reset(seed=seed + number)

    def reset_vector(envs: gym.vector.VectorEnv[Any, Any, Any], seed: int) -> None:
        envs.reset(seed=seed)

    def step_each(envs: list[gym.Env[Any, Any]], row: Any) -> None:
        for env, action in zip(envs, row, strict=True):
            env.step(action)

    step: dict[str, Callable[[Any], object]] = {name: partial(step_each, envs) for name, envs in loops.items()}
    reset: dict[str, Callable[[int], object]] = {name: partial(reset_each, envs) for name, envs in loops.items()}
    for name, vector in vectors.items():
        step[name], reset[name] = vector.step, partial(reset_vector, vector)
    ways = {name: partial(_call_with_each, function, actions) for name, function in step.items()}
    try:
        times = time_in_turns(ways, turns, reset)
    finally:
        for env in itertools.chain(*loops.values()):
            env.close()
        for vector in vectors.values():
            vector.close()
    plain = times["a loop over gym.make"]
    return [Timing.of(f"a step of {count}, {name}", taken, plain, pieces=steps) for name, taken in times.items()]


def time_frames(turns: int = 30, size: int = 480) -> list[Timing]:
    """Time a rendered frame from each camera.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    env = TabletopEnv()
    env.reset(seed=0)
    view = OffscreenView(env.model, size, size)
    view.frame(env.data)
    try:
        times = time_in_turns({name: partial(view.frame, env.data, name) for name in ("perspective", "top")}, turns)
    finally:
        view.close()
    return [Timing.of(f"a frame, {camera}", taken, limit=FRAME_LIMIT) for camera, taken in times.items()]
