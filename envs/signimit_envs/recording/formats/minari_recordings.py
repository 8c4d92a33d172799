"""Recordings as Minari data sets, with the physics in ``infos``."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from signimit_envs.recording.episodes import BOX, RecordedEpisode, Recording
from signimit_envs.recording.formats.minari_store import create_dataset, import_minari, minari_errors, open_dataset
from signimit_envs.recording.origin import RecordingOrigin
from signimit_envs.recording.replay import check_recording
from signimit_envs.recording.storage import KIND, VERSION, seeds_of

_PHYSICS = "physics"


def write_minari_recording(dataset_id: str, recording: Recording, overwrite: bool = False) -> Path:
    """Write a Minari data set whose `recover_environment` makes the recorded environment.

    ``infos`` has the environment's entries, ``physics/state`` (see `STATE_SPEC`) and ``physics/control``, which has a
    row of zeros at the start.

    Args:
        dataset_id: Name of the data set, e.g. ``"signimit/obey-v0"``.
        recording: The recording.
        overwrite: Replace a data set of that name.

    Returns:
        The folder of the data set.

    Raises:
        InvalidInputError: If the name is not Minari's kind of name, or is taken.
        MissingDependencyError: If Minari is not installed.
    """
    import_minari()
    spec = recording.origin.make_spec()
    with gym.make(spec) as env:
        spaces = {"observation_space": env.observation_space, "action_space": env.action_space}
    header = {
        "kind": KIND,
        "version": VERSION,
        "origin": recording.origin.to_meta(),
        "seeds": [episode.seed for episode in recording],
    }
    buffers = [_buffer(episode, isinstance(spaces["observation_space"], gym.spaces.Dict)) for episode in recording]
    description = "Episodes of signimit's environments with the full physics state; `replay` replays them."
    return create_dataset(dataset_id, buffers, header, overwrite, env=spec, description=description, **spaces)


def read_minari_recording(folder: str | os.PathLike[str]) -> Recording:
    """Read a data set of `write_minari_recording`.

    Raises:
        FileFormatError: If it is half written or not a recording of signimit.
        MissingDependencyError: If Minari is not installed.
    """
    dataset, header = open_dataset(folder, KIND, VERSION)
    origin = RecordingOrigin.from_meta(header.get("origin"), os.fspath(folder))
    seeds = seeds_of(header.get("seeds"), dataset.total_episodes, os.fspath(folder))
    with minari_errors(folder):
        episodes = zip(dataset.iterate_episodes(), seeds, strict=True)
        recording = Recording(origin, [_episode(data, seed) for data, seed in episodes])
    return check_recording(recording, os.fspath(folder))


def _buffer(episode: RecordedEpisode, named: bool) -> Any:
    """Return an episode as Minari takes it; ``named`` where observations are a `Dict`."""
    from minari.data_collector import EpisodeBuffer

    start = np.zeros((1, episode.controls.shape[1]))
    physics = {"state": episode.states, "control": np.concatenate([start, episode.controls])}
    return EpisodeBuffer(
        seed=episode.seed,
        observations=dict(episode.observations) if named else episode.observations[BOX],
        actions=episode.actions,
        rewards=episode.rewards,
        terminations=episode.terminations,
        truncations=episode.truncations,
        infos={**episode.infos, _PHYSICS: physics},
    )


def _episode(data: Any, seed: int | None) -> RecordedEpisode:
    """Return an episode that Minari has read."""
    infos: dict[str, Any] = dict(data.infos)
    physics: dict[str, NDArray[np.float64]] = infos.pop(_PHYSICS)
    return RecordedEpisode(
        observations=data.observations if isinstance(data.observations, dict) else {BOX: data.observations},
        actions=data.actions,
        rewards=data.rewards,
        terminations=data.terminations,
        truncations=data.truncations,
        infos=infos,
        states=physics["state"],
        controls=physics["control"][1:],
        seed=seed,
    )
