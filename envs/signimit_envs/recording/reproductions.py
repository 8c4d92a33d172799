"""Recordings of a model that obeys: what it was asked, where, and everything that the arm then did."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import closing
from dataclasses import asdict

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.learning import ImitationModel
from signimit.policies import CONTROL_PERIOD, run_policy
from signimit.policies.closed_loop import count_steps
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.sessions import Command
from signimit_envs.arm.scene import hand_action
from signimit_envs.recording.episodes import Recording
from signimit_envs.recording.recorder import EpisodeRecorder

ENV_ID = "signimit_envs:signimit/TabletopHand-v0"


def record_reproductions(
    model: ImitationModel, commands: Iterable[Command], seconds: float = 10.0, language: Language = PAPER_LANGUAGE
) -> Recording:
    """Let a model obey commands with the simulated arm, one episode each.

    Args:
        model: Who obeys. It is given the signs and where the objects are.
        commands: What it is asked; each request is in ``infos``, judged by the environment's own drawings.
        seconds: How long each episode takes.
        language: What the commands are said in.

    Raises:
        InvalidInputError: If there are no commands, or one cannot be made.
    """
    if not 0 < seconds <= 600.0:  # a comparison with NaN is false
        raise InvalidInputError("seconds", "above 0, at most 600", f"{seconds}")
    steps = max(1, count_steps(seconds))
    env = gym.make(ENV_ID, max_episode_steps=steps, language=asdict(language))
    with closing(EpisodeRecorder(env)) as recorder:
        for command in commands:
            _obey(model, command, steps * CONTROL_PERIOD, recorder)
        return recorder.recording


def _obey(model: ImitationModel, command: Command, seconds: float, env: EpisodeRecorder) -> None:
    places = {"objects": command.objects, "hand": command.hand}
    observation, _ = env.reset(options={**command.request._asdict(), **places, "signs": command.signs})

    def step_arm(hand: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64] | None:
        seen, _, terminated, truncated, _ = env.step(hand_action(velocity).astype(np.float32))
        return None if terminated or truncated else seen["hand"]

    run_policy(model.respond(command.signs, command.objects).policy, observation["hand"], seconds, step_arm)
