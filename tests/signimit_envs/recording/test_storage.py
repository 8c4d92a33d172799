"""A recording loads back bit for bit, and a broken file is refused in one sentence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signimit as si
from signimit.io.archive import write_archive
from signimit_envs.recording import Recording, load_recording, save_recording

Same = Callable[[Recording, Recording], None]


def test_a_recording_loads_back_bit_for_bit_and_the_same_gives_the_same_bytes(
    recording: Recording, tmp_path: Path, assert_same: Same
) -> None:
    save_recording(tmp_path / "a.npz", recording)
    again = load_recording(tmp_path / "a.npz")
    assert_same(again, recording)
    save_recording(tmp_path / "b.npz", again)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_a_half_written_file_is_refused(recording: Recording, tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    save_recording(path, recording)
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(si.SignimitError, match="expected a signimit recording file"):
        load_recording(path)


@pytest.mark.parametrize(
    ("name", "value", "complaint"),
    [
        ("steps", [40, 26], "expected numbers for 66 steps"),
        ("steps", [65, 0], "expected numbers for 65 steps"),
        ("states", None, "episode 0: episode: expected an array 'states', found none"),
        ("controls", np.full((65, 3), np.inf), "episode 0: controls: expected finite numbers"),
        ("controls", np.full((65, 3), "1.5"), "episode 0: controls: expected numbers for 40 steps, found <U3 of shape"),
        ("rewards", np.zeros(65, np.complex128), "episode 0: rewards: expected numbers for 40 steps, found complex128"),
        ("states", np.full((67, 30), 1e200), "episode 0: states: expected finite numbers"),
        ("rewards", np.full(65, np.longdouble("1e4000")), "episode 0: rewards: expected finite numbers"),
        ("terminations", np.zeros((65, 2), bool), "episode 0: terminations: expected shape (40,), found shape (40, 2)"),
        ("wheels", np.zeros(65), "expected the fields of an episode, found 'wheels'"),
    ],
)
def test_a_file_that_contradicts_itself_is_refused_by_field(
    recording: Recording, tmp_path: Path, name: str, value: object, complaint: str
) -> None:
    path = tmp_path / "a.npz"
    save_recording(path, recording)
    with np.load(path) as archive:
        arrays = dict(archive)
    header = arrays.pop("signimit")
    if value is None:
        del arrays[name]
    else:
        arrays[name] = np.asarray(value)
    np.savez(path, signimit=header, **arrays)
    with pytest.raises(si.SignimitError) as refusal:
        load_recording(path)
    assert complaint in str(refusal.value)
    assert "a.npz" in str(refusal.value)


def test_a_header_without_a_model_is_refused(tmp_path: Path) -> None:
    write_archive(tmp_path / "a.npz", "recording", 1, {"steps": np.array([1]), "rewards": np.zeros(1)}, {"seeds": [0]})
    with pytest.raises(si.SignimitError, match="expected the environment and model of a recording"):
        load_recording(tmp_path / "a.npz")


@pytest.mark.parametrize("seed", [-1, 0.5, "7"])
def test_a_seed_that_no_environment_takes_is_refused(recording: Recording, seed: Any) -> None:
    with pytest.raises(si.InvalidInputError, match="seed: expected a whole number, 0 or more, or none, found"):
        replace(recording[0], seed=seed)
