"""Recordings as ``.npz`` files, without pickles, written whole or not at all."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import MAX_BYTES, read_archive, write_archive
from signimit.validation import whole_numbers
from signimit_envs.recording.episodes import Recording, episode_arrays, episode_from_arrays
from signimit_envs.recording.origin import RecordingOrigin
from signimit_envs.recording.replay import check_recording

KIND, VERSION = "recording", 1
_STEPS = "steps"


def save_recording(path: str | os.PathLike[str], recording: Recording) -> None:
    """Write a ``.npz`` file: each field of all episodes in one array, and their lengths in ``steps``.

    Raises:
        InvalidInputError: If it is larger than `load_recording` would read.
        OSError: If the file cannot be written.
    """
    episodes = [episode_arrays(episode) for episode in recording]
    arrays = {name: np.concatenate([fields[name] for fields in episodes]) for name in episodes[0]}
    total = sum(array.nbytes for array in arrays.values())
    if total > MAX_BYTES // 2:
        raise InvalidInputError("recording", f"at most {MAX_BYTES // 2} bytes in a .npz file", f"{total}")
    arrays[_STEPS] = np.array([len(episode) for episode in recording])
    meta = {"origin": recording.origin.to_meta(), "seeds": [episode.seed for episode in recording]}
    write_archive(path, KIND, VERSION, arrays, meta)


def load_recording(path: str | os.PathLike[str]) -> Recording:
    """Read a file of `save_recording`.

    Raises:
        FileFormatError: If a field is missing or wrong; names the file, the episode and the field.
    """
    arrays, meta = read_archive(path, KIND, VERSION)
    where = os.fspath(path)
    try:
        steps = whole_numbers(arrays.pop(_STEPS), _STEPS, (None,))
        seeds = seeds_of(meta.get("seeds"), len(steps), where)
        episodes = _split_episodes(arrays, steps)
        origin = RecordingOrigin.from_meta(meta.get("origin"), where)
        made = []
        for number, (fields, seed) in enumerate(zip(episodes, seeds, strict=True)):
            try:
                made.append(episode_from_arrays(fields, seed))
            except InvalidInputError as error:
                raise error.inside(f"episode {number}") from None
        recording = Recording(origin, made)
    except KeyError as error:
        raise FileFormatError(where, f"an array {error}", "none") from None
    except FileFormatError:
        raise
    except InvalidInputError as error:
        raise FileFormatError(f"{where}: {error.where}", error.expected, error.found) from None
    return check_recording(recording, where)


def seeds_of(value: Any, count: int, where: str) -> list[int | None]:
    """Return the seeds of a file, a whole number or None for each episode.

    Raises:
        FileFormatError: If they are something else; the message begins with ``where``.
    """
    if not isinstance(value, list) or len(value) != count or not all(isinstance(v, int | None) for v in value):
        raise FileFormatError(where, f"seeds of {count} episodes", f"{value!r:.40}")
    return value


def _split_episodes(arrays: dict[str, NDArray[Any]], steps: NDArray[np.int64]) -> list[dict[str, NDArray[Any]]]:
    """Split the arrays of all episodes into those of each; some fields have a row more than there are steps."""
    episodes: list[dict[str, NDArray[Any]]] = [{} for _ in steps]
    for name, array in arrays.items():
        rows = len(array) if array.ndim else 0
        extra = {steps.sum(): 0, steps.sum() + len(steps): 1}.get(rows)
        if extra is None or (steps < 1).any():
            raise InvalidInputError(name, f"numbers for {steps.sum()} steps", f"{rows}")
        for fields, part in zip(episodes, np.split(array, np.cumsum(steps + extra)[:-1]), strict=True):
            fields[name] = part
    return episodes
