"""Many reproductions at once beside one at a time: how much faster, whether the same, and the parts of a step."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import product
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit import run_policy
from signimit.evaluation import performed
from signimit.learners import DEFAULT_METHOD
from signimit.learning import learn
from signimit.policies import DEFAULT_POLICY, PlacedPolicy
from signimit.teaching.languages import Request
from signimit.teaching.people.choosing import choose_people
from signimit.teaching.sessions import Command
from signimit_envs.arm.batch import reproduce_many
from signimit_envs.arm.batch.inverse_kinematics import ManyHandsController
from signimit_envs.arm.batch.physics import ManyArms, compile_arm
from signimit_envs.arm.batch.policy_batch import PolicyBatch
from signimit_envs.arm.scene import CONTROL_RATE, SUBSTEPS
from signimit_envs.sessions.reproduction import reproduce
from signimit_envs.sessions.session import SessionPlan
from signimit_envs.tabletop.success import SuccessDetector
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.measuring import time_in_turns

Array = NDArray[np.float64]
WHOLE, REST = "everything", "rest: checks, observation, info, loop"
_ALONE = 9  # reproductions one at a time in a turn


class Work(NamedTuple):
    """Reproductions to do.

    Attributes:
        policies: What moves each hand.
        commands: What is asked for, and where things are.
        templates: What the judge compares with.
    """

    policies: list[PlacedPolicy]
    commands: list[Command]
    templates: list[list[Array]]

    @property
    def hands(self) -> Array:
        """Where the hands start, shape (B, 2), m."""
        return np.array([command.hand for command in self.commands])

    def first(self, count: int) -> Work:
        """Return the first so many of the reproductions."""
        return Work(self.policies[:count], self.commands[:count], self.templates)


def compose_work(count: int, seed: int = 0, kind: str = DEFAULT_POLICY) -> Work:
    """Let a built-in session's learner understand so many commands, each in a scene of its own.

    Args:
        count: How many.
        seed: Of the session.
        kind: Of the policies.
    """
    requests = len(SessionPlan().language.requests)
    plan = SessionPlan(method=DEFAULT_METHOD, policy=kind, seed=seed, attempts=-(-count // requests))
    session = plan.compose(choose_people(plan.language, np.random.default_rng([seed, 1])))
    model = learn(session.demonstrations, session.prototypes, plan.method, plan.policy, plan.seed)
    chosen = [session.commands[i] for i in np.random.default_rng(seed).permutation(len(session.commands))[:count]]
    policies = [model.respond(command.signs, command.objects).policy for command in chosen]
    return Work(policies, chosen, [list(t) for t in session.truth.templates])


class BatchSpeed(NamedTuple):
    """How fast a batch is, beside one environment that is stepped.

    Attributes:
        batch: How many reproductions at once.
        threads: For the physics, 0 for all processors.
        faster: Reproductions a second, in units of what one environment does; median over the turns.
        lowest: The least of all turns.
        computing: Computing time of one environment for a reproduction, in units of what the batch's threads spend
            together; median over the turns. What else the machine does matters little to it.
    """

    batch: int
    threads: int
    faster: float
    lowest: float
    computing: float


def measure_batches(
    work: Work, batches: Sequence[int], threads: Sequence[int], seconds: float, turns: int
) -> list[BatchSpeed]:
    """Time batches and one environment in turns; scenes are set up within the time, learning and judging are not."""
    env = TabletopHandEnv()
    ways: dict[str, Callable[[], object]] = {"alone": partial(_one_by_one, env, work.first(_ALONE), seconds)}
    for batch, number in product(batches, threads):
        some = work.first(batch)
        ways[f"{batch} {number}"] = partial(reproduce_many, some.policies, some.hands, seconds, number)
    times = time_in_turns(ways, turns)
    env.close()
    rows = []
    for batch, number in product(batches, threads):
        ratios = (times["alone"] / len(work.first(_ALONE).policies)) / (times[f"{batch} {number}"] / batch)
        faster, computing = np.median(ratios, axis=0).tolist()
        rows.append(BatchSpeed(batch, number, faster, float(ratios[:, 0].min()), computing))
    return rows


def _one_by_one(env: TabletopHandEnv, work: Work, seconds: float) -> list[Array]:
    return [
        reproduce(env, policy, command.objects, command.hand, seconds).path
        for policy, command in zip(work.policies, work.commands, strict=True)
    ]


class Agreement(NamedTuple):
    """Whether reproductions at once are those one at a time.

    Attributes:
        kind: Of the policies.
        reproductions: How many were compared.
        largest_gap: Largest distance between two hands at one time, m.
        same_verdicts: Of how many `signimit.performed` says the same movement and object.
    """

    kind: str
    reproductions: int
    largest_gap: float
    same_verdicts: int


def compare_paths(work: Work, seconds: float) -> Agreement:
    """Do reproductions in both ways, and judge both."""
    env = TabletopHandEnv()
    alone = _one_by_one(env, work, seconds)
    env.close()
    together = reproduce_many(work.policies, work.hands, seconds).paths
    gap = max(float(np.hypot(*(a - b).T).max()) for a, b in zip(alone, together, strict=True))
    same = 0
    for paths, command in zip(zip(alone, together, strict=True), work.commands, strict=True):
        one, other = (performed(path, command.objects, work.templates)[:2] for path in paths)
        same += one == other
    return Agreement(work.policies[0].policy.kind, len(alone), gap, same)


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
    env = TabletopHandEnv()
    alone, together = _parts_alone(env, work, seconds), _parts_together(work, seconds)
    ways = {f"alone {n}": run for n, run in alone.items()} | {f"together {n}": run for n, run in together.items()}
    times = {name: taken[:, 1] for name, taken in time_in_turns(ways, turns).items()}
    env.close()
    share = {name: float(np.median(taken / times[f"alone {WHOLE}"])) for name, taken in times.items()}
    each = {name: share[f"together {name}"] / len(work.policies) for name in together}
    whole, *parts = [Part(name, share[f"alone {name}"], each.get(name)) for name in alone]
    left = each[WHOLE] - sum(part.together or 0.0 for part in parts)
    return [whole, *parts, Part(REST, whole.alone - sum(part.alone for part in parts), left)]


def _parts_alone(env: TabletopHandEnv, work: Work, seconds: float) -> dict[str, Callable[[], object]]:
    """Return what one hand does, whole and in parts that repeat it."""
    policy, command, dt = work.policies[0], work.commands[0], 1.0 / CONTROL_RATE
    joints: list[Array] = []
    track = reproduce(
        env, policy, command.objects, command.hand, seconds, each_step=lambda: joints.append(env.data.qpos.copy())
    )
    ahead = track.commanded - track.path[:-1]
    commands = [env.controller.solve(q, by, dt).velocities for q, by in zip(joints, ahead, strict=False)]
    model, judge = env.model, SuccessDetector(work.templates)

    def physics() -> None:
        data = mujoco.MjData(model)
        data.qpos[:] = joints[0]
        for velocities in commands:
            data.ctrl[:] = velocities
            mujoco.mj_step(model, data, SUBSTEPS)

    def judging() -> None:
        judge.start(Request(0, 0), command.objects, command.hand)
        for hand in track.path[1:]:
            judge.watch(hand)

    def moving() -> None:
        recorded = iter(track.path[1:])
        run_policy(policy, track.path[0], seconds, lambda *_: next(recorded, None))

    return {
        WHOLE: lambda: reproduce(env, policy, command.objects, command.hand, seconds),
        "physics": physics,
        "inverse kinematics": lambda: [env.controller.solve(q, by, dt) for q, by in zip(joints, ahead, strict=False)],
        "policy": moving,
        "judge": judging,
        "start of an episode": lambda: env.reset(options={"objects": command.objects, "hand": command.hand}),
    }


def _parts_together(work: Work, seconds: float) -> dict[str, Callable[[], object]]:
    """Return what many hands do, whole and in parts that repeat it; they are not judged on the way."""
    tracks, dt = reproduce_many(work.policies, work.hands, seconds), 1.0 / CONTROL_RATE
    model, steps = compile_arm(), range(tracks.commanded.shape[1])
    controller = ManyHandsController(model)
    hands = [np.ascontiguousarray(tracks.paths[:, step]) for step in steps]
    joints = [np.ascontiguousarray(tracks.joints[:, step].T) for step in steps]
    ahead = [np.ascontiguousarray(tracks.commanded[:, step].T) - hands[step].T for step in steps]
    commands = [controller.solve(q, by, dt).velocities for q, by in zip(joints, ahead, strict=True)]

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
        "inverse kinematics": lambda: [controller.solve(q, by, dt) for q, by in zip(joints, ahead, strict=True)],
        "policy": moving,
        "start of an episode": lambda: controller.postures_at(work.hands.T),
    }
