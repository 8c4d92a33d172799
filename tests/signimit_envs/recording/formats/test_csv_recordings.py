"""A recording comes back from CSV tables bit for bit; a wrong cell is named."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np
import pytest

import signimit as si
from signimit_envs.recording import EpisodeRecorder, Recording
from signimit_envs.recording.episodes import episode_arrays, episode_from_arrays
from signimit_envs.recording.formats.csv_recordings import read_csv_recording, write_csv_recording

Same = Callable[[Recording, Recording], None]


def test_a_recording_comes_back_bit_for_bit(recording: Recording, tmp_path: Path, assert_same: Same) -> None:
    write_csv_recording(tmp_path / "r", recording)
    assert_same(read_csv_recording(tmp_path / "r"), recording)


def test_numbers_of_every_kind_come_back(recording: Recording, tmp_path: Path, assert_same: Same) -> None:
    rng = np.random.default_rng(0)
    arrays = episode_arrays(recording[0])
    strange = {
        "observations.byte": rng.integers(0, 256, (41, 2, 2), dtype=np.uint8),
        "observations.zero": np.where(rng.random(41) < 0.5, 0.0, -0.0),
        "infos.large": rng.integers(-(2**62), 2**62, 41),
        "infos.lost": np.array([np.nan, np.inf, -np.inf] + 38 * [1e-310]),
        "infos.half": rng.normal(size=41).astype(np.float16),
    }
    odd = Recording(recording.origin, [episode_from_arrays({**arrays, **strange}, 2**63)])
    write_csv_recording(tmp_path / "r", odd)
    assert_same(read_csv_recording(tmp_path / "r"), odd)


def test_what_stays_the_same_is_written_once_an_episode(recording: Recording, tmp_path: Path) -> None:
    write_csv_recording(tmp_path / "r", recording)
    steps, episodes = ((tmp_path / "r" / name).read_text().splitlines() for name in ("steps.csv", "episodes.csv"))
    assert "observations.objects_3_y_m" in episodes[0].split(",")
    assert not any("objects" in column for column in steps[0].split(","))
    assert {"observations.hand_x_m", "observations.joints_2_rad", "actions_1"} <= set(steps[0].split(","))
    assert len(steps) == 1 + 41 + 26
    assert len(episodes) == 3


@pytest.mark.parametrize(
    ("table", "line", "old", "new", "complaint"),
    [
        ("steps.csv", 3, "0,1,", "0,2,", "steps.csv, line 3, column step: expected 1, found '2'"),
        ("steps.csv", 3, "0,1,", "0,1,x", "steps.csv, line 3, column observations.hand_x_m: expected a finite number"),
        ("steps.csv", 43, "1,0,", "0,41,", "steps.csv, line 43, column episode: expected 1, found '0'"),
        ("episodes.csv", 2, "0,40,", "0,39,", "steps.csv, line 41, column actions_0: expected nothing in an episode's"),
        (
            "episodes.csv",
            3,
            "1,25,",
            "1,26,",
            "steps.csv, line 68, column actions_0: expected a finite number, found ''",
        ),
        ("steps.csv", 68, "1,25,", None, "steps.csv: expected step 25 of episode 1, found the end of the file"),
        ("episodes.csv", 3, "1,25,", "1,0,", "column steps: expected at least 1, found '0'"),
    ],
)
def test_a_wrong_cell_is_named(
    recording: Recording, tmp_path: Path, table: str, line: int, old: str, new: str | None, complaint: str
) -> None:
    write_csv_recording(tmp_path / "r", recording)
    path = tmp_path / "r" / table
    lines = path.read_text().splitlines(keepends=True)
    assert lines[line - 1].startswith(old)
    lines[line - 1] = new + lines[line - 1][len(old) :] if new is not None else ""
    path.write_text("".join(lines))
    with pytest.raises(si.SignimitError) as refusal:
        read_csv_recording(tmp_path / "r")
    assert complaint in str(refusal.value)


def test_a_half_written_folder_is_refused(recording: Recording, tmp_path: Path) -> None:
    write_csv_recording(tmp_path / "r", recording)
    for name, complaint in (
        ("wood.png", "expected the asset"),
        ("episodes.csv", r"expected a table episodes\.csv, found none"),
        ("model.xml", "expected a whole recording of signimit"),
    ):
        data = (tmp_path / "r" / name).read_bytes()
        (tmp_path / "r" / name).unlink()
        with pytest.raises(si.SignimitError, match=complaint):
            read_csv_recording(tmp_path / "r")
        (tmp_path / "r" / name).write_bytes(data)
    read_csv_recording(tmp_path / "r")


@pytest.mark.parametrize("name", ["../secret", "/etc/passwd", "model.xml"])
def test_an_asset_is_never_looked_for_elsewhere(recording: Recording, tmp_path: Path, name: str) -> None:
    write_csv_recording(tmp_path / "r", recording)
    path = tmp_path / "r" / "recording.json"
    header = json.loads(path.read_text())
    header["origin"]["assets"] = [name]
    path.write_text(json.dumps(header))
    with pytest.raises(si.SignimitError, match="expected assets beside it"):
        read_csv_recording(tmp_path / "r")


class Pixels(gym.ObservationWrapper[Any, Any, Any]):
    def __init__(self, env: gym.Env[Any, Any]) -> None:
        super().__init__(env)
        self.observation_space = gym.spaces.Box(0, 255, (80, 80, 3), np.uint8)

    def observation(self, observation: Any) -> Any:
        return np.zeros((80, 80, 3), np.uint8)


@pytest.mark.parametrize(
    ("dtype", "given", "told"),
    [
        ("u1", "256", "uint8, 0 to 255"),
        ("i2", "-32769", "int16, -32768 to 32767"),
        ("i8", "9223372036854775808", "int64, -9223372036854775808 to 9223372036854775807"),
        ("f2", "65505", "float16, -65504.0 to 65504.0"),
        ("f2", "1e300", "float16, -65504.0 to 65504.0"),
        ("f4", "2e+256", "float32, -3.4028234663852886e+38 to 3.4028234663852886e+38"),
        (">f4", "-3.5e38", "float32, -3.4028234663852886e+38 to 3.4028234663852886e+38"),
    ],
)
def test_a_number_that_its_type_cannot_hold_is_named(
    recording: Recording, tmp_path: Path, dtype: str, given: str, told: str
) -> None:
    arrays = episode_arrays(recording[0])
    small = {**arrays, "observations.odd": np.arange(41).astype(dtype)}
    write_csv_recording(tmp_path / "r", Recording(recording.origin, [episode_from_arrays(small, None)]))
    path = tmp_path / "r" / "steps.csv"
    lines = path.read_text().splitlines()
    column = lines[0].split(",").index("observations.odd")
    cells = lines[5].split(",")
    lines[5] = ",".join([*cells[:column], given, *cells[column + 1 :]])
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(si.FileFormatError) as refusal:
        read_csv_recording(tmp_path / "r")
    assert f"line 6, column observations.odd: expected {told}, found '{given}'" in str(refusal.value)


@pytest.mark.parametrize(
    ("key", "value", "complaint"),
    [
        ("constant", 5, "expected a list, found int"),
        ("fields", {"states": ["<f8", [2**40, 2**40]]}, "expected a field of numbers"),
        ("fields", {"states": ["<f8", [20_000]]}, "expected at most 10000 numbers a step"),
        ("fields", {"states": ["O", [2]]}, "expected a field of numbers"),
        ("fields", None, "expected the types and shapes of a recording"),
        ("version", 2, "expected a recording of version <= 1, found recording version 2"),
    ],
)
def test_a_header_that_cannot_be_is_refused(
    recording: Recording, tmp_path: Path, key: str, value: object, complaint: str
) -> None:
    write_csv_recording(tmp_path / "r", recording)
    path = tmp_path / "r" / "recording.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), key: value}))
    with pytest.raises(si.SignimitError, match=complaint):
        read_csv_recording(tmp_path / "r")


def test_pixels_are_too_many_columns(tmp_path: Path) -> None:
    with closing(EpisodeRecorder(Pixels(gym.make("signimit/Tabletop-v0")))) as env:
        env.reset()
        env.step(np.zeros(3, np.float32))
        with pytest.raises(si.InvalidInputError, match="expected at most 10000 numbers a step"):
            write_csv_recording(tmp_path / "r", env.recording)
    assert list(tmp_path.iterdir()) == []
