"""Demonstrations as Minari data sets, with the observations of the environment."""

from __future__ import annotations

import copy
import os
from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np

from signimit.demonstrations import KIND, VERSION, Demonstration, DemonstrationSet
from signimit.signs import SAMPLES, normalised_sign
from signimit_envs.arm.scene import OBJECT_COUNTS
from signimit_envs.recording.formats.minari_store import create_dataset, import_minari, minari_errors, open_dataset
from signimit_envs.tabletop.reset_options import WORDS
from signimit_envs.tabletop_hand import TabletopHandEnv

_ENV_ID = "signimit/TabletopHand-v0"
_MARGIN = 1e-9  # that the bounds of spaces leave to the largest number


def write_minari_demonstrations(dataset_id: str, demonstrations: DemonstrationSet, overwrite: bool = False) -> Path:
    """Write a Minari data set, one episode a demonstration.

    Observations are ``hand`` (2,), m, ``objects`` (O, 2), m, and ``signs`` (W, 64, 2), resampled and scaled as in the
    environment; actions the hand's mean velocity until the next sample, in units of
    `TabletopHandEnv.max_hand_speed`. ``infos`` has ``time``, s, and the signs as they were drawn, ``sign_0`` and so on.
    `recover_environment` makes ``signimit/TabletopHand-v0`` where the environment has such objects and signs.

    Args:
        dataset_id: Name of the data set, e.g. ``"signimit/demonstrations-v0"``.
        demonstrations: The demonstrations.
        overwrite: Replace a data set of that name.

    Returns:
        The folder of the data set.

    Raises:
        InvalidInputError: If the name is not Minari's kind of name, or is taken.
        MissingDependencyError: If Minari is not installed.
    """
    import_minari()
    buffers = [_buffer(one) for one in demonstrations]
    count, words = len(demonstrations[0].objects), len(demonstrations[0].signs)
    spec = None
    if count in OBJECT_COUNTS and words == WORDS:
        spec = copy.deepcopy(gym.spec(_ENV_ID))  # gym.spec returns the registered one itself
        spec.kwargs["objects"] = count
    header = {"kind": KIND, "version": VERSION}
    observation_boxes: dict[str, gym.Space[Any]] = {
        "hand": _box(max(float(np.abs(path).max()) for path in demonstrations.paths), 2),
        "objects": _box(float(np.abs(demonstrations.objects).max()), count, 2),
        "signs": _box(1.0, words, SAMPLES, 2),
    }
    spaces = {
        "observation_space": gym.spaces.Dict(observation_boxes),
        "action_space": _box(max(1.0, *(float(np.abs(buffer.actions).max()) for buffer in buffers)), 2),
    }
    description = "Demonstrations to signimit: two signs, objects and a hand that answers; nobody labelled them."
    return create_dataset(dataset_id, buffers, header, overwrite, env=spec, description=description, **spaces)


def read_minari_demonstrations(folder: str | os.PathLike[str]) -> DemonstrationSet:
    """Read a data set of `write_minari_demonstrations`.

    Raises:
        FileFormatError: If it is half written or not a demonstration set of signimit.
        MissingDependencyError: If Minari is not installed.
    """
    dataset, _ = open_dataset(folder, KIND, VERSION)
    with minari_errors(folder):
        demonstrations = []
        for data in dataset.iterate_episodes():
            observed, infos = data.observations, data.infos
            signs = tuple(infos[f"sign_{number}"] for number in range(observed["signs"].shape[1]))
            demonstrations.append(Demonstration(signs, observed["objects"][0], observed["hand"], infos["time"]))
        return DemonstrationSet(demonstrations)


def _buffer(one: Demonstration) -> Any:
    """Return a demonstration as an episode that Minari takes."""
    from minari.data_collector import EpisodeBuffer

    steps, samples = len(one.hand) - 1, len(one.hand)
    signs = np.stack([normalised_sign(sign) for sign in one.signs])
    velocities = np.diff(one.hand, axis=0) / np.diff(one.times)[:, None]
    last = np.arange(steps) == steps - 1
    return EpisodeBuffer(
        observations={
            "hand": one.hand,
            "objects": np.broadcast_to(one.objects, (samples, *one.objects.shape)),
            "signs": np.broadcast_to(signs, (samples, *signs.shape)),
        },
        actions=velocities / TabletopHandEnv.max_hand_speed,
        rewards=np.zeros(steps),
        terminations=np.zeros(steps, dtype=bool),
        truncations=last,
        infos={"time": one.times, **{f"sign_{number}": sign for number, sign in enumerate(one.signs)}},
    )


def _box(limit: float, *shape: int) -> gym.spaces.Box:
    """Return the space of numbers from -``limit`` to ``limit``."""
    bound = np.full(shape, limit + _MARGIN)
    return gym.spaces.Box(-bound, bound, shape, np.float64)
