"""Use an installed signimit as a stranger would: learn, obey, compile every scene, step every environment."""

from __future__ import annotations

import importlib.resources
from pathlib import Path

import gymnasium as gym
import mujoco
import numpy as np

import signimit as si
import signimit_assets
import signimit_envs  # noqa: F401  (registers the environments)


def drawing(turn: int, times: np.ndarray) -> np.ndarray:
    """Return two loops about the origin, ``turn`` = 1 counter-clockwise, -1 clockwise, m."""
    return 0.1 * np.column_stack([np.cos(np.pi * times), turn * np.sin(np.pi * times)])


def learn_two_circles() -> None:
    """Two movements, two objects, from arrays; then obey."""
    rng, times = np.random.default_rng(0), np.arange(0.0, 4.0, 0.02)
    bar, hook = np.array([[0.0, 0.0], [0.0, 1.0]]), np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    shown = []
    for movement, focus in ((0, 0), (0, 1), (1, 0), (1, 1)) * 2:
        objects = rng.uniform(-0.2, 0.2, (2, 2))
        hand = objects[focus] + drawing((1, -1)[movement], times)
        shown.append(si.Demonstration((bar if focus else hook, hook if movement else bar), objects, hand, times))
    model = si.learn(si.DemonstrationSet(shown), prototypes=[bar, hook])
    response = model.respond((hook, bar), [[-0.1, 0.0], [0.1, 0.0]])
    assert response.policy(np.array([0.0, 0.1])).shape == (2,)


def compile_scenes() -> int:
    """Compile every XML of the wheel; a mesh or texture that was left out of it fails here."""
    with importlib.resources.as_file(importlib.resources.files(signimit_assets)) as folder:
        scenes = sorted(Path(folder).rglob("*.xml"))
        for scene in scenes:
            mujoco.MjModel.from_xml_path(str(scene))
    return len(scenes)


def step_environments() -> None:
    """Make every registered environment and take some steps."""
    for name in ("signimit/Tabletop-v0", "signimit/TabletopHand-v0"):
        env = gym.make(name)
        env.reset(seed=0)
        env.action_space.seed(0)
        for _ in range(5):
            env.step(env.action_space.sample())
        env.close()


if __name__ == "__main__":
    assert "site-packages" in si.__file__, si.__file__
    learn_two_circles()
    scenes = compile_scenes()
    assert scenes, "the wheel has no scene"
    step_environments()
    print(f"signimit {si.__version__} from {Path(si.__file__).parent}: {scenes} scenes compiled")
