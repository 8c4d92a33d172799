"""Films of episodes: one file each, whole, and only of what was asked for."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Any

import gymnasium as gym
import imageio_ffmpeg
import numpy as np
import pytest
from gymnasium.envs.registration import EnvSpec

import signimit
from signimit_envs.video.record_mp4 import RecordMp4


class Painted(gym.Env[Any, Any]):
    """An environment whose frames tell the step; needs no OpenGL."""

    metadata = {"render_modes": ["rgb_array"], "render_fps": 50}  # noqa: RUF012 -- gymnasium declares it so
    observation_space = gym.spaces.Box(0, 1)
    action_space = gym.spaces.Box(0, 1)

    def __init__(self, render_mode: str | None = "rgb_array") -> None:
        self.render_mode = render_mode

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        self.count = 0
        return np.zeros(1, np.float32), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self.count += 1
        return np.zeros(1, np.float32), 0.0, self.count == 4, False, {}

    def render(self) -> Any:
        return np.full((48, 64, 3), 20 * self.count, np.uint8)


def frames(path: Path) -> list[int]:
    decode = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(decode, capture_output=True, check=True)
    assert b"50 fps" in done.stderr
    images = np.frombuffer(done.stdout, np.uint8).reshape(-1, 48 * 64 * 3)
    return [round(image.mean() / 20) for image in images]


def test_each_episode_has_a_film_of_all_its_frames(tmp_path: Path) -> None:
    env = RecordMp4(Painted(), tmp_path / "deep" / "films")
    for _ in range(2):
        env.reset()
        for _ in range(4):
            env.step(None)
    assert frames(tmp_path / "deep/films/episode-0000.mp4") == [0, 1, 2, 3, 4]  # there already, before the close
    env.reset()
    env.step(None)
    env.close()
    env.close()
    assert frames(tmp_path / "deep/films/episode-0002.mp4") == [0, 1]
    assert len(os.listdir(tmp_path / "deep/films")) == 3


def test_an_episode_that_is_cut_off_is_filmed_so_far_and_others_are_left_out(tmp_path: Path) -> None:
    env = RecordMp4(Painted(), tmp_path, every=2, prefix="try")
    for _ in range(4):
        env.reset()
        env.step(None)
    env.close()
    assert sorted(os.listdir(tmp_path)) == ["try-0000.mp4", "try-0002.mp4"]
    assert frames(tmp_path / "try-0000.mp4") == [0, 1]


def test_what_cannot_be_filmed_is_refused(tmp_path: Path) -> None:
    with pytest.raises(signimit.InvalidInputError, match="render mode to film: expected 'rgb_array', found None"):
        RecordMp4(Painted(None), tmp_path)
    with pytest.raises(signimit.InvalidInputError, match="every: expected at least 1, found 0"):
        RecordMp4(Painted(), tmp_path, every=0)


def test_a_frame_that_cannot_be_drawn_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    painted = Painted()
    env = RecordMp4(painted, tmp_path)
    monkeypatch.setattr(painted, "render", lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        env.reset()
    env.close()
    assert os.listdir(tmp_path) == []


def test_the_recorder_is_part_of_a_specification(tmp_path: Path) -> None:
    env = RecordMp4(gym.make("signimit/Tabletop-v0", render_mode="rgb_array"), tmp_path)
    assert env.spec is not None
    again = gym.make(EnvSpec.from_json(env.spec.to_json()))
    assert isinstance(again, RecordMp4)
    again.close()
    env.close()
