"""What is recorded is what happened."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import signimit as si
from signimit.teaching.languages import Request
from signimit.teaching.sessions import Command
from signimit_envs import ENV_IDS, RenderingError, TabletopHandEnv, reproduce
from signimit_envs.recording import (
    STATE_SPEC,
    EpisodeRecorder,
    Recording,
    find_divergence,
    load_recording,
    record_reproductions,
    save_recording,
)
from signimit_envs.recording.episodes import episode_arrays, episode_from_arrays

Same = Callable[[Recording, Recording], None]


@pytest.mark.parametrize("env_id", ENV_IDS)
def test_a_recorded_episode_is_what_the_agent_saw_did_and_got(env_id: str) -> None:
    with closing(EpisodeRecorder(gym.make(env_id))) as env:
        arm: Any = env.unwrapped
        seen = [env.reset(seed=3)]
        done = []
        for k in range(12):
            action = np.full(env.action_space.shape or (), 0.1 * np.sin(k), np.float32)
            *outcome, info = env.step(action)
            seen.append((outcome[0], info))
            done.append((action, *outcome[1:], arm.data.ctrl.copy(), arm.data.time))
        (episode,) = env.recording
    assert len(episode) == 12
    assert episode.seed == 3
    for name in ("hand", "joints", "objects", "signs"):
        np.testing.assert_array_equal(episode.observations[name], [o[name] for o, _ in seen])
    np.testing.assert_array_equal(episode.infos["request"], [tuple(i["request"]) for _, i in seen])
    np.testing.assert_array_equal(episode.infos["is_success"], [i["is_success"] for _, i in seen])
    actions, rewards, terminated, truncated, controls, times = zip(*done, strict=True)
    np.testing.assert_array_equal(episode.actions, actions)
    np.testing.assert_array_equal(episode.rewards, rewards)
    np.testing.assert_array_equal(episode.terminations, terminated)
    np.testing.assert_array_equal(episode.truncations, truncated)
    np.testing.assert_array_equal(episode.controls, controls)
    assert np.ptp(episode.controls, axis=0).min() > 0
    np.testing.assert_array_equal(episode.states[1:, 0], times)  # a state begins with its time


def test_the_state_holds_where_the_objects_are(recording: Recording) -> None:
    model = recording.origin.compile_model()
    data = mujoco.MjData(model)
    mujoco.mj_setState(model, data, recording[0].states[7], STATE_SPEC)
    np.testing.assert_array_equal(data.mocap_pos[:, :2], recording[0].observations["objects"][7])


def test_each_reset_begins_an_episode_and_one_without_steps_is_none(recording: Recording) -> None:
    assert [len(episode) for episode in recording] == [40, 25]
    assert [episode.seed for episode in recording] == [5, None]
    with closing(EpisodeRecorder(gym.make(ENV_IDS[0]))) as env:
        env.reset()
        env.reset()
        with pytest.raises(si.InvalidInputError, match="recording: expected at least one, found none"):
            _ = env.recording
        with pytest.raises(si.UnknownNameError):
            env.reset(options={"wheels": 4})
        with pytest.raises(si.InvalidInputError, match="expected a reset before the first step, found none"):
            env.step(np.zeros(3, np.float32))


def test_an_observation_that_is_one_array_is_recorded_too() -> None:
    env = gym.wrappers.FlattenObservation(gym.make(ENV_IDS[1]))
    with closing(EpisodeRecorder(env)) as recorder:
        first, _ = recorder.reset(seed=0)
        recorder.step(np.zeros(2, np.float32))
        (episode,) = recorder.recording
    np.testing.assert_array_equal(episode.observations["observation"][0], first)


@pytest.mark.parametrize(("control", "obs_type"), [("joint", "state"), ("joint", "pixels"), ("hand", "state_pixels")])
def test_whatever_is_observed_and_commanded_is_recorded_and_replays(
    control: str, obs_type: str, tmp_path: Path, assert_same: Same
) -> None:
    options: dict[str, Any] = {"control": control, "obs_type": obs_type, "size": (32, 48), "objects": 2}
    with closing(EpisodeRecorder(gym.make(ENV_IDS[0], **options))) as env:
        try:
            seen = [env.reset(seed=1)[0]]
        except RenderingError as error:
            pytest.skip(str(error))
        for _ in range(3):
            seen.append(env.step(0.3 * env.action_space.sample())[0])
        recording = env.recording
    assert find_divergence(recording.origin, recording[0]) is None
    pictures = [o if obs_type == "pixels" else o.get("pixels") for o in seen]
    if pictures[0] is not None:
        name = "observation" if obs_type == "pixels" else "pixels"
        np.testing.assert_array_equal(recording[0].observations[name], pictures)
    save_recording(tmp_path / "r.npz", recording)
    assert_same(load_recording(tmp_path / "r.npz"), recording)
    with closing(gym.make(recording.origin.make_spec())) as again:
        assert again.observation_space == env.observation_space


def test_a_recording_knows_the_environment_with_its_arguments_and_wrappers(recording: Recording) -> None:
    spec = recording.origin.make_spec()
    assert spec.id == "signimit/TabletopHand-v0"
    assert spec.kwargs == {"objects": 4, "camera": "top"}
    with closing(gym.make(spec)) as env:
        assert env.unwrapped.model.nmocap == 4  # type: ignore[attr-defined]


@pytest.mark.parametrize("entry", ["os:system", "subprocess:run"])
def test_a_specification_that_names_foreign_code_is_refused(recording: Recording, entry: str) -> None:
    hostile = recording.origin.env_spec.replace("signimit_envs.tabletop_hand:TabletopHandEnv", entry)
    origin = type(recording.origin)(env_spec=hostile, model_xml="<mujoco/>", assets={})
    with pytest.raises(si.SignimitError, match="expected code of signimit_envs or gymnasium, found"):
        origin.make_spec()


def test_what_cannot_be_recorded_is_refused_in_one_sentence() -> None:
    with pytest.raises(si.InvalidInputError, match="expected one of signimit's, found CartPoleEnv"):
        EpisodeRecorder(gym.make("CartPole-v1"))
    with pytest.raises(si.InvalidInputError, match=r"gymnasium\.make made, found one without"):
        EpisodeRecorder(TabletopHandEnv())
    env = gym.make(ENV_IDS[1])
    env.unwrapped.model.body_mass[3] *= 2  # type: ignore[attr-defined]
    with pytest.raises(si.InvalidInputError, match="the model as it was compiled, found one that was changed"):
        EpisodeRecorder(env)


def test_recorded_arrays_cannot_be_written_to_and_must_fit(recording: Recording) -> None:
    arrays = episode_arrays(recording[0])
    assert not any(array.flags.writeable for array in arrays.values())
    with pytest.raises(si.InvalidInputError, match="actions: expected numbers for 40 steps"):
        episode_from_arrays({**arrays, "actions": arrays["actions"][1:]}, None)
    broken = arrays["states"].copy()
    broken[3, 1] = np.nan
    with pytest.raises(si.InvalidInputError, match="states: expected finite numbers, found others at step 3"):
        episode_from_arrays({**arrays, "states": broken}, None)
    wider = {**arrays, "controls": np.zeros((40, 5))}
    with pytest.raises(
        si.InvalidInputError,
        match=r"controls: expected rows of float64 of shape \(3,\) as in episode 0",
    ):
        Recording(recording.origin, [recording[0], episode_from_arrays(wider, None)])


def test_a_reproduction_is_recorded_as_it_happens_without_a_recorder() -> None:
    rng = np.random.default_rng(1)
    times = np.arange(0.0, 3.0, 0.02)
    objects = np.array([[-0.2, 0.05], [0.2, 0.0]])
    strokes = [np.cumsum(rng.normal(size=(30, 2)), axis=0) for _ in range(4)]
    demonstrations = [
        si.Demonstration(
            (strokes[focus], strokes[2 + movement]),
            objects,
            objects[focus] + 0.08 * np.column_stack([np.cos(4 * times), (1 - 2 * movement) * np.sin(4 * times)]),
            times,
        )
        for focus, movement in [(0, 0), (0, 1), (1, 0), (1, 1)] * 2
    ]
    model = si.learn(si.DemonstrationSet(demonstrations), rng=0)
    command = Command(Request(0, 1), (strokes[1], strokes[2]), objects, np.array([0.1, -0.1]))
    recording = record_reproductions(model, [command], 2.0, si.Language(focus_signs=("1", "2")))
    (episode,) = recording
    assert len(episode) == 100
    assert episode.truncations[-1]
    assert tuple(episode.infos["request"][0]) == (0, 1)
    policy = model.respond(command.signs, objects).policy
    with closing(TabletopHandEnv(objects=2)) as env:
        track = reproduce(env, policy, objects, [0.1, -0.1], 2.0)
    np.testing.assert_allclose(episode.observations["hand"], track.path, atol=1e-6)  # actions are rounded to float32


def whole_episodes(recording: Recording, lengths: list[int]) -> None:
    """Fail unless the episodes have these lengths, end where they say so, and replay."""
    assert [len(episode) for episode in recording] == lengths
    for episode in recording:
        ends = (episode.terminations | episode.truncations).tolist()
        assert ends == [False] * (len(episode) - 1) + [True]
        assert (episode.observations["objects"] == episode.observations["objects"][0]).all()
        assert episode.states[0, 0] == 0.0  # the time
        assert find_divergence(recording.origin, episode) is None


def test_an_episode_ends_where_it_is_truncated_outside_of_autoreset_too() -> None:
    env = gym.make(ENV_IDS[1], max_episode_steps=3)
    with closing(EpisodeRecorder(gym.wrappers.Autoreset(env))) as recorder:
        first, _ = recorder.reset(seed=0)
        seen = [recorder.step(recorder.action_space.sample()) for _ in range(11)]
        recording = recorder.recording
    whole_episodes(recording, [3, 3, 3])  # and three resets, but for the first, took the place of a step
    assert [episode.seed for episode in recording] == [0, None, None]
    starts = [first["signs"], seen[3][0]["signs"], seen[7][0]["signs"]]
    for episode, signs in zip(recording, starts, strict=True):
        np.testing.assert_array_equal(episode.observations["signs"][0], signs)


@pytest.mark.parametrize("mode", gym.vector.AutoresetMode)
def test_an_episode_ends_where_it_is_truncated_in_all_modes_of_vector_environments(
    mode: gym.vector.AutoresetMode,
) -> None:
    """Two environments, with episodes of three and of five steps."""
    limits = iter((3, 5))
    many = gym.vector.SyncVectorEnv(
        [lambda: EpisodeRecorder(gym.make(ENV_IDS[1], max_episode_steps=next(limits)))] * 2, autoreset_mode=mode
    )
    many.reset(seed=4)
    for _ in range(15):
        *_, truncated, _ = many.step(many.action_space.sample())
        if mode == gym.vector.AutoresetMode.DISABLED and truncated.any():
            many.reset(options={"reset_mask": truncated})
    expected = {
        gym.vector.AutoresetMode.NEXT_STEP: ([3] * 4, [5] * 2),  # a reset takes the place of a step
        gym.vector.AutoresetMode.SAME_STEP: ([3] * 5, [5] * 3),
        gym.vector.AutoresetMode.DISABLED: ([3] * 5, [5] * 3),
    }[mode]
    for recorder, lengths in zip(many.envs, expected, strict=True):
        recording = recorder.get_wrapper_attr("recording")
        kept = [episode for episode in recording if (episode.truncations | episode.terminations).any()]
        whole_episodes(Recording(recording.origin, kept), lengths)
    many.close()


def test_steps_after_the_end_and_before_a_reset_belong_to_no_episode() -> None:
    with closing(EpisodeRecorder(gym.make(ENV_IDS[1], max_episode_steps=3))) as recorder:
        for seed in (1, 2):
            recorder.reset(seed=seed)
            for _ in range(7):
                recorder.step(recorder.action_space.sample())
        whole_episodes(recorder.recording, [3, 3])


def test_an_episode_ends_where_the_physics_blows_up_and_the_next_one_is_whole() -> None:
    with closing(EpisodeRecorder(gym.wrappers.Autoreset(gym.make(ENV_IDS[0], max_episode_steps=4)))) as recorder:
        arm: Any = recorder.unwrapped
        recorder.reset(seed=0)
        recorder.step(np.zeros(3))
        for _ in range(2):
            arm.data.qvel[:] = 1e12
            *_, terminated, _, info = recorder.step(np.zeros(3))
            assert terminated
            assert info["physics_error"]
            for _ in range(5):  # a reset and four steps, then another reset
                recorder.step(np.zeros(3))
            recorder.step(np.zeros(3))
        whole_episodes(recorder.recording, [2, 4, 1, 4])


def test_a_wrapper_that_resets_before_the_last_state_is_seen_is_refused() -> None:
    class SameStep(gym.Wrapper[Any, Any, Any, Any]):
        def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
            observation, reward, terminated, truncated, info = self.env.step(action)
            if truncated:
                observation, info = self.env.reset()
            return observation, reward, terminated, truncated, info

    with closing(EpisodeRecorder(SameStep(gym.make(ENV_IDS[1], max_episode_steps=3)))) as recorder:
        recorder.reset(seed=0)
        recorder.step(np.zeros(2))
        recorder.step(np.zeros(2))
        with pytest.raises(si.InvalidInputError, match="inside of wrappers that reset an environment in the step"):
            recorder.step(np.zeros(2))
        assert [len(episode) for episode in recorder.recording] == [2]
