"""Recorder: a Gymnasium wrapper that records episodes with their physics states, and recordings of a model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import closing
from dataclasses import asdict
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.learning import ImitationModel
from signimit.policies import CONTROL_PERIOD, run_policy
from signimit.policies.closed_loop import count_steps
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.sessions import Command
from signimit_envs.arm.scene import hand_action
from signimit_envs.recording.episodes import BOX, RecordedEpisode, Recording
from signimit_envs.recording.origin import STATE_SPEC, RecordingOrigin

ENV_ID = "signimit_envs:signimit/TabletopHand-v0"


class EpisodeRecorder(gym.Wrapper[Any, Any, Any, Any]):
    """Gymnasium wrapper that records episodes of signimit's environments with any observation of arrays.

    Put it outside all wrappers whose effect is to be recorded::

        env = EpisodeRecorder(gym.make("signimit/TabletopHand-v0"))
        ...  # reset and step as ever
        save_recording("episodes.npz", env.recording)

    An episode ends where it is terminated or truncated, or else by a reset. The next one begins with a reset, also with
    one that `gymnasium.wrappers.Autoreset` inside does in the place of a step. Steps after the end and before a reset
    belong to no episode, and are not recorded.
    """

    def __init__(self, env: gym.Env[Any, Any]) -> None:
        """Record an environment.

        Raises:
            InvalidInputError: If it cannot be described (see `RecordingOrigin.of`), or its observations are neither an
                array nor a flat `Dict` of arrays.
        """
        super().__init__(env)
        self._origin = RecordingOrigin.of(env)
        space = env.observation_space
        for name, part in (space.spaces if isinstance(space, gym.spaces.Dict) else {BOX: space}).items():
            if not isinstance(part, gym.spaces.Box | gym.spaces.Discrete | gym.spaces.MultiBinary):
                expected = "arrays, or a flat Dict of arrays (gymnasium.wrappers.FlattenObservation makes one array)"
                raise InvalidInputError(f"observation space: {name}", expected, type(part).__name__)
        arm: Any = env.unwrapped
        self._model, self._data = arm.model, arm.data
        self._finished: list[RecordedEpisode] = []
        self._draft: _Draft | None = None  # of the current episode; none after its end
        self._ready = False  # whether the environment was reset

    @property
    def recording(self) -> Recording:
        """All episodes so far that have a step, the current one included.

        Raises:
            InvalidInputError: If there are no such episodes yet.
        """
        current = [self._draft.episode()] if self._draft and self._draft.actions else []
        return Recording(self._origin, [*self._finished, *current])

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Start an episode; arguments and results are the environment's."""
        self._finish()
        self._ready = False
        observation, info = self.env.reset(seed=seed, options=options)
        self._begin(seed, observation, info)
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Do a control step; arguments and results are the environment's.

        Raises:
            InvalidInputError: If there was no reset, or the last one failed, or a wrapper inside has reset the
                environment before the step's last state was seen.
        """
        if not self._ready:
            raise InvalidInputError("recorder", "a reset before the first step", "none")
        given = np.array(action)
        observation, reward, terminated, truncated, info = self.env.step(action)
        over, draft = bool(terminated or truncated), self._draft
        # A reset sets the clock to 0, and so does the arm when the physics blows up.
        was_reset = self._data.time == 0.0 and not info.get("physics_error")
        if draft is None:
            if was_reset and not over:
                self._begin(None, observation, info)
        elif was_reset:
            self._finish()
            expected = "to be inside of wrappers that reset an environment in the step that ends an episode"
            raise InvalidInputError("recorder", expected, "one outside")
        else:
            draft.see(observation, info, self._state())
            draft.actions.append(given)
            draft.controls.append(self._data.ctrl.copy())
            draft.outcomes.append((float(reward), bool(terminated), bool(truncated)))
            if over:
                self._finish()
        return observation, reward, terminated, truncated, info

    def _begin(self, seed: int | None, observation: Any, info: dict[str, Any]) -> None:
        self._draft, self._ready = _Draft(seed), True
        self._draft.see(observation, info, self._state())

    def _finish(self) -> None:
        """Keep the episode so far, if it has a step."""
        if self._draft and self._draft.actions:
            self._finished.append(self._draft.episode())
        self._draft = None

    def _state(self) -> NDArray[np.float64]:
        state = np.empty(mujoco.mj_stateSize(self._model, STATE_SPEC))
        mujoco.mj_getState(self._model, self._data, state, STATE_SPEC)
        return state


class _Draft:
    """Lists of what was recorded of the current episode."""

    def __init__(self, seed: int | None) -> None:
        self.seed = seed
        self.observations: list[Mapping[str, NDArray[Any]]] = []
        self.infos: list[dict[str, NDArray[Any]]] = []
        self.states: list[NDArray[np.float64]] = []
        self.actions: list[NDArray[Any]] = []
        self.controls: list[NDArray[np.float64]] = []
        self.outcomes: list[tuple[float, bool, bool]] = []

    def see(self, observation: Any, info: dict[str, Any], state: NDArray[np.float64]) -> None:
        """Add observation, info and physics state at the start or after a step."""
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
    """Return a value as an array if it consists of at least one number, else None."""
    try:
        array = np.array(value)
    except ValueError:  # ragged
        return None
    return array if array.dtype.kind in "biuf" and array.size else None


def _stacked(steps: list[Any]) -> dict[str, NDArray[Any]]:
    """Stack the entries that every step has in the same shape."""
    return {
        name: np.stack([step[name] for step in steps])
        for name, first in steps[0].items()
        if all(name in step and step[name].shape == first.shape for step in steps)
    }


def record_reproductions(
    model: ImitationModel, commands: Iterable[Command], seconds: float = 10.0, language: Language = PAPER_LANGUAGE
) -> Recording:
    """Record a model that obeys commands with the simulated arm, one episode each.

    Args:
        model: The model; it is given the signs and the positions of the objects.
        commands: The commands; requests are in ``infos``, judged by the environment's own drawings.
        seconds: Duration of each episode, s.
        language: Language of the commands.

    Raises:
        InvalidInputError: If there are no commands, or one is impossible in the environment.
    """
    if not 0 < seconds <= 600.0:  # a comparison with NaN is false
        raise InvalidInputError("seconds", "above 0, at most 600", f"{seconds}")
    steps = max(1, count_steps(seconds))
    env = gym.make(ENV_ID, max_episode_steps=steps, language=asdict(language))
    with closing(EpisodeRecorder(env)) as recorder:
        for command in commands:
            places = {"objects": command.objects, "hand": command.hand}
            observation, _ = recorder.reset(options={**command.request._asdict(), **places, "signs": command.signs})

            def step_arm(hand: NDArray[np.float64], velocity: NDArray[np.float64]) -> NDArray[np.float64] | None:
                seen, _, terminated, truncated, _ = recorder.step(hand_action(velocity).astype(np.float32))
                return None if terminated or truncated else seen["hand"]

            policy = model.respond(command.signs, command.objects).policy
            run_policy(policy, observation["hand"], steps * CONTROL_PERIOD, step_arm)
        return recorder.recording
