"""Whatever is written in one format is read by name or place, and goes through every other format unharmed."""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import gymnasium as gym
import pytest

import signimit as si
from signimit_envs import RenderingError
from signimit_envs.recording import EpisodeRecorder, Recording
from signimit_envs.recording.formats import FORMATS, read_data, read_recording, write_data

Same = Callable[[Recording, Recording], None]
NEEDED = {"minari": ("minari", "h5py"), "lerobot": ("pyarrow",)}
PLACES = {"npz": "{}.npz", "csv": "{}-tables", "minari": "minari:{}-v0", "lerobot": "{}-lerobot"}


def installed_formats() -> list[str]:
    """Return the formats whose packages are there."""
    return [name for name in FORMATS if all(importlib.util.find_spec(package) for package in NEEDED.get(name, ()))]


def place_for(name: str, what: str, folder: Path) -> str:
    """Return where to write, or skip what cannot be written here."""
    if name not in installed_formats():
        pytest.skip(f"{' or '.join(NEEDED[name])} is not installed")
    place = PLACES[name].format(what)
    return place if name == "minari" else str(folder / place)


@pytest.fixture(autouse=True)
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the videos, which take long and are tested elsewhere."""
    monkeypatch.setattr("signimit_envs.recording.formats.lerobot.recordings._drawable", lambda recording: [])


def test_the_way_through_every_format_changes_nothing(
    recording: Recording, demonstrations: si.DemonstrationSet, tmp_path: Path, minari_root: Path, assert_same: Same
) -> None:
    played, shown = recording, demonstrations
    for name in installed_formats():
        for what, data in (("played", played), ("shown", shown)):
            write_data(place_for(name, what, tmp_path), data, name)
        played = read_recording(place_for(name, "played", tmp_path))
        again = read_data(place_for(name, "shown", tmp_path))
        assert isinstance(again, si.DemonstrationSet)
        shown = again
        assert_same(played, recording)
        for field, array in demonstrations.to_arrays().items():
            assert shown.to_arrays()[field].tobytes() == array.tobytes(), (name, field)


@pytest.mark.parametrize("obs_type", ["pixels", "state_pixels"])
def test_observed_pixels_go_through_every_format_but_tables(
    obs_type: str, tmp_path: Path, minari_root: Path, assert_same: Same
) -> None:
    with closing(EpisodeRecorder(gym.make("signimit/Tabletop-v0", obs_type=obs_type, size=(32, 48)))) as env:
        try:
            env.reset(seed=0)
        except RenderingError as error:
            pytest.skip(str(error))
        for _ in range(2):
            env.step(env.action_space.sample())
        recording = env.recording
    for name in (name for name in installed_formats() if name != "csv"):
        place = place_for(name, "pixels", tmp_path)
        write_data(place, recording, name)
        assert_same(read_recording(place), recording)


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('name="object_1"', 'name="objekt_1"', "a site 'hand' and 4 objects, by name, found no 'object_1'"),
        ('site name="hand"', 'site name="Hand"', "a site 'hand' and 4 objects, by name, found no 'hand'"),
        ('name="object_2" mocap="true"', 'name="object_2"', "numbers, as the model has"),
        ('memory="1M"', 'memory="1"', "expected MJCF that compiles, found Error: engine error: mj_stackAlloc"),
        ('memory="1M"', 'memory="2K"', "recorded model: expected at least 65536 bytes of memory, found 2048"),
        ('gravity="', 'gravitas="', "expected MJCF that compiles, found "),
        ("</worldbody>", "</worldbody><!--", "expected MJCF that compiles, found "),
    ],
)
def test_a_recording_that_cannot_be_replayed_is_not_read(
    recording: Recording, tmp_path: Path, minari_root: Path, name: str, old: str, new: str, told: str
) -> None:
    """Whatever the format: its model has the parts that are observed, under their names, and can be simulated."""
    xml = recording.origin.model_xml.replace("<option ", '<option gravity="0 0 -9.81" ')
    broken = Recording(replace(recording.origin, model_xml=xml.replace(old, new)), recording.episodes)
    assert broken.origin.model_xml != xml
    place = place_for(name, "broken", tmp_path)
    write_data(place, broken, name)
    with pytest.raises(si.FileFormatError, match=re.escape(told)) as refusal:
        read_recording(place)
    assert "broken" in str(refusal.value)


@pytest.mark.parametrize("name", FORMATS)
def test_nothing_is_replaced_unless_on_request(
    demonstrations: si.DemonstrationSet, recording: Recording, tmp_path: Path, minari_root: Path, name: str
) -> None:
    place = place_for(name, "shown", tmp_path)
    write_data(place, demonstrations, name)
    with pytest.raises(si.InvalidInputError, match="overwrite"):
        write_data(place, demonstrations[:1], name)
    assert len(read_data(place)) == 3
    write_data(place, demonstrations[:1], name, overwrite=True)
    assert len(read_data(place)) == 1


@pytest.mark.parametrize("name", [name for name in FORMATS if name in NEEDED])
def test_a_missing_package_is_named_with_the_extra_that_brings_it(
    demonstrations: si.DemonstrationSet,
    recording: Recording,
    tmp_path: Path,
    minari_root: Path,
    name: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, NEEDED[name][0], None)
    for data in (demonstrations, recording):
        with pytest.raises(si.MissingDependencyError, match=rf"pip install 'signimit\[{name}\]'"):
            write_data(str(tmp_path / "set-v0") if name != "minari" else "set-v0", data, name)
    assert not (tmp_path / "set-v0").exists()


def test_what_is_no_data_set_is_refused_in_one_sentence(
    demonstrations: si.DemonstrationSet, tmp_path: Path, minari_root: Path
) -> None:
    with pytest.raises(FileNotFoundError):
        read_data(tmp_path / "none.npz")
    (tmp_path / "empty").mkdir()
    with pytest.raises(si.SignimitError, match=r"expected a whole data set, with one of steps\.csv, hands\.csv"):
        read_data(tmp_path / "empty")
    demonstrations.save(tmp_path / "d.npz")
    with pytest.raises(si.SignimitError, match="expected recorded episodes, found demonstrations"):
        read_recording(tmp_path / "d.npz")
    with pytest.raises(si.UnknownNameError, match="Unknown format 'rlds'; known are npz, csv"):
        write_data(tmp_path / "d", demonstrations, "rlds")
