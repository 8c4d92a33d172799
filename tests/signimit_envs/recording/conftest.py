"""A small recording that all tests here share: two episodes of two different lengths, four objects."""

from __future__ import annotations

from contextlib import closing

import gymnasium as gym
import numpy as np
import pytest

import signimit_envs  # noqa: F401 -- registers the environments
from signimit_envs.recording import EpisodeRecorder, Recording


@pytest.fixture(scope="session")
def recording() -> Recording:
    rng = np.random.default_rng(0)
    with closing(EpisodeRecorder(gym.make("signimit/TabletopHand-v0", objects=4, camera="top"))) as env:
        for seed, steps in ((5, 40), (None, 25)):
            env.reset(seed=seed)
            for _ in range(steps):
                env.step(rng.uniform(-0.5, 0.5, 2).astype(np.float32))
        return env.recording
