"""What a control step costs, part by part, one hand at a time and many at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit import run_policy
from signimit.teaching.languages import Request
from signimit_envs.arm.batch import reproduce_many
from signimit_envs.arm.batch.inverse_kinematics import ManyHandsController
from signimit_envs.arm.batch.physics import ManyArms, compile_arm
from signimit_envs.arm.batch.policy_batch import PolicyBatch
from signimit_envs.arm.scene import CONTROL_RATE, SUBSTEPS
from signimit_envs.sessions.reproduction import reproduce
from signimit_envs.tabletop.success import SuccessDetector
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.throughput.work import Work, duration

Array = NDArray[np.float64]
Runs = dict[str, Callable[[], object]]

WHOLE, REST = "everything", "rest: checks, observation, info, loop"
_DT = 1.0 / CONTROL_RATE


class Part(NamedTuple):
    """A part of a control step.

    Attributes:
        name: What.
        alone: Share of the computing time of a control step of `signimit_envs.reproduce`.
        together: Computing time for each of many hands in the same unit, of all threads together; None if many hands
            have no such part.
    """

    name: str
    alone: float
    together: float | None


def measure_parts(work: Work, seconds: float, turns: int) -> list[Part]:
    """Do the parts of reproductions again, each by itself, in turns; the first row is the whole, the last what is left.

    Args:
        work: The first is what one hand does, all of it what many do.
        seconds: How long a hand moves.
        turns: How often; medians are returned.
    """
    env, count = TabletopHandEnv(), len(work.policies)
    ways = _alone(env, work, seconds), _together(work, seconds)
    times: list[list[list[float]]] = [[], []]
    for _ in range(turns):
        for runs, taken in zip(ways, times, strict=True):
            taken.append([duration(run).computing for run in runs.values()])
    env.close()
    wholes = np.array(times[0])[:, :1]
    alone = dict(zip(ways[0], np.median(times[0] / wholes, axis=0).tolist(), strict=True))
    together = dict(zip(ways[1], np.median(times[1] / wholes / count, axis=0).tolist(), strict=True))
    for shares in (alone, together):
        shares[REST] = shares[WHOLE] - sum(share for name, share in shares.items() if name != WHOLE)
    return [Part(name, share, together.get(name)) for name, share in alone.items()]


def _alone(env: TabletopHandEnv, work: Work, seconds: float) -> Runs:
    """Return what one hand does, whole and in parts that repeat it."""
    policy, scene = work.policies[0], work.scenes[0]
    joints: list[Array] = []
    track = reproduce(env, policy, *scene, seconds, each_step=lambda: joints.append(env.data.qpos.copy()))
    ahead = track.commanded - track.path[:-1]
    commands = [env.controller.solve(q, by, _DT).velocities for q, by in zip(joints, ahead, strict=False)]
    model, judge = env.model, SuccessDetector(work.templates)

    def physics() -> None:
        data = mujoco.MjData(model)
        data.qpos[:] = joints[0]
        for velocities in commands:
            data.ctrl[:] = velocities
            mujoco.mj_step(model, data, SUBSTEPS)

    def judging() -> None:
        judge.start(Request(0, 0), scene.objects, scene.hand)
        for hand in track.path[1:]:
            judge.watch(hand)

    def moving() -> None:
        recorded = iter(track.path[1:])
        run_policy(policy, track.path[0], seconds, lambda *_: next(recorded, None))

    return {
        WHOLE: lambda: reproduce(env, policy, *scene, seconds),
        "physics": physics,
        "inverse kinematics": lambda: [env.controller.solve(q, by, _DT) for q, by in zip(joints, ahead, strict=False)],
        "policy": moving,
        "judge": judging,
        "start of an episode": lambda: env.reset(options={"objects": scene.objects, "hand": scene.hand}),
    }


def _together(work: Work, seconds: float) -> Runs:
    """Return what many hands do, whole and in parts that repeat it; nobody judges them on the way."""
    tracks = reproduce_many(work.policies, work.hands, seconds)
    model, steps = compile_arm(), range(tracks.commanded.shape[1])
    controller = ManyHandsController(model)
    hands = [np.ascontiguousarray(tracks.paths[:, step]) for step in steps]
    joints = [np.ascontiguousarray(tracks.joints[:, step].T) for step in steps]
    ahead = [np.ascontiguousarray(tracks.commanded[:, step].T) - hands[step].T for step in steps]
    commands = [controller.solve(q, by, _DT).velocities for q, by in zip(joints, ahead, strict=True)]

    def physics() -> None:
        arms = ManyArms(model, joints[0])
        for velocities in commands:
            arms.simulate(velocities)

    def moving() -> None:
        recorded = iter(hands[1:])
        run_policy(PolicyBatch(work.policies), hands[0], seconds, lambda *_: next(recorded, None))

    return {
        WHOLE: lambda: reproduce_many(work.policies, work.hands, seconds),
        "physics": physics,
        "inverse kinematics": lambda: [controller.solve(q, by, _DT) for q, by in zip(joints, ahead, strict=True)],
        "policy": moving,
        "start of an episode": lambda: controller.postures_at(work.hands.T),
    }
