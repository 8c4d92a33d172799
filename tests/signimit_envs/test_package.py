"""The public names of `signimit_envs`, those of version 0.1.0 among them, and the table in its docstring."""

import importlib
import inspect
import pkgutil
import re

import pytest

import signimit_envs

NAMES_OF_0_1_0 = {
    "signimit_envs": [
        "CONTROL_RATE",
        "ENV_IDS",
        "EPISODE_SECONDS",
        "HandTrack",
        "RecordMp4",
        "RenderingError",
        "TabletopEnv",
        "TabletopHandEnv",
        "reproduce",
    ],
    "signimit_envs.rollout": ["HandTracks", "reproduce_many"],
    "signimit_envs.recording": ["EpisodeRecorder", "Recording", "find_divergence", "load_recording", "save_recording"],
    "signimit_envs.tabletop": ["TabletopEnv"],
    "signimit_envs.tabletop_hand": ["TabletopHandEnv"],
}


@pytest.mark.parametrize("module", NAMES_OF_0_1_0)
def test_names_of_0_1_0_can_be_imported(module: str) -> None:
    for name in NAMES_OF_0_1_0[module]:
        assert hasattr(importlib.import_module(module), name)


def test_public_classes_and_functions_say_what_they_are() -> None:
    for name in signimit_envs.__all__:
        value = getattr(signimit_envs, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            assert (value.__doc__ or "").strip(), name


def test_the_docstring_names_every_room() -> None:
    """Its table has a line for each module and package but those that only hold errors and old names."""
    rooms = {module.name for module in pkgutil.iter_modules(signimit_envs.__path__)} - {"exceptions", "rollout"}
    assert set(re.findall(r"^``(\w+)``", signimit_envs.__doc__ or "", re.MULTILINE)) == rooms
