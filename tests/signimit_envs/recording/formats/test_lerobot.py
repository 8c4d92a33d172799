"""LeRobot's layout holds everything: tables, statistics, videos whose frames are the states, and all comes back."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import gymnasium as gym
import imageio_ffmpeg
import numpy as np
import pytest

import signimit as si
from signimit_envs import RenderingError
from signimit_envs.recording import EpisodeRecorder, Recording, film_states
from signimit_envs.recording.episodes import episode_arrays, episode_from_arrays
from signimit_envs.recording.formats.lerobot import layout
from signimit_envs.recording.formats.lerobot.demonstrations import (
    read_lerobot_demonstrations,
    write_lerobot_demonstrations,
)
from signimit_envs.recording.formats.lerobot.recordings import read_lerobot_recording, write_lerobot_recording

parquet = pytest.importorskip("pyarrow.parquet")
Same = Callable[[Recording, Recording], None]
EPISODES = "meta/episodes/chunk-000/file-000.parquet"
DATA = "data/chunk-000/file-000.parquet"
# Two rows whose size statistics are damaged: pyarrow 26 ends the process where they are looked at as metadata.
DAMAGED = (
    "UEFSMRUAFSwVLCwVBBUAFQYVBhwYCAEAAAAAAAAAGAgAAAAAAAAAABYAKAgBAAAAAAAAABgIAAAAAAAAAAAREQAAAAIAAAAEAQAAAAAAAAAA"
    "AQAAAAAAAAAVABU4FTgsFQQVABUGFQYcGAgAAAAAAAAAQBgIAAAAAAAA8D8WACgIAAAAAAAAAEAYCAAAAAAAAPA/EREAAAACAAAABAACAAAA"
    "BAMAAAAAAADwPwAAAAAAAABAFQQZXDUAGAZzY2hlbWEVBAAVBCkCGAVpbmRleAA1AhgBeBUCFQZMPAAAADUEGARsaXN0FQIAFQolAhgHZWxl"
    "bWVudAAWBBkcGSwmABwVBBklBgAZGAVpbmRleBUAFgQWqgEWqgEmCDwYCAEAAAAAAAAAGAgAAAAAAAAAABYAKAgBAAAAAAAAABgIAAAAAAAA"
    "AAAREQAZHBUAFQAVAgA8KQYZJgAEAAAAJgAcFQoZJQYAGTgBeARsaXN0B2VsZW1lbnQVABYEFrYBFrYBJrIBPBgIAAAAAAAAAEAYCAAAAAAA"
    "APA/FgAoCAAAAAAAAABAGAgAAAAAAADwPxERABkcFQAVABUCADwpJgQAGUYAAAAEAAAAFuACFgQmCBbgAgAoIHBhcnF1ZXQtY3BwLWFycm93"
    "IHZlcnNpb24gMjYuMC4xGSwcAAAcAAAASgEAAFBBUjE="
)


@pytest.fixture
def stored(recording: Recording, tmp_path: Path) -> Path:
    write_lerobot_recording(tmp_path / "set", recording, cameras=())
    return tmp_path / "set"


def info_of(folder: Path) -> dict[str, Any]:
    info: dict[str, Any] = json.loads((folder / "meta/info.json").read_text())
    return info


def test_a_recording_comes_back_bit_for_bit(stored: Path, recording: Recording, assert_same: Same) -> None:
    assert_same(read_lerobot_recording(stored), recording)


def test_every_row_of_the_tables_says_what_the_recording_does(stored: Path, recording: Recording) -> None:
    rows = parquet.read_table(stored / DATA).to_pylist()
    assert [row["index"] for row in rows] == list(range(65))
    assert [row["frame_index"] for row in rows] == [*range(40), *range(25)]
    assert [row["episode_index"] for row in rows] == [0] * 40 + [1] * 25
    np.testing.assert_allclose([row["timestamp"] for row in rows], [row["frame_index"] / 50 for row in rows], rtol=1e-6)
    seen, row = recording[1].observations, rows[40 + 7]
    state = [seen[name][7] for name in ("hand", "hand_velocity", "joint_velocities", "joints")]
    np.testing.assert_array_equal(row["observation.state"], np.concatenate(state))
    np.testing.assert_array_equal(row["observation.environment_state"][:8], seen["objects"][7].ravel())
    np.testing.assert_array_equal(np.float32(row["action"]), recording[1].actions[7])
    np.testing.assert_array_equal(row["physics.state"], recording[1].states[7])
    first, second = parquet.read_table(stored / EPISODES).to_pylist()
    assert (first["dataset_from_index"], first["dataset_to_index"], first["length"]) == (0, 40, 40)
    assert (second["dataset_from_index"], second["dataset_to_index"], second["length"]) == (40, 65, 25)
    assert first["tasks"] == second["tasks"]


def test_the_info_describes_the_tables(stored: Path) -> None:
    info = info_of(stored)
    assert (info["codebase_version"], info["fps"]) == ("v3.0", 50)
    assert (info["total_episodes"], info["total_frames"], info["splits"]) == (2, 65, {"train": "0:2"})
    schema = parquet.read_schema(stored / DATA)
    assert set(schema.names) == set(info["features"])
    for name, feature in info["features"].items():
        (width,) = feature["shape"]
        kind = schema.field(name).type
        assert getattr(kind, "list_size", 1) == width, name
        assert (
            str(getattr(kind, "value_type", kind)).replace("double", "float64").replace("float", "float")[:3]
            == (feature["dtype"][:3])
        )
    assert info["features"]["observation.state"]["names"][:2] == ["observations.hand_x_m", "observations.hand_y_m"]
    assert info["data_path"].format(chunk_index=0, file_index=0) == DATA


def test_the_task_tells_nothing_of_the_request(stored: Path) -> None:
    table = parquet.read_table(stored / "meta/tasks.parquet")
    assert table.to_pylist() == [{"task_index": 0, "task": "Do what the two signs ask for."}]
    assert json.loads(table.schema.metadata[b"pandas"])["index_columns"] == ["task"]


def test_statistics_are_those_of_the_frames(stored: Path, recording: Recording) -> None:
    stats = json.loads((stored / "meta/stats.json").read_text())["action"]
    actions = np.concatenate([episode.actions for episode in recording]).astype(float)
    for name in ("min", "max", "mean", "std"):
        np.testing.assert_allclose(stats[name], getattr(actions, name)(axis=0))
    np.testing.assert_allclose(stats["q90"], np.quantile(actions, 0.9, axis=0))
    assert stats["count"] == [65]
    (first, _) = parquet.read_table(stored / EPISODES).to_pylist()
    np.testing.assert_allclose(first["stats/action/mean"], recording[0].actions.astype(float).mean(axis=0))


def first_steps(recording: Recording, steps: int) -> Recording:
    """Cut every episode after some steps."""
    episodes = []
    for episode in recording:
        arrays = episode_arrays(episode).items()
        cut = {name: array[: steps + len(array) - len(episode)] for name, array in arrays}
        episodes.append(episode_from_arrays(cut, episode.seed))
    return Recording(recording.origin, episodes)


def test_videos_show_the_states_at_the_times_that_are_written(recording: Recording, tmp_path: Path) -> None:
    recording, size = first_steps(recording, 12), (64, 48)
    try:
        write_lerobot_recording(tmp_path / "set", recording, cameras=["top"], size=size)
    except RenderingError as error:
        pytest.skip(str(error))
    video = tmp_path / "set/videos/observation.images.top/chunk-000/file-000.mp4"
    command = [
        imageio_ffmpeg.get_ffmpeg_exe(),
        "-v",
        "error",
        "-i",
        str(video),
        "-f",
        "rawvideo",
        "-pix_fmt",
        "rgb24",
        "-",
    ]
    raw = subprocess.run(command, capture_output=True, check=True).stdout
    frames = np.frombuffer(raw, np.uint8).reshape(-1, 48, 64, 3)
    assert frames.shape == (24, 48, 64, 3)
    rows = parquet.read_table(tmp_path / "set" / EPISODES).to_pylist()
    for row, episode in zip(rows, recording, strict=True):
        begin, end = (row[f"videos/observation.images.top/{side}_timestamp"] for side in ("from", "to"))
        assert round((end - begin) * 50) == row["length"]
        for step, drawn in enumerate(film_states(recording.origin, episode, "top", size)):
            if step in (0, 6, 11):
                apart = np.abs(frames.astype(int) - drawn).mean(axis=(1, 2, 3))
                assert abs(int(apart.argmin()) - round(begin * 50) - step) <= 1
                assert apart.min() < 8  # levels of 255, lost to compression
    feature = info_of(tmp_path / "set")["features"]["observation.images.top"]
    assert (feature["dtype"], feature["shape"], feature["info"]["video.codec"]) == ("video", [48, 64, 3], "h264")
    mean = json.loads((tmp_path / "set/meta/stats.json").read_text())["observation.images.top"]["mean"]
    np.testing.assert_allclose(np.ravel(mean), frames.mean(axis=(0, 1, 2)) / 255, atol=0.03)
    read_lerobot_recording(tmp_path / "set")


class Pixels(gym.ObservationWrapper[Any, Any, Any]):
    def __init__(self, env: gym.Env[Any, Any]) -> None:
        super().__init__(env)
        self.observation_space = gym.spaces.Dict({"pixels": gym.spaces.Box(0, 255, (12, 16, 3), np.uint8)})
        self._rng = np.random.default_rng(0)

    def observation(self, observation: Any) -> Any:
        return {"pixels": self._rng.integers(0, 256, (12, 16, 3), dtype=np.uint8)}


def test_observed_pixels_are_kept_without_loss(tmp_path: Path, assert_same: Same) -> None:
    with closing(EpisodeRecorder(Pixels(gym.make("signimit/Tabletop-v0")))) as env:
        env.reset(seed=0)
        for _ in range(4):
            env.step(np.zeros(3, np.float32))
        recording = env.recording
    write_lerobot_recording(tmp_path / "set", recording, cameras=())
    feature = info_of(tmp_path / "set")["features"]["observation.images.pixels"]
    assert (feature["dtype"], feature["shape"]) == ("image", [12, 16, 3])
    assert_same(read_lerobot_recording(tmp_path / "set"), recording)
    stats = json.loads((tmp_path / "set/meta/stats.json").read_text())["observation.images.pixels"]
    assert np.shape(stats["mean"]) == (3, 1, 1)


def test_many_episodes_are_spread_over_files(
    recording: Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, assert_same: Same
) -> None:
    monkeypatch.setattr(layout, "DATA_MB", 0.05)
    monkeypatch.setattr(layout, "FILES_A_CHUNK", 2)
    many = Recording(recording.origin, [recording[k % 2] for k in range(5)])
    write_lerobot_recording(tmp_path / "set", many, cameras=())
    files = sorted(path.relative_to(tmp_path / "set").as_posix() for path in (tmp_path / "set/data").rglob("*.parquet"))
    assert len(files) > 2
    assert files[2] == "data/chunk-001/file-000.parquet"
    rows = parquet.read_table(tmp_path / "set" / EPISODES).to_pylist()
    for row in rows:
        path = info_of(tmp_path / "set")["data_path"].format(
            chunk_index=row["data/chunk_index"], file_index=row["data/file_index"]
        )
        assert row["dataset_from_index"] in parquet.read_table(tmp_path / "set" / path).column("index").to_pylist()
    assert_same(read_lerobot_recording(tmp_path / "set"), many)


def test_demonstrations_come_back_bit_for_bit(demonstrations: si.DemonstrationSet, tmp_path: Path) -> None:
    write_lerobot_demonstrations(tmp_path / "set", demonstrations)
    again = read_lerobot_demonstrations(tmp_path / "set").to_arrays()
    for name, array in demonstrations.to_arrays().items():
        assert again[name].tobytes() == array.tobytes(), name
    assert info_of(tmp_path / "set")["fps"] == 50


def test_an_uneven_clock_has_no_place_there(demonstrations: si.DemonstrationSet, tmp_path: Path) -> None:
    one = demonstrations[1]
    times = one.times.copy()
    times[7] += 0.003
    uneven = si.DemonstrationSet([demonstrations[0], si.Demonstration(one.signs, one.objects, one.hand, times)])
    with pytest.raises(
        si.InvalidInputError, match=r"demonstration 1: times: expected samples every 1/50 s.*at index 7"
    ):
        write_lerobot_demonstrations(tmp_path / "set", uneven)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("file", "complaint"),
    [
        (DATA, "expected chunk-000/file-000.parquet, found none"),
        (EPISODES, "expected chunk-000/file-000.parquet, found none"),
        ("meta/info.json", "expected a whole LeRobot data set"),
        ("meta/signimit/recording.json", "expected a whole recording of signimit"),
        ("meta/signimit/model.xml", "expected a whole recording of signimit"),
    ],
)
def test_a_half_written_data_set_is_refused_in_one_sentence(stored: Path, file: str, complaint: str) -> None:
    path = stored / file
    if path.suffix == ".parquet":
        whole = path.read_bytes()
        path.write_bytes(whole[: len(whole) // 2])
        with pytest.raises(si.SignimitError, match="expected a whole LeRobot data set, found Arrow") as refusal:
            read_lerobot_recording(stored)
        assert "\n" not in str(refusal.value)
    path.unlink()
    with pytest.raises(si.SignimitError) as refusal:
        read_lerobot_recording(stored)
    assert complaint in str(refusal.value)


def test_a_table_of_more_numbers_than_memory_is_refused(stored: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A column that repeats one number takes hardly a byte for a million."""
    monkeypatch.setattr("signimit_envs.recording.formats.lerobot.frames.MAX_BYTES", 8 * 1000)
    with pytest.raises(si.SignimitError, match="expected at most 8000 bytes of numbers, found more"):
        read_lerobot_recording(stored)


def test_damaged_statistics_of_a_table_are_refused_and_do_not_end_the_process(stored: Path) -> None:
    (stored / DATA).write_bytes(base64.b64decode(DAMAGED))
    with pytest.raises(si.SignimitError, match="expected a whole LeRobot data set, found OSError"):
        read_lerobot_recording(stored)


def test_missing_frames_and_other_versions_are_noticed(stored: Path, demonstrations: si.DemonstrationSet) -> None:
    table = parquet.read_table(stored / DATA)
    parquet.write_table(table.slice(0, 60), stored / DATA)
    with pytest.raises(si.SignimitError, match=r"expected 65 frames, as info\.json says, found 60"):
        read_lerobot_recording(stored)
    info = info_of(stored)
    (stored / "meta/info.json").write_text(json.dumps({**info, "codebase_version": "v2.1"}))
    with pytest.raises(si.SignimitError, match=r"expected a LeRobot data set of version 3, found v2\.1"):
        read_lerobot_recording(stored)
    with pytest.raises(
        si.SignimitError, match="expected a demonstration set of version <= 1, found recording version 1"
    ):
        read_lerobot_demonstrations(stored)


def test_without_opengl_there_are_no_videos_and_all_else_is_there(
    recording: Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, assert_same: Same
) -> None:
    def no_backend() -> str:
        raise RenderingError("no OpenGL library was found", "Install one.")

    monkeypatch.setattr("signimit_envs.recording.formats.lerobot.recordings.choose_backend", no_backend)
    monkeypatch.setattr("signimit_envs.video.rendering.choose_backend", no_backend)
    write_lerobot_recording(tmp_path / "set", recording)
    assert info_of(tmp_path / "set")["video_path"] is None
    assert_same(read_lerobot_recording(tmp_path / "set"), recording)
    with pytest.raises(RenderingError):
        write_lerobot_recording(tmp_path / "other", recording, cameras=["top"])
    assert [path.name for path in tmp_path.iterdir()] == ["set"]


def test_a_replaced_data_set_keeps_nothing_of_the_old_one(stored: Path, recording: Recording) -> None:
    shutil.copy(stored / DATA, stored / "data/chunk-000/file-001.parquet")
    with pytest.raises(si.InvalidInputError, match="overwrite"):
        write_lerobot_recording(stored, recording, cameras=())
    write_lerobot_recording(stored, recording[:1], overwrite=True, cameras=())
    assert len(read_lerobot_recording(stored)) == 1
