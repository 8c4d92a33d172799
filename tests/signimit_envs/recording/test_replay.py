"""A recording replays bit for bit, and can be looked at in another way."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace
from typing import Any

import gymnasium as gym
import numpy as np
import pytest

import signimit as si
from signimit_envs import ENV_IDS, RenderingError
from signimit_envs.recording import (
    EpisodeRecorder,
    Recording,
    film_states,
    find_divergence,
    observe_states,
)


def test_every_episode_is_simulated_again_bit_for_bit(recording: Recording) -> None:
    assert [find_divergence(recording.origin, episode) for episode in recording] == [None, None]


@pytest.mark.parametrize("step", [0, 13, 39])
def test_the_first_step_that_differs_is_named(recording: Recording, step: int) -> None:
    controls = recording[0].controls.copy()
    controls[step, 1] += 1e-9
    apart = find_divergence(recording.origin, replace(recording[0], controls=controls))
    assert apart is not None
    assert apart.step == step
    assert 0 < apart.difference < 1e-6


def test_another_model_is_noticed(recording: Recording) -> None:
    heavier = replace(recording.origin, model_xml=recording.origin.model_xml.replace('mass="0.25"', 'mass="0.26"'))
    assert heavier != recording.origin
    apart = find_divergence(heavier, recording[0])
    assert apart is not None
    larger = replace(recording.origin, model_xml=recording.origin.model_xml.replace('name="object_3"', ""))
    assert find_divergence(larger, recording[0]) is None  # a name is not physics
    with pytest.raises(si.SignimitError, match=r"states of .* and controls of 0 numbers, as the model has"):
        find_divergence(replace(recording.origin, model_xml="<mujoco/>"), recording[0])
    with pytest.raises(si.SignimitError, match="recorded model: expected MJCF that compiles"):
        find_divergence(replace(recording.origin, model_xml="<mujoco><nonsense/></mujoco>"), recording[0])


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({'joint="wrist"': 'joint="elbow"'}, None),  # odd, but it can be observed
        ({"object_1": "lamp", 'body name="table"': 'body name="object_1"'}, "objects that are mocap bodies"),
        ({"object_": "thing_"}, "a site 'hand' and 4 objects, by name, found no 'object_0'"),
    ],
)
def test_only_a_tabletop_is_observed(recording: Recording, changes: dict[str, str], told: str | None) -> None:
    xml = recording.origin.model_xml
    for old, new in changes.items():
        assert old in xml
        xml = xml.replace(old, new)
    origin = replace(recording.origin, model_xml=xml)
    if told is None:
        np.testing.assert_array_equal(observe_states(origin, recording[0])["hand"], recording[0].observations["hand"])
        return
    with pytest.raises(si.FileFormatError, match=told):
        observe_states(origin, recording[0])


@pytest.mark.parametrize(
    "line",
    [
        '<replicate count="3000000"><geom size=".1"/></replicate>',
        '<flexcomp name="f" type="grid" count="300 300 300" spacing="1 1 1" dim="3"/>',
        '< composite type="cable" count="1000000 1 1"/>',
    ],
)
def test_a_model_that_would_take_all_memory_is_not_compiled(recording: Recording, line: str) -> None:
    xml = recording.origin.model_xml.replace("<worldbody>", f"<worldbody>{line}")
    with pytest.raises(si.FileFormatError, match="recorded model: expected bodies written one by one, found the el"):
        replace(recording.origin, model_xml=xml).compile_model()


@pytest.mark.parametrize("error", [MemoryError(), RuntimeError("Caught an unknown exception!"), ValueError("XML")])
def test_what_mujoco_says_of_a_model_is_one_sentence(
    recording: Recording, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def fail(*_: Any) -> None:
        raise error

    monkeypatch.setattr("signimit_envs.recording.origin.mujoco.MjModel.from_xml_string", fail)
    with pytest.raises(si.FileFormatError, match=r"recorded model: expected MJCF that compiles, found \w"):
        recording.origin.compile_model()


def test_a_model_without_memory_is_told_in_one_sentence(recording: Recording) -> None:
    """MuJoCo compiles it, and fails in the first posture at the limits of the joints."""
    starved = replace(recording.origin, model_xml=recording.origin.model_xml.replace('memory="1M"', 'memory="2K"'))
    with pytest.raises(si.FileFormatError, match="recorded model: expected at least 65536 bytes of memory, found 2048"):
        find_divergence(starved, recording[0])


@pytest.mark.parametrize("line", ['<include file="/etc/hostname"/>', "<asset><mesh name='a' file = 'a.stl'/></asset>"])
def test_a_model_that_names_files_of_this_disk_is_refused(recording: Recording, line: str) -> None:
    hostile = replace(recording.origin, model_xml=f"<mujoco>{line}</mujoco>")
    with pytest.raises(si.SignimitError, match="expected no files but those recorded with it, found"):
        find_divergence(hostile, recording[0])


def test_a_blow_up_is_passed_over_as_the_environment_did() -> None:
    with closing(EpisodeRecorder(gym.make(ENV_IDS[0]))) as env:
        arm: Any = env.unwrapped
        env.reset(seed=0)
        for _ in range(3):
            env.step(np.full(3, 0.2, np.float32))
        arm.data.qvel[:] = 1e12
        *_, terminated, _, _ = env.step(np.zeros(3, np.float32))
        assert terminated
        (episode,) = env.recording
    assert find_divergence(env.recording.origin, episode) is None


def test_states_show_what_the_agent_observed(recording: Recording) -> None:
    for episode in recording:
        observed = observe_states(recording.origin, episode)
        for name in ("hand", "hand_velocity", "joints", "joint_velocities", "objects"):
            np.testing.assert_array_equal(observed[name], episode.observations[name])
        np.testing.assert_allclose(np.diff(observed["time"]), 0.02)


def test_frames_of_the_states_are_those_of_the_environment(recording: Recording) -> None:
    env = gym.make(ENV_IDS[1], objects=4, camera="top", size=(96, 64), render_mode="rgb_array")
    with closing(env):
        env.reset(seed=5)
        try:
            drawn = [env.render()]
        except RenderingError as error:
            pytest.skip(str(error))
        for action in recording[0].actions[:3]:
            env.step(action)
            drawn.append(env.render())
    frames = film_states(recording.origin, recording[0], "top", (96, 64))
    for expected, frame in zip(drawn, frames, strict=False):
        np.testing.assert_array_equal(frame, expected)
    frames.close()  # type: ignore[attr-defined]
    other = next(film_states(recording.origin, recording[0], "perspective", (96, 64)))
    assert (other != drawn[0]).mean() > 0.2


def test_a_camera_that_the_model_lacks_is_refused_by_name(recording: Recording) -> None:
    with pytest.raises(si.UnknownNameError, match="Unknown camera 'left'; known are top, perspective"):
        next(film_states(recording.origin, recording[0], "left"))


def test_another_version_of_mujoco_gets_one_sentence(recording: Recording) -> None:
    assert recording.origin.version_note() == ""
    note = replace(recording.origin, mujoco_version="3.2.1").version_note()
    assert note.startswith("Recorded with MuJoCo 3.2.1, this is ")
    assert "its states play as they were" in note
