#!/usr/bin/env python3
"""Train a reinforcement-learning agent, and say how often it does what signs ask for."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any, Literal

from signimit.io.safe_files import whole_files
from signimit_envs.cli.command_line import run_program
from signimit_envs.cli.training import TrainingPlan, evaluate_agent, train_ppo
from signimit_envs.video.record_mp4 import RecordMp4


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


if __name__ == "__main__":
    run_program(main)
