"""Reinforcement learning as a baseline: train PPO of stable-baselines3 (extra ``rl``) and count what it obeys."""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import gymnasium as gym
import numpy as np

from signimit.benchmark.statistics import Share
from signimit.exceptions import InvalidInputError, MissingDependencyError
from signimit.io.safe_files import whole_files
from signimit_envs.video.record_mp4 import RecordMp4

_ROLLOUT, _BATCH = 512, 64  # steps of each environment between two updates, and steps in a gradient
_POLICIES = {gym.spaces.Dict: "MultiInputPolicy", gym.spaces.Box: "CnnPolicy"}


def main(
    steps: int = 100_000,
    obs_type: Literal["state", "pixels", "state_pixels"] = "state",
    control: Literal["hand", "joint"] = "hand",
    reward: Literal["dense", "sparse"] = "dense",
    objects: int = 3,
    envs: int = 4,
    episodes: int = 20,
    seed: int = 0,
    out: Path = Path("out/train"),
    video: bool = False,
) -> None:
    """Train PPO of stable-baselines3 on the table, and try it in new episodes.

    It is a baseline: it is rewarded for obeying, which the learners of signimit never are.

    Args:
        steps: Control steps to learn from.
        obs_type: What it observes; pictures are 64 by 64 pixels.
        control: What it commands.
        reward: With or without shaping.
        objects: How many objects are on the table.
        envs: Environments side by side.
        episodes: How many episodes it is tried in.
        seed: Decides everything.
        out: Folder for the agent, ppo.zip.
        video: Film the trial episodes too.
    """
    arguments: dict[str, Any] = {"obs_type": obs_type, "control": control, "reward": reward, "objects": objects}
    if obs_type != "state":
        arguments["size"] = (64, 64)
    plan = TrainingPlan(arguments=arguments, steps=steps, envs=envs, seed=seed)
    with whole_files(out) as folder:
        start = time.perf_counter()
        agent = train_ppo(plan)
        seconds = time.perf_counter() - start
        agent.save(folder / "ppo.zip")
        env = RecordMp4(plan.make_env(render_mode="rgb_array"), folder) if video else plan.make_env()
        obeyed = evaluate_agent(agent, env, episodes, seed)
    print(f"{agent.num_timesteps} steps in {seconds:.0f} s; the agent is in {out / 'ppo.zip'}")
    print(f"obeyed {obeyed}")


@dataclass(frozen=True, kw_only=True)
class TrainingPlan:
    """What is trained, on what and how long.

    Attributes:
        env_id: Id of the environment.
        arguments: What ``gymnasium.make`` is given besides.
        steps: Control steps to learn from, all environments together.
        envs: How many environments run side by side, one after the other in this process.
        seed: Decides everything.
        discount: The agent's γ; also that of a dense reward.
    """

    env_id: str = "signimit/TabletopHand-v0"
    arguments: Mapping[str, Any] = field(default_factory=dict)
    steps: int = 100_000
    envs: int = 4
    seed: int = 0
    discount: float = 0.99

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            InvalidInputError: If there would be nothing to learn from.
        """
        for name, least in (("steps", 1), ("envs", 1), ("seed", 0)):
            if getattr(self, name) < least:
                raise InvalidInputError(name, f"{least} or more", f"{getattr(self, name)}")

    def make_env(self, **more: Any) -> gym.Env[Any, Any]:
        """Make one environment, with the agent's discount and any more arguments."""
        return gym.make(self.env_id, **{"discount": self.discount, **self.arguments, **more})


def train_ppo(plan: TrainingPlan, progress: bool = False) -> Any:
    """Train proximal policy optimisation (J. Schulman et al., arXiv:1707.06347) with the library's settings.

    Args:
        plan: What is done. PPO makes whole rollouts: it may go on for a little longer than ``steps``.
        progress: Show a progress bar; needs tqdm and rich.

    Returns:
        A `stable_baselines3.PPO`; it has ``save`` and ``predict``.

    Raises:
        MissingDependencyError: If stable-baselines3 is not installed.
    """
    if importlib.util.find_spec("stable_baselines3") is None:
        raise MissingDependencyError("stable-baselines3", "rl", "Training with PPO")
    from stable_baselines3 import PPO
    from stable_baselines3.common.env_util import make_vec_env

    envs = make_vec_env(plan.make_env, plan.envs, seed=plan.seed)
    try:
        rollout = _BATCH * max(1, min(_ROLLOUT, plan.steps // plan.envs) // _BATCH)
        named: dict[str, Any] = {
            "n_steps": rollout,
            "batch_size": _BATCH,
            "gamma": plan.discount,
            "seed": plan.seed,
            "device": "cpu",
        }
        agent = PPO(_POLICIES[type(envs.observation_space)], envs, **named)
        agent.learn(plan.steps, progress_bar=progress)
    finally:
        envs.close()
    return agent


def evaluate_agent(agent: Any, env: gym.Env[Any, Any], episodes: int, seed: int) -> Share:
    """Count in how many new episodes an agent fulfils its request; an episode ends there.

    Args:
        agent: Has ``predict(observation, deterministic) -> (action, state)``.
        env: Where; it is closed in the end.
        episodes: How many.
        seed: Decides the episodes; they are others than those of a training with this seed.

    Raises:
        InvalidInputError: If there is to be no episode.
    """
    if episodes < 1:
        raise InvalidInputError("episodes", "1 or more", f"{episodes}")
    try:
        seeds = np.random.SeedSequence([seed, 1]).generate_state(episodes)
        return Share.of(_succeeds(agent, env, int(number)) for number in seeds)
    finally:
        env.close()


def _succeeds(agent: Any, env: gym.Env[Any, Any], seed: int) -> bool:
    observation, info = env.reset(seed=seed)
    over = False
    while not (over or info["is_success"]):
        action, _ = agent.predict(observation, deterministic=True)
        observation, _, terminated, truncated, info = env.step(action)
        over = terminated or truncated
    return bool(info["is_success"])
