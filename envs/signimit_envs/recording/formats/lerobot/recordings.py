"""Recordings as LeRobot data sets.

A frame has the observation (``observation.*``, ``info.*``, ``physics.state``), the action then taken and its outcome
(``action``, ``next.*``, ``physics.control``). LeRobot's frames have no place for the observation at an episode's end:
it is in the table of episodes, ``signimit/final/*``. The environment and its model are in ``meta/signimit``.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.io.safe_files import whole_folder
from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.exceptions import RenderingError
from signimit_envs.recording.episodes import RecordedEpisode, Recording, episode_arrays, episode_from_arrays
from signimit_envs.recording.formats.columns import Field, fields_from_meta, fields_of, fields_to_meta, has_last_row
from signimit_envs.recording.formats.lerobot.frames import lerobot_errors, read_layout, write_layout
from signimit_envs.recording.formats.lerobot.layout import (
    IMAGE,
    INFO,
    EpisodeFrames,
    Feature,
    Layout,
    Video,
    import_pyarrow,
)
from signimit_envs.recording.origin import read_origin, write_origin
from signimit_envs.recording.replay import check_recording, film_states
from signimit_envs.recording.storage import KIND, VERSION, seeds_of
from signimit_envs.video.backend import choose_backend

ROBOT = "signimit_planar_arm"
TASK = "Do what the two signs ask for."  # the request itself is not observed
ORIGIN = "meta/signimit"
SIZE = (256, 256)  # pixels, of videos
_FINAL = "signimit/final/"
_FIXED = {
    "actions": "action",
    "rewards": "next.reward",
    "terminations": "next.terminated",
    "truncations": "next.truncated",
    "states": "physics.state",
    "controls": "physics.control",
}
_DERIVED = {"next.done": Feature("bool", (1,), ("done",))}


def write_lerobot_recording(
    folder: str | os.PathLike[str],
    recording: Recording,
    overwrite: bool = False,
    cameras: Sequence[str] | None = None,
    size: tuple[int, int] = SIZE,
) -> None:
    """Write a LeRobot data set, whole or not at all.

    Args:
        folder: Folder of the data set.
        recording: The recording.
        overwrite: Replace an existing LeRobot data set.
        cameras: Cameras whose videos are drawn from the recorded states; left out, all, or none without OpenGL.
        size: Width and height of the videos, pixels, even.

    Raises:
        InvalidInputError: If the name is taken.
        RenderingError: If cameras are asked for, and there is no OpenGL.
        MissingDependencyError: If pyarrow is not installed.
    """
    import_pyarrow()
    groups = _features(fields_of(recording))
    videos = [_video(recording, camera, size) for camera in (_drawable(recording) if cameras is None else cameras)]
    layout = Layout(
        fps=CONTROL_RATE,
        robot=ROBOT,
        task=TASK,
        features={**{name: _feature(fields) for name, fields in groups.items()}, **_DERIVED},
        episodes=[_frames(episode, groups) for episode in recording],
        videos=videos,
    )
    header = {
        "kind": KIND,
        "version": VERSION,
        "fields": fields_to_meta(recording),
        "seeds": [episode.seed for episode in recording],
    }
    with whole_folder(folder, INFO, overwrite) as draft:
        (draft / ORIGIN).mkdir(parents=True)
        write_origin(draft / ORIGIN, recording.origin, header)
        write_layout(draft, layout)


def read_lerobot_recording(folder: str | os.PathLike[str]) -> Recording:
    """Read a data set of `write_lerobot_recording`; its videos are not read, they can be drawn from the states.

    Raises:
        FileFormatError: If it is half written or not a recording of signimit.
        MissingDependencyError: If pyarrow is not installed.
    """
    place = Path(folder)
    origin, header = read_origin(place / ORIGIN, KIND, VERSION)
    groups = _features(fields_from_meta(header.get("fields"), str(place)))
    episodes = read_layout(place, _FINAL)
    seeds = seeds_of(header.get("seeds"), len(episodes), str(place))
    with lerobot_errors(place):
        made = [episode_from_arrays(_arrays(e, groups), seed) for e, seed in zip(episodes, seeds, strict=True)]
        recording = Recording(origin, made)
    return check_recording(recording, str(place))


def _features(fields: Sequence[Field]) -> dict[str, list[Field]]:
    """Return the fields that make each of LeRobot's features, side by side; policies look for some of their names."""
    features: dict[str, list[Field]] = {}
    for field in fields:
        group, _, short = field.name.partition(".")
        if field.name in _FIXED:
            name = _FIXED[field.name]
        elif group == "infos":
            name = f"info.{short}"
        elif _is_image(field):
            name = f"observation.images.{short}"
        elif field.dtype.kind != "f":
            name = f"observation.{short}"
        else:
            name = "observation.state" if len(field.shape) < 2 else "observation.environment_state"
        features.setdefault(name, []).append(field)
    return features


def _is_image(field: Field) -> bool:
    return field.dtype == np.uint8 and len(field.shape) == 3 and field.shape[-1] == 3


def _feature(fields: Sequence[Field]) -> Feature:
    """Return the type of a feature that is made of fields."""
    if _is_image(fields[0]):
        return Feature(IMAGE, fields[0].shape, ("height", "width", "channels"))
    names = [column for field in fields for column in field.columns]
    return Feature(np.result_type(*(field.dtype for field in fields)).name, (len(names),), names)


def _frames(episode: RecordedEpisode, groups: dict[str, list[Field]]) -> EpisodeFrames:
    """Return an episode as frames, the last observation as extras."""
    steps, arrays = len(episode), episode_arrays(episode)
    columns: dict[str, NDArray[Any]] = {}
    for name, fields in groups.items():
        if _is_image(fields[0]):
            columns[name] = arrays[fields[0].name][:steps]
        else:
            columns[name] = np.concatenate([field.flat(arrays[field.name][:steps]) for field in fields], axis=1)
    columns["next.done"] = (episode.terminations | episode.truncations)[:, None]
    seen = [field.name for fields in groups.values() for field in fields if has_last_row(field.name)]
    return EpisodeFrames(columns, {_FINAL + name: arrays[name][-1].ravel() for name in seen})


def _arrays(frames: EpisodeFrames, groups: dict[str, list[Field]]) -> dict[str, NDArray[Any]]:
    """Return the arrays of an episode by the names of `episode_arrays`."""
    arrays: dict[str, NDArray[Any]] = {}
    for name, fields in groups.items():
        column, start = frames.columns[name], 0
        for field in fields:
            width = len(column[0]) if _is_image(field) else field.width
            rows = field.shaped(column[:, start : start + width])
            if has_last_row(field.name):
                rows = np.concatenate([rows, field.shaped(frames.extras[_FINAL + field.name][None])])
            arrays[field.name] = rows
            start += width
    return arrays


def _video(recording: Recording, camera: str, size: tuple[int, int]) -> Video:
    """Return a video of the states at the start of each step; the state at an episode's end has no frame."""
    return Video(
        f"observation.images.{camera}",
        size,
        lambda number: islice(film_states(recording.origin, recording[number], camera, size), len(recording[number])),
    )


def _drawable(recording: Recording) -> list[str]:
    """Return the names of the model's cameras; none without OpenGL."""
    try:
        choose_backend()
    except RenderingError:
        return []
    model = recording.origin.compile_model()
    return [str(model.camera(number).name) for number in range(model.ncam)]
