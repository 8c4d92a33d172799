"""How fast things are, as ratios within one run: environments and the core against the plainest way."""

from __future__ import annotations

import importlib.metadata
import platform
import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import gymnasium as gym
import mink
import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit import DemonstrationSet, learn, policy_distances
from signimit.similarity import directed_points
from signimit_envs.arm.scene import CONTROL_RATE, MAX_JOINT_SPEED, SUBSTEPS, home_posture
from signimit_envs.tabletop.env import TabletopEnv
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.video.rendering import OffscreenView

STEPS = 300
_Run = Callable[[], None]


class Comparison(NamedTuple):
    """Two ways of doing the same work.

    Attributes:
        ours: Time of ours, the least of all repetitions, s.
        plain: Time of the plain way, the least, s.
        ratio: Median over the repetitions, taken in turns, of ours over plain.
    """

    ours: float
    plain: float
    ratio: float


def compare(ours: _Run, plain: _Run, repetitions: int) -> Comparison:
    """Time two callables in turns, so that what else the machine does strikes both."""
    times = np.array([(_seconds(ours), _seconds(plain)) for _ in range(repetitions)])
    return Comparison(float(times[:, 0].min()), float(times[:, 1].min()), float(np.median(times[:, 0] / times[:, 1])))


def _seconds(run: _Run) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def compare_environment(env_id: str, repetitions: int = 20) -> Comparison:
    """Compare the steps of an environment, as ``gym.make`` gives it, with the bare simulator.

    The bare loop does as many ``mj_step`` with the same joint velocities; for the hand it solves the same inverse
    kinematics with one ``mink.solve_ik`` a control step. Resets are not counted.

    Returns:
        Times are per control step, s.
    """
    env = gym.make(env_id, max_episode_steps=10**9)
    arm = env.unwrapped
    assert isinstance(arm, TabletopEnv)
    rng = np.random.default_rng(0)
    actions = list(rng.uniform(-0.5, 0.5, (STEPS, *env.action_space.shape)).astype(np.float32))  # type: ignore[misc]
    bare = _bare_hand(arm) if isinstance(arm, TabletopHandEnv) else _bare_joints(arm)
    times = []
    for seed in range(repetitions):
        env.reset(seed=seed)
        start, commands = arm.data.qpos.copy(), []
        ours = 0.0
        for action in actions:
            before = time.perf_counter()
            env.step(action)
            ours += time.perf_counter() - before
            commands.append(arm.data.ctrl.copy())
        times.append((ours, bare(start, actions, commands)))
    env.close()
    each = np.array(times) / STEPS
    return Comparison(float(each[:, 0].min()), float(each[:, 1].min()), float(np.median(each[:, 0] / each[:, 1])))


_Bare = Callable[[NDArray[np.float64], list[NDArray[np.float32]], list[NDArray[np.float64]]], float]


def _bare_joints(arm: TabletopEnv) -> _Bare:
    model, data = arm.model, mujoco.MjData(arm.model)

    def run(start: NDArray[np.float64], actions: Any, commands: list[NDArray[np.float64]]) -> float:
        _restart(model, data, start)
        total = 0.0
        for command in commands:
            before = time.perf_counter()
            data.ctrl[:] = command
            mujoco.mj_step(model, data, SUBSTEPS)
            total += time.perf_counter() - before
        return total

    return run


def _bare_hand(arm: TabletopHandEnv) -> _Bare:
    model, data, dt = arm.model, mujoco.MjData(arm.model), 1.0 / CONTROL_RATE
    configuration = mink.Configuration(model)
    hand, posture = mink.FrameTask("hand", "site", 1.0, 0.0), mink.PostureTask(model, 1e-3)
    posture.set_target(home_posture(model))
    speeds = {model.joint(i).name: MAX_JOINT_SPEED for i in range(model.njnt)}
    limits = [mink.ConfigurationLimit(model), mink.VelocityLimit(model, speeds)]

    def run(start: NDArray[np.float64], actions: list[NDArray[np.float32]], commands: Any) -> float:
        _restart(model, data, start)
        total = 0.0
        for action in actions:
            before = time.perf_counter()
            configuration.update(data.qpos)
            pose = configuration.get_transform_frame_to_world("hand", "site").wxyz_xyz.copy()
            pose[4:6] += action * (arm.max_hand_speed * dt)
            hand.set_target(mink.SE3(pose))
            data.ctrl[:] = mink.solve_ik(configuration, [hand, posture], dt, "daqp", limits=limits)
            mujoco.mj_step(model, data, SUBSTEPS)
            total += time.perf_counter() - before
        return total

    return run


def _restart(model: mujoco.MjModel, data: mujoco.MjData, joints: NDArray[np.float64]) -> None:
    mujoco.mj_resetData(model, data)
    data.qpos[:] = joints
    mujoco.mj_forward(model, data)


def compare_distances(demonstrations: DemonstrationSet, repetitions: int = 3) -> tuple[Comparison, float]:
    """Compare Δ with the loops that its formula spells out.

    Returns:
        The comparison, and the largest difference between the two results, relative to the largest Δ.
    """
    paths = [demo.hand for demo in demonstrations]
    objects = np.stack([demo.objects for demo in demonstrations])
    comparison = compare(
        lambda: _ignore(policy_distances(paths, objects)), lambda: _ignore(plain_distances(paths, objects)), repetitions
    )
    fast, slow = policy_distances(paths, objects), plain_distances(paths, objects)
    return comparison, float(np.abs(fast - slow).max() / np.abs(slow).max())


def plain_distances(paths: list[NDArray[np.float64]], objects: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute Δ_{t;k;i;j} by four loops, as the paper's section II-B reads, shape (N, N, O, O), rad²."""
    directed = [directed_points(path) for path in paths]
    count, frames = objects.shape[:2]
    one_way = np.empty((count, count, frames, frames))
    for t, k, i, j in np.ndindex(one_way.shape):
        here, there = directed[t].positions - objects[t, i], directed[k].positions - objects[k, j]
        nearest = ((here[:, None] - there[None]) ** 2).sum(axis=2).argmin(axis=1)
        gaps = np.abs(directed[t].angles - directed[k].angles[nearest])
        one_way[t, k, i, j] = (np.minimum(gaps, 2 * np.pi - gaps) ** 2).mean()
    return np.minimum(one_way, one_way.transpose(1, 0, 3, 2))


def time_learning(demonstrations: DemonstrationSet, prototypes: Any, method: str, repetitions: int = 5) -> float:
    """Return the least time to learn, s."""
    return min(_seconds(lambda: _ignore(learn(demonstrations, prototypes, method=method))) for _ in range(repetitions))


def time_frames(size: int = 480, frames: int = 30) -> dict[str, float]:
    """Return the median time of a frame from each camera, s.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    env = TabletopEnv()
    env.reset(seed=0)
    view = OffscreenView(env.model, size, size)
    view.frame(env.data)
    try:
        return {
            camera: float(np.median([_seconds(lambda: _ignore(view.frame(env.data, camera))) for _ in range(frames)]))  # noqa: B023
            for camera in ("perspective", "top")
        }
    finally:
        view.close()


def installed_versions() -> Mapping[str, str]:
    """Return what is installed, as far as speed and results depend on it."""
    packages = ("signimit", "mujoco", "mink", "gymnasium", "numpy", "scipy")
    return {"python": platform.python_version(), **{p: importlib.metadata.version(p) for p in packages}}


def _ignore(_: object) -> None:
    """Drop a result."""
