"""Films of episodes: one file each, whole, and only of what was asked for."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from functools import partial
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


def film(env: RecordMp4, episodes: int, steps: int) -> None:
    for _ in range(episodes):
        env.reset()
        for _ in range(steps):
            env.step(None)
    env.close()


def test_no_two_films_of_a_run_have_the_same_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "films"
    film(RecordMp4(Painted(), folder), 2, 1)
    monkeypatch.chdir(tmp_path)
    film(RecordMp4(Painted(), "films"), 2, 2)  # the same folder
    first, second = RecordMp4(Painted(), folder, prefix="[a]"), RecordMp4(Painted(), folder, prefix="[a]")
    for env in (first, second, second, first):
        env.reset()
        env.step(None)
    first.close()
    second.close()
    assert sorted(os.listdir(folder)) == [f"[a]-000{n}.mp4" for n in range(4)] + [
        f"episode-000{n}.mp4" for n in range(4)
    ]
    assert [frames(folder / f"episode-000{n}.mp4") for n in range(4)] == [[0, 1], [0, 1], [0, 1, 2], [0, 1, 2]]


def test_films_of_an_earlier_run_are_replaced_after_a_warning(tmp_path: Path) -> None:
    """A run is a process."""
    program = (
        "import sys, tests.signimit_envs.video.test_record_mp4 as t\n"
        "t.film(t.RecordMp4(t.Painted(), sys.argv[1]), 2, 1)"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    root = Path(__file__).parents[3]
    said = [
        subprocess.run(
            [sys.executable, "-c", program, str(tmp_path / "films")],
            env=environment, cwd=root, capture_output=True, text=True, check=True,
        ).stderr
        for _ in range(2)
    ]  # fmt: skip
    assert said[0] == ""
    assert said[1].count("WARN: The films") == 1
    assert sorted(os.listdir(tmp_path / "films")) == ["episode-0000.mp4", "episode-0001.mp4"]


def test_films_of_worker_processes_have_names_of_their_own(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "episode-0000.mp4").touch()  # of an earlier run; nothing that workers write replaces it
    with pytest.warns(UserWarning, match="earlier run"):  # by the one that Gymnasium makes here to learn the spaces
        many = gym.vector.AsyncVectorEnv([partial(RecordMp4, Painted(), tmp_path)] * 2, context="spawn")
    many.reset()
    many.close()
    names = sorted(os.listdir(tmp_path))
    assert names.pop(0) == "episode-0000.mp4"
    assert len(names) == 2
    assert all(re.fullmatch(r"episode-\d+-0000\.mp4", name) for name in names)
    assert "earlier run" not in capfd.readouterr().err
    assert [file.name for file in tmp_path.iterdir() if not file.stat().st_size] == ["episode-0000.mp4"]


def test_episodes_that_a_wrapper_inside_begins_are_filmed_too(tmp_path: Path) -> None:
    env = RecordMp4(gym.wrappers.Autoreset(Painted()), tmp_path, every=2)
    env.reset()
    for _ in range(13):  # episodes of four steps, each but the first with a reset for another step
        env.step(None)
    env.close()
    assert sorted(os.listdir(tmp_path)) == ["episode-0000.mp4", "episode-0002.mp4"]
    assert [frames(tmp_path / name) for name in sorted(os.listdir(tmp_path))] == [[0, 1, 2, 3, 4], [0, 1, 2, 3]]
