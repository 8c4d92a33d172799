"""Layout of LeRobot data sets, version 3: files, and the types of what is in them.

::

    meta/info.json                              features, frame rate, path templates, totals
    meta/stats.json                             statistics of each feature over all frames
    meta/tasks.parquet                          the task in words
    meta/episodes/chunk-000/file-000.parquet    for each episode where its frames are, and their statistics
    data/chunk-000/file-000.parquet             a row for each frame, many episodes a file
    videos/KEY/chunk-000/file-000.mp4           a frame for each row of the data file of the same number
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError, MissingDependencyError

IMAGE = "image"  # LeRobot's name of the type of images in tables, which it keeps as PNG
VERSION = "v3.0"
INFO, STATS, TASKS = "meta/info.json", "meta/stats.json", "meta/tasks.parquet"
EPISODES = "meta/episodes/chunk-000/file-000.parquet"
DATA = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
VIDEO = "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
FILES_A_CHUNK, DATA_MB, VIDEO_MB = 1000, 100, 200  # LeRobot's: files a chunk, size of a file in MiB
INDICES = {
    "timestamp": "float32",
    "frame_index": "int64",
    "episode_index": "int64",
    "index": "int64",
    "task_index": "int64",
}


class Feature(NamedTuple):
    """Feature: type of a column of frames.

    Attributes:
        dtype: numpy's name of the type, or ``"image"``.
        shape: Shape of a frame's value, (w,), or (height, width, 3) of an image.
        names: Names of its numbers, or of the axes of an image.
    """

    dtype: str
    shape: tuple[int, ...]
    names: Sequence[str]

    @property
    def size(self) -> int:
        """Size of a frame's value, bytes."""
        return math.prod(self.shape) * (1 if self.dtype == IMAGE else np.dtype(self.dtype).itemsize)


class EpisodeFrames(NamedTuple):
    """Frames of an episode.

    Attributes:
        columns: The frames of each feature, shape (T, w), or (T, height, width, 3).
        extras: Further columns of its row in the table of episodes, each a list of numbers.
    """

    columns: dict[str, NDArray[Any]]
    extras: dict[str, NDArray[Any]]

    @property
    def length(self) -> int:
        """Number of frames T."""
        return len(next(iter(self.columns.values())))


class Video(NamedTuple):
    """Videos of a camera.

    Attributes:
        key: Name of the feature, ``observation.images.`` and the camera's.
        size: Width and height, pixels.
        frames: Function from the number of an episode to its frames.
    """

    key: str
    size: tuple[int, int]
    frames: Callable[[int], Iterable[NDArray[np.uint8]]]


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Data set to write.

    Attributes:
        fps: Frames per second.
        robot: Name of the robot.
        task: Task in words, the same in all episodes.
        features: Features by name.
        episodes: Frames of the episodes.
        videos: Videos of the cameras.
    """

    fps: int
    robot: str
    task: str
    features: dict[str, Feature]
    episodes: Sequence[EpisodeFrames]
    videos: Sequence[Video] = ()

    def __post_init__(self) -> None:
        """Check the names of the features.

        Raises:
            InvalidInputError: If one has a slash, which LeRobot reserves, or is an index's or a video's.
        """
        taken = [*INDICES, *(video.key for video in self.videos)]
        for name in self.features:
            if "/" in name or name in taken:
                raise InvalidInputError("LeRobot feature", f"a name without '/', and none of {', '.join(taken)}", name)

    @cached_property
    def starts(self) -> NDArray[np.int64]:
        """Number of the first frame of each of N episodes, then that of all frames, shape (N + 1,)."""
        return np.cumsum([0, *(episode.length for episode in self.episodes)])

    @cached_property
    def files(self) -> list[int]:
        """Number of the file that each episode is in; none is much larger than `DATA_MB`."""
        a_frame = sum(feature.size for feature in self.features.values())
        full = (self.starts[:-1] * a_frame / (DATA_MB * 2**20)).astype(np.int64)
        consecutive: list[int] = np.unique(full, return_inverse=True)[1].tolist()
        return consecutive


def file_place(what: str, file: int) -> dict[str, int]:
    """Return chunk and number of a file as columns of the table of episodes."""
    return {f"{what}/chunk_index": file // FILES_A_CHUNK, f"{what}/file_index": file % FILES_A_CHUNK}


def file_path(template: str, file: int, key: str = "") -> str:
    """Return the path of a file below the data set's folder."""
    return template.format(chunk_index=file // FILES_A_CHUNK, file_index=file % FILES_A_CHUNK, video_key=key)


def import_pyarrow() -> Any:
    """Import pyarrow with its Parquet module.

    Raises:
        MissingDependencyError: If it is not installed.
    """
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise MissingDependencyError("pyarrow", "lerobot", "A LeRobot data set") from None
    return pyarrow
