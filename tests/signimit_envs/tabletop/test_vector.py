"""Gymnasium's vector environments step ours as they would be stepped alone."""

from __future__ import annotations

from typing import Literal

import gymnasium as gym
import numpy as np
import pytest

ENV_ID = "signimit_envs:signimit/TabletopHand-v0"  # by this name a spawned process registers it


@pytest.mark.slow
@pytest.mark.parametrize(("mode", "count"), [("sync", 8), ("async", 2)])
def test_every_environment_does_what_it_would_do_alone(mode: Literal["sync", "async"], count: int) -> None:
    """From its own seed, with its own requests, in this process and in spawned ones."""
    actions = np.random.default_rng(0).uniform(-0.5, 0.5, (10, count, 2)).astype(np.float32)
    kwargs = {"context": "spawn"} if mode == "async" else {}  # so that worker processes may render
    vector = gym.make_vec(ENV_ID, num_envs=count, vectorization_mode=mode, vector_kwargs=kwargs)
    observations, infos = vector.reset(seed=5)
    assert observations in vector.observation_space
    requests = np.array(infos["request"].tolist())
    for row in actions:
        observations, rewards, terminated, truncated, infos = vector.step(row)
    vector.close()
    assert rewards.shape == terminated.shape == truncated.shape == infos["is_success"].shape == (count,)
    for number in range(count):
        env = gym.make(ENV_ID)
        _, info = env.reset(seed=5 + number)
        assert tuple(requests[number]) == info["request"]
        for row in actions:
            alone, _, _, _, info = env.step(row[number])
        env.close()
        for key, value in alone.items():
            np.testing.assert_array_equal(observations[key][number], value)
        assert infos["ik_residual"][number] == info["ik_residual"]


def test_an_episode_that_is_over_starts_again_by_itself() -> None:
    vector = gym.make_vec(ENV_ID, num_envs=2, vectorization_mode="sync", max_episode_steps=3)
    first, _ = vector.reset(seed=0)
    for _ in range(3):
        _, _, _, truncated, _ = vector.step(np.full((2, 2), 0.2, np.float32))
    assert truncated.all()
    again, rewards, terminated, truncated, _ = vector.step(np.full((2, 2), 0.2, np.float32))
    assert not (terminated | truncated).any()
    assert (rewards == 0).all()
    assert not np.array_equal(again["objects"], first["objects"])
    np.testing.assert_array_equal(again["joint_velocities"], 0.0)
    vector.close()
