"""Many reproductions at once against one at a time: how much faster, and whether they are the same."""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.evaluation import performed
from signimit_envs.arm.batch import reproduce_many
from signimit_envs.sessions.reproduction import reproduce
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.throughput.work import Duration, ThroughputPlan, Work, duration

_ALONE = 9  # reproductions one at a time in a turn


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


def measure_batches(work: Work, plan: ThroughputPlan) -> list[BatchSpeed]:
    """Time batches and one environment in turns; scenes are set up within the time, learning and judging are not."""
    env, cells = TabletopHandEnv(), list(product(plan.batches, plan.threads))
    alone, together = [], []
    for _ in range(plan.turns):
        alone.append(_per_reproduction(duration(lambda: _one_by_one(env, work.first(_ALONE), plan.seconds)), _ALONE))
        together.append([_time_batch(work.first(batch), plan.seconds, threads) for batch, threads in cells])
    env.close()
    ratios = np.array(alone)[:, None] / np.array(together)  # (turn, cell, wall or computing)
    return [
        BatchSpeed(batch, threads, *(float(v) for v in (np.median(of[:, 0]), of[:, 0].min(), np.median(of[:, 1]))))
        for (batch, threads), of in zip(cells, ratios.swapaxes(0, 1), strict=True)
    ]


def _time_batch(work: Work, seconds: float, threads: int) -> Duration:
    took = duration(lambda: reproduce_many(work.policies, work.hands, seconds, threads))
    return _per_reproduction(took, len(work.policies))


def _per_reproduction(took: Duration, count: int) -> Duration:
    return Duration(took.wall / count, took.computing / count)


def _one_by_one(env: TabletopHandEnv, work: Work, seconds: float) -> list[NDArray[np.float64]]:
    return [
        reproduce(env, policy, *scene, seconds).path for policy, scene in zip(work.policies, work.scenes, strict=True)
    ]


def compare_paths(work: Work, seconds: float) -> Agreement:
    """Do reproductions in both ways, and judge both."""
    env = TabletopHandEnv()
    alone = _one_by_one(env, work, seconds)
    env.close()
    together = reproduce_many(work.policies, work.hands, seconds).paths
    gap = max(float(np.hypot(*(a - b).T).max()) for a, b in zip(alone, together, strict=True))
    same = 0
    for paths, scene in zip(zip(alone, together, strict=True), work.scenes, strict=True):
        one, other = (performed(path, scene.objects, work.templates)[:2] for path in paths)
        same += one == other
    return Agreement(work.policies[0].policy.kind, len(alone), gap, same)
