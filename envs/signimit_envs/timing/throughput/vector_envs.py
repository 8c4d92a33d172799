"""Gymnasium's ways to step several environments, beside a plain loop over the same ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.throughput.work import duration

ENV_ID = "signimit_envs:signimit/TabletopHand-v0"


class WayToStep(NamedTuple):
    """A way to step environments.

    Attributes:
        name: What it is.
        time: For as many steps, in units of the loop; median over the turns.
    """

    name: str
    time: float


def make_vector_env(count: int, mode: Literal["sync", "async"]) -> gym.vector.VectorEnv[Any, Any, Any]:
    """Make environments that Gymnasium steps together; worker processes are spawned, so that they may render."""
    kwargs = {"context": "spawn"} if mode == "async" else {}
    return gym.make_vec(ENV_ID, num_envs=count, vectorization_mode=mode, vector_kwargs=kwargs)


def measure_vector_envs(count: int, seconds: float, turns: int) -> list[WayToStep]:
    """Step environments with the same actions in turns, resets not counted."""
    steps = round(seconds * CONTROL_RATE)
    actions = np.random.default_rng(0).uniform(-0.3, 0.3, (steps, count, 2)).astype(np.float32)
    made, bare = _Loop([gym.make(ENV_ID) for _ in range(count)]), _Loop([TabletopHandEnv() for _ in range(count)])
    ways: dict[str, _Loop | gym.vector.VectorEnv[Any, Any, Any]] = {
        "a loop over `gym.make(...)`": made,
        "a loop over `TabletopHandEnv()`": bare,
        "`SyncVectorEnv`": make_vector_env(count, "sync"),
        "`AsyncVectorEnv`": make_vector_env(count, "async"),
    }
    try:
        times = np.array([[_time_steps(way, actions) for way in ways.values()] for _ in range(turns)])
    finally:
        for way in ways.values():
            way.close()
    medians = np.median(times / times[:, :1], axis=0).tolist()
    return [WayToStep(name, time) for name, time in zip(ways, medians, strict=True)]


class _Loop:
    """Environments that are stepped one after the other."""

    def __init__(self, envs: Sequence[gym.Env[Any, Any]]) -> None:
        self._envs = envs

    def reset(self, *, seed: int) -> None:
        """Seed them as a vector environment does."""
        for number, env in enumerate(self._envs):
            env.reset(seed=seed + number)

    def step(self, actions: NDArray[np.float32]) -> None:
        """Give each its action."""
        for env, action in zip(self._envs, actions, strict=True):
            env.step(action)

    def close(self) -> None:
        """Close them."""
        for env in self._envs:
            env.close()


def _time_steps(way: _Loop | gym.vector.VectorEnv[Any, Any, Any], actions: NDArray[np.float32]) -> float:
    way.reset(seed=0)

    def run() -> None:
        for row in actions:
            way.step(row)

    return duration(run).wall
