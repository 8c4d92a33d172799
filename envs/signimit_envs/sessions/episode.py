"""An episode of an environment in which a model obeys: what was observed is all that it is told."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, Response, run_policy
from signimit.display import one_line
from signimit_envs.arm.scene import hand_action
from signimit_envs.sessions.reproduction import hand_controlled

_LONGEST = 600.0  # s of an environment that never ends an episode by itself


class Imitator(Protocol):
    """What answers an utterance in a scene, e.g. a `signimit.ImitationModel`."""

    def respond(self, signs: Sequence[ArrayLike], objects: ArrayLike) -> Response:
        """Answer, as `signimit.ImitationModel.respond` does."""
        ...


@one_line
class Episode(NamedTuple):
    """What happened in an episode.

    Attributes:
        response: What was understood, and the policy that moved the hand.
        path: Where the hand was at the start and after every control step, shape (T + 1, 2), m, table frame.
        reward: Sum of all rewards.
        info: The ``info`` of the last step: ``request``, ``is_success``, ``performance`` and so on.
    """

    response: Response
    path: NDArray[np.float64]
    reward: float
    info: dict[str, Any]


def run_episode(
    env: gym.Env[Any, Any], model: Imitator, *, seed: int | None = None, options: Mapping[str, Any] | None = None
) -> Episode:
    """Let a model obey for one episode, from a reset until the environment ends it.

    The model sees the observed signs and objects and nothing of the request behind them. Wrappers see every step, so
    that the episode can be filmed and recorded.

    Args:
        env: ``signimit/TabletopHand-v0``, or another with ``control="hand"`` and a state observed, wrapped or not; it
            is not closed.
        model: Who obeys.
        seed: Seed of the reset.
        options: Options of the reset, e.g. ``{"movement": 2, "focus": 0}``; what they leave out is drawn.

    Raises:
        InvalidInputError: If the environment is another one, or the model learned with another number of signs or
            objects.
    """
    arm = hand_controlled(env)
    observation, info = env.reset(seed=seed, options=None if options is None else dict(options))
    if not isinstance(observation, Mapping) or not {"signs", "objects"} <= set(observation):
        raise InvalidInputError("observation", "a dict with signs and objects, as of obs_type='state'", "another")
    response = model.respond(list(observation["signs"]), observation["objects"])
    rewards: list[float] = []
    ended = False

    def step_environment(_: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64] | None:
        nonlocal info, ended
        if ended:
            return None
        _, reward, terminated, truncated, info = env.step(hand_action(velocity))
        rewards.append(float(reward))
        ended = terminated or truncated
        return arm.hand

    path = run_policy(response.policy, arm.hand, _LONGEST, step_environment)
    return Episode(response, path, float(sum(rewards)), info)
