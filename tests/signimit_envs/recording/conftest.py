"""A small recording that all tests here share: two episodes of two different lengths, four objects."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest

import signimit as si
import signimit_envs  # noqa: F401 -- registers the environments
from signimit_envs.recording import EpisodeRecorder, Recording
from signimit_envs.recording.episodes import episode_arrays


@pytest.fixture(scope="session")
def recording() -> Recording:
    rng = np.random.default_rng(0)
    with closing(EpisodeRecorder(gym.make("signimit/TabletopHand-v0", objects=4, camera="top"))) as env:
        for seed, steps in ((5, 40), (None, 25)):
            env.reset(seed=seed)
            for _ in range(steps):
                env.step(rng.uniform(-0.5, 0.5, 2).astype(np.float32))
        return env.recording


@pytest.fixture(scope="session")
def demonstrations() -> si.DemonstrationSet:
    """Three demonstrations with strokes and paths of all lengths, the clock of the second starting late."""
    rng = np.random.default_rng(2)
    return si.DemonstrationSet(
        si.Demonstration(
            signs=tuple(rng.normal(size=(int(rng.integers(3, 9)), 2)) for _ in range(2)),
            objects=rng.uniform(-0.3, 0.3, (3, 2)),
            hand=rng.uniform(-0.3, 0.3, (20 + number, 2)),
            times=np.linspace(start, start + 0.02 * (19 + number), 20 + number),
        )
        for number, start in enumerate((0.0, 1.5, 0.0))
    )


@pytest.fixture(scope="session")
def assert_same() -> Callable[[Recording, Recording], None]:
    """Fail unless two recordings are equal, bit for bit."""

    def check(a: Recording, b: Recording) -> None:
        assert a.origin == b.origin
        assert [e.seed for e in a] == [e.seed for e in b]
        for one, other in zip(a, b, strict=True):
            left, right = episode_arrays(one), episode_arrays(other)
            assert left.keys() == right.keys()
            for name, array in left.items():
                assert (array.dtype, array.shape) == (right[name].dtype, right[name].shape), name
                assert array.tobytes() == right[name].tobytes(), name

    return check


@pytest.fixture
def minari_root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Keep Minari's data sets in a folder of the test."""
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path / "minari"))
    return tmp_path / "minari"
