"""Minari's own loader finds what was written, the environment is recovered, and everything comes back."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import signimit as si
from signimit_envs.recording import Recording
from signimit_envs.recording.formats.minari_demonstrations import (
    read_minari_demonstrations,
    write_minari_demonstrations,
)
from signimit_envs.recording.formats.minari_recordings import read_minari_recording, write_minari_recording

minari = pytest.importorskip("minari")
h5py = pytest.importorskip("h5py")
Same = Callable[[Recording, Recording], None]
NAME = "signimit/test-v0"


@pytest.fixture
def stored(recording: Recording, minari_root: Path) -> Path:
    return write_minari_recording(NAME, recording)


def test_a_recording_comes_back_bit_for_bit(stored: Path, recording: Recording, assert_same: Same) -> None:
    assert_same(read_minari_recording(stored), recording)


def test_minari_loads_it_and_sees_the_same(stored: Path, recording: Recording) -> None:
    dataset = minari.load_dataset(NAME)
    assert list(minari.list_local_datasets()) == [NAME]
    assert (dataset.total_episodes, dataset.total_steps) == (2, 65)
    for data, episode in zip(dataset.iterate_episodes(), recording, strict=True):
        assert data.observations.keys() == episode.observations.keys()
        for name, array in episode.observations.items():
            np.testing.assert_array_equal(data.observations[name], array)
        for field in ("actions", "rewards", "terminations", "truncations"):
            np.testing.assert_array_equal(getattr(data, field), getattr(episode, field))
        np.testing.assert_array_equal(data.infos["physics"]["state"], episode.states)
        np.testing.assert_array_equal(data.infos["physics"]["control"][1:], episode.controls)
        assert dataset.observation_space.contains({name: array[3] for name, array in data.observations.items()})


def test_the_environment_is_recovered_and_does_the_same(stored: Path, recording: Recording) -> None:
    with closing(minari.load_dataset(NAME).recover_environment()) as env:
        assert env.spec.id == "signimit/TabletopHand-v0"
        assert env.spec.kwargs["objects"] == env.unwrapped.model.nmocap == 4
        first, _ = env.reset(seed=recording[0].seed)
        np.testing.assert_array_equal(first["signs"], recording[0].observations["signs"][0])
        for step, action in enumerate(recording[0].actions):
            observation, *_ = env.step(action)
            np.testing.assert_array_equal(observation["hand"], recording[0].observations["hand"][step + 1])


def test_demonstrations_come_back_bit_for_bit(demonstrations: si.DemonstrationSet, minari_root: Path) -> None:
    again = read_minari_demonstrations(write_minari_demonstrations(NAME, demonstrations)).to_arrays()
    for name, array in demonstrations.to_arrays().items():
        assert again[name].tobytes() == array.tobytes(), name
    dataset = minari.load_dataset(NAME)
    with closing(dataset.recover_environment()) as env:
        assert env.unwrapped.model.nmocap == 3
        speed = env.unwrapped.max_hand_speed
    first, one = dataset[0], demonstrations[0]
    moved = np.cumsum(first.actions * speed * np.diff(one.times)[:, None], axis=0)
    np.testing.assert_allclose(one.hand[0] + moved, one.hand[1:])


def test_to_write_demonstrations_leaves_the_registered_environment_alone(
    demonstrations: si.DemonstrationSet, minari_root: Path
) -> None:
    gym = pytest.importorskip("gymnasium")
    write_minari_demonstrations(NAME, demonstrations)
    assert gym.spec("signimit/TabletopHand-v0").kwargs == {}


def test_a_data_set_is_replaced_only_on_request(stored: Path, recording: Recording) -> None:
    with pytest.raises(si.InvalidInputError, match="no data set of that name yet"):
        write_minari_recording(NAME, recording)
    write_minari_recording(NAME, recording[:1], overwrite=True)
    assert minari.load_dataset(NAME).total_episodes == 1
    assert [path.name for path in stored.parent.iterdir() if path.is_dir()] == ["test-v0"]


def test_what_breaks_off_leaves_nothing(
    recording: Recording, minari_root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(minari, "create_dataset_from_buffers", broken)
    with pytest.raises(OSError, match="No space left"):
        write_minari_recording(NAME, recording)
    assert [path for path in minari_root.rglob("*") if path.is_dir()] == [minari_root / "signimit"]
    assert os.environ["MINARI_DATASETS_PATH"] == str(minari_root)


def test_a_disk_that_is_full_or_fails_is_told_as_for_any_file(
    recording: Recording, minari_root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """HDF5 has errors of its own, and tells of each object that it could not write: room is looked for beforehand."""
    full = minari_root / "signimit" / "full-v0"
    with monkeypatch.context() as patch:
        patch.setattr("shutil.disk_usage", lambda path: SimpleNamespace(free=1000))
        with pytest.raises(OSError, match="No space left") as error:
            write_minari_recording("signimit/full-v0", recording)
    assert error.value.filename == str(full)

    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("Can't decrement id ref count")

    monkeypatch.setattr(minari, "create_dataset_from_buffers", broken)
    with pytest.raises(OSError, match="Input/output error") as error:
        write_minari_recording("signimit/full-v0", recording)
    assert error.value.filename == str(full)
    assert not any(path.is_dir() for path in (minari_root / "signimit").iterdir())


def test_promises_that_a_file_cannot_keep_are_refused(stored: Path) -> None:
    """Numbers that were never written take no room in HDF5, and episodes are counted in the metadata."""
    file = stored / "data" / "metadata.json"
    metadata = json.loads(file.read_text())
    file.write_text(json.dumps({**metadata, "total_episodes": 10**9}))
    with pytest.raises(si.SignimitError, match="expected 1000000000 episodes, as its metadata says, found 2"):
        read_minari_recording(stored)
    file.write_text(json.dumps(metadata))
    with h5py.File(stored / "data" / "main_data.hdf5", "r+") as data:
        del data["episode_0/rewards"]
        data.create_dataset("episode_0/rewards", (10**12,), chunks=(1000,), dtype="f8")
    with pytest.raises(si.SignimitError, match="bytes unpacked, found 80000"):
        read_minari_recording(stored)


@pytest.mark.parametrize("size", [0, 100_000])
def test_a_half_written_data_set_is_refused_in_one_sentence(stored: Path, size: int) -> None:
    os.truncate(stored / "data" / "main_data.hdf5", size)
    with pytest.raises(si.SignimitError, match="expected a whole Minari data set, found") as refusal:
        read_minari_recording(stored)
    assert "\n" not in str(refusal.value)


def test_foreign_data_sets_are_refused(
    stored: Path, demonstrations: si.DemonstrationSet, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(
        si.SignimitError, match="a demonstration set of signimit, version <= 1, found recording version"
    ):
        read_minari_demonstrations(stored)
    (stored / "data" / "metadata.json").write_text('{"data_format": "hdf5", "env_spec": "{}"}')
    with pytest.raises(si.SignimitError, match="expected a whole Minari data set with a recording of signimit"):
        read_minari_recording(stored)
    with pytest.raises(si.InvalidInputError, match=r"expected a name like signimit/obey-v0, found '\.\./up'"):
        write_minari_demonstrations("../up", demonstrations)
