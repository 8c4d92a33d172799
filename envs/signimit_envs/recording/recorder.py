"""A Gymnasium wrapper that keeps everything that happens."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit_envs.recording.episodes import BOX, RecordedEpisode, Recording
from signimit_envs.recording.origin import STATE_SPEC, RecordingOrigin


class EpisodeRecorder(gym.Wrapper[Any, Any, Any, Any]):
    """Records the episodes of ``signimit/Tabletop-v0`` or ``signimit/TabletopHand-v0``, whatever they observe.

    Put it outside all wrappers whose effect shall be in the recording::

        env = EpisodeRecorder(gym.make("signimit/TabletopHand-v0"))
        ...  # reset and step as ever
        save_recording("episodes.npz", env.recording)
    """

    def __init__(self, env: gym.Env[Any, Any]) -> None:
        """Describe the environment.

        Raises:
            InvalidInputError: If it cannot be described (see `RecordingOrigin.of`), or observes something else than
                arrays, or a flat `Dict` of arrays.
        """
        super().__init__(env)
        self._origin = RecordingOrigin.of(env)
        _check_space(env.observation_space)
        arm: Any = env.unwrapped
        self._model, self._data = arm.model, arm.data
        self._finished: list[RecordedEpisode] = []
        self._draft: _Draft | None = None

    @property
    def recording(self) -> Recording:
        """All episodes so far in which a step was made, the current one included.

        Raises:
            InvalidInputError: If there are none yet.
        """
        current = [self._draft.episode()] if self._draft and self._draft.actions else []
        return Recording(self._origin, [*self._finished, *current])

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Start an episode, as the environment does."""
        if self._draft and self._draft.actions:
            self._finished.append(self._draft.episode())
        self._draft = None
        observation, info = self.env.reset(seed=seed, options=options)
        self._draft = _Draft(seed)
        self._draft.see(observation, info, self._state())
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Do a step, as the environment does.

        Raises:
            InvalidInputError: If there was no reset, or the last one failed.
        """
        draft, given = self._draft, np.array(action)
        if draft is None:
            raise InvalidInputError("recorder", "a reset before the first step", "none")
        observation, reward, terminated, truncated, info = self.env.step(action)
        draft.see(observation, info, self._state())
        draft.actions.append(given)
        draft.controls.append(self._data.ctrl.copy())
        draft.outcomes.append((float(reward), bool(terminated), bool(truncated)))
        return observation, reward, terminated, truncated, info

    def _state(self) -> NDArray[np.float64]:
        state = np.empty(mujoco.mj_stateSize(self._model, STATE_SPEC))
        mujoco.mj_getState(self._model, self._data, state, STATE_SPEC)
        return state


class _Draft:
    """An episode as it grows."""

    def __init__(self, seed: int | None) -> None:
        self.seed = seed
        self.observations: list[Mapping[str, NDArray[Any]]] = []
        self.infos: list[dict[str, NDArray[Any]]] = []
        self.states: list[NDArray[np.float64]] = []
        self.actions: list[NDArray[Any]] = []
        self.controls: list[NDArray[np.float64]] = []
        self.outcomes: list[tuple[float, bool, bool]] = []

    def see(self, observation: Any, info: dict[str, Any], state: NDArray[np.float64]) -> None:
        """Add what is seen at the start or after a step."""
        named = observation if isinstance(observation, Mapping) else {BOX: observation}
        self.observations.append({name: np.array(value) for name, value in named.items()})
        self.infos.append({name: array for name, value in info.items() if (array := _numbers(value)) is not None})
        self.states.append(state)

    def episode(self) -> RecordedEpisode:
        """Return the episode so far."""
        rewards, terminations, truncations = zip(*self.outcomes, strict=True)
        return RecordedEpisode(
            observations=_stacked(self.observations),
            actions=np.stack(self.actions),
            rewards=np.array(rewards),
            terminations=np.array(terminations),
            truncations=np.array(truncations),
            infos=_stacked(self.infos),
            states=np.stack(self.states),
            controls=np.stack(self.controls),
            seed=self.seed,
        )


def _numbers(value: Any) -> NDArray[Any] | None:
    """Return a value as an array if it is numbers, and some."""
    try:
        array = np.array(value)
    except ValueError:  # ragged
        return None
    return array if array.dtype.kind in "biuf" and array.size else None


def _stacked(steps: list[Any]) -> dict[str, NDArray[Any]]:
    """Stack those entries that are there at every step in one shape."""
    return {
        name: np.stack([step[name] for step in steps])
        for name, first in steps[0].items()
        if all(name in step and step[name].shape == first.shape for step in steps)
    }


def _check_space(space: gym.Space[Any]) -> None:
    parts = space.spaces if isinstance(space, gym.spaces.Dict) else {BOX: space}
    for name, part in parts.items():
        if not isinstance(part, gym.spaces.Box | gym.spaces.Discrete | gym.spaces.MultiBinary):
            expected = "arrays, or a flat Dict of arrays (gymnasium.wrappers.FlattenObservation makes one array)"
            raise InvalidInputError(f"observation space: {name}", expected, type(part).__name__)
