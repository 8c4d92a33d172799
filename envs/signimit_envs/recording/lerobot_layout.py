"""LeRobot's data set layout, version 3: what is where, and nothing about what it means.

::

    meta/info.json                              features, frame rate, path templates, totals
    meta/stats.json                             statistics of each feature over all frames
    meta/tasks.parquet                          what was to be done, in words
    meta/episodes/chunk-000/file-000.parquet    for each episode where its frames are, and their statistics
    data/chunk-000/file-000.parquet             a row for each frame, many episodes a file
    videos/KEY/chunk-000/file-000.mp4           a frame for each row of the data file of the same number
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError, MissingDependencyError
from signimit_envs.recording.lerobot_images import IMAGE, png_from_image
from signimit_envs.recording.lerobot_statistics import (
    PixelCounter,
    Statistics,
    column_statistics,
    image_statistics,
)
from signimit_envs.video import write_video

VERSION = "v3.0"
INFO, STATS, TASKS = "meta/info.json", "meta/stats.json", "meta/tasks.parquet"
EPISODES = "meta/episodes/chunk-000/file-000.parquet"
DATA = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
VIDEO = "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
_FILES_A_CHUNK, _DATA_MB, _VIDEO_MB = 1000, 100, 200
_INDICES = {
    "timestamp": "float32",
    "frame_index": "int64",
    "episode_index": "int64",
    "index": "int64",
    "task_index": "int64",
}


class Feature(NamedTuple):
    """What a column of frames is.

    Attributes:
        dtype: numpy's name of its type, or ``"image"``.
        shape: Shape of a frame's value, (w,), or (height, width, 3) of an image.
        names: What each of its numbers is, or each axis of an image.
    """

    dtype: str
    shape: tuple[int, ...]
    names: Sequence[str]

    @property
    def size(self) -> int:
        """Bytes of a frame's value."""
        return math.prod(self.shape) * (1 if self.dtype == IMAGE else np.dtype(self.dtype).itemsize)


class EpisodeFrames(NamedTuple):
    """An episode.

    Attributes:
        columns: For each feature its frames, shape (T, w), or (T, height, width, 3).
        extras: More columns of its row in the table of episodes, each a list of numbers.
    """

    columns: dict[str, NDArray[Any]]
    extras: dict[str, NDArray[Any]]


class Video(NamedTuple):
    """A camera.

    Attributes:
        key: Name of the feature, ``observation.images.`` and the camera's.
        size: Width and height, pixels.
        frames: Draws the frames of an episode, given its number.
    """

    key: str
    size: tuple[int, int]
    frames: Callable[[int], Iterable[NDArray[np.uint8]]]


@dataclass(frozen=True, kw_only=True)
class Layout:
    """A data set to write.

    Attributes:
        fps: Frames per second.
        robot: Name of the robot.
        task: What was to be done, the same in all episodes.
        features: Columns of the frames.
        episodes: The frames.
        videos: The cameras.
    """

    fps: int
    robot: str
    task: str
    features: dict[str, Feature]
    episodes: Sequence[EpisodeFrames]
    videos: Sequence[Video] = ()

    def __post_init__(self) -> None:
        """Check names.

        Raises:
            InvalidInputError: If one has a slash, which LeRobot reserves.
        """
        for name in self.features:
            if "/" in name or name in _INDICES:
                raise InvalidInputError(
                    "LeRobot feature", f"a name without '/', and none of {', '.join(_INDICES)}", name
                )


def import_pyarrow() -> Any:
    """Return pyarrow, with its Parquet part imported.

    Raises:
        MissingDependencyError: If it is not installed.
    """
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise MissingDependencyError("pyarrow", "lerobot", "A LeRobot data set") from None
    return pyarrow


def write_layout(folder: Path, layout: Layout) -> None:
    """Write a data set into an empty folder."""
    frames = [len(next(iter(episode.columns.values()))) for episode in layout.episodes]
    starts = np.concatenate([[0], np.cumsum(frames)])
    files = _assign_files(layout, starts)
    tables = [_with_indices(e, k, starts[k], layout.fps) for k, e in enumerate(layout.episodes)]
    _write_data(folder, layout, tables, files)
    counters = [_write_videos(folder, video, frames, files, layout.fps) for video in layout.videos]
    rows = [
        {
            "episode_index": k,
            "tasks": [layout.task],
            "length": frames[k],
            **_place("data", files[k]),
            "dataset_from_index": int(starts[k]),
            "dataset_to_index": int(starts[k + 1]),
            "meta/episodes/chunk_index": 0,
            "meta/episodes/file_index": 0,
            **_video_places(layout, frames, files, k),
            **_statistics_columns(tables[k], {v.key: c[k] for v, c in zip(layout.videos, counters, strict=True)}),
            **{name: array.tolist() for name, array in layout.episodes[k].extras.items()},
        }
        for k in range(len(frames))
    ]
    _write_episodes(folder, layout, rows)
    _write_tasks(folder, layout.task)
    _write_json(folder / INFO, _info(layout, int(starts[-1])))
    everything = {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
    totals = {v.key: sum(c[1:], c[0]).statistics() for v, c in zip(layout.videos, counters, strict=True)}
    _write_json(folder / STATS, {**_finite_statistics(everything), **totals})


def _assign_files(layout: Layout, starts: NDArray[np.int64]) -> list[int]:
    """Number the data file of each episode, so that no file is much larger than LeRobot's limit."""
    a_frame = sum(feature.size for feature in layout.features.values())
    full = (starts[:-1] * a_frame / (_DATA_MB * 2**20)).astype(np.int64)
    consecutive: list[int] = np.unique(full, return_inverse=True)[1].tolist()
    return consecutive


def _place(what: str, file: int) -> dict[str, int]:
    return {f"{what}/chunk_index": file // _FILES_A_CHUNK, f"{what}/file_index": file % _FILES_A_CHUNK}


def _path(template: str, file: int, key: str = "") -> str:
    return template.format(chunk_index=file // _FILES_A_CHUNK, file_index=file % _FILES_A_CHUNK, video_key=key)


def _with_indices(episode: EpisodeFrames, number: int, start: int, fps: int) -> dict[str, NDArray[Any]]:
    frame = np.arange(len(next(iter(episode.columns.values()))))[:, None]
    indices = {
        "timestamp": frame / fps,
        "frame_index": frame,
        "episode_index": np.full_like(frame, number),
        "index": frame + start,
        "task_index": np.zeros_like(frame),
    }
    return {**episode.columns, **{name: indices[name].astype(dtype) for name, dtype in _INDICES.items()}}


def _write_data(folder: Path, layout: Layout, tables: list[dict[str, NDArray[Any]]], files: list[int]) -> None:
    """Write the data files, an episode a row group."""
    pa = import_pyarrow()
    for file in sorted(set(files)):
        path = folder / _path(DATA, file)
        path.parent.mkdir(parents=True, exist_ok=True)
        arrow = [
            pa.table({name: _arrow_column(array) for name, array in table.items()})
            for table, where in zip(tables, files, strict=True)
            if where == file
        ]
        with pa.parquet.ParquetWriter(path, arrow[0].schema) as writer:
            for table in arrow:
                writer.write_table(table)


def _arrow_column(array: NDArray[Any]) -> Any:
    """Return an array, shape (T, w), as a column of scalars if w is 1, else of lists of a fixed size; images as PNG."""
    pa = import_pyarrow()
    if array.ndim == 4:
        return pa.array([{"bytes": png_from_image(image), "path": None} for image in array], _png_type(pa))
    flat = pa.array(np.ascontiguousarray(array).ravel())
    return flat if array.shape[1] == 1 else pa.FixedSizeListArray.from_arrays(flat, array.shape[1])


def _png_type(pa: Any) -> Any:
    return pa.struct({"bytes": pa.binary(), "path": pa.string()})


def _write_videos(folder: Path, video: Video, frames: list[int], files: list[int], fps: int) -> list[PixelCounter]:
    """Write the files of one camera, and return what was seen in each episode."""
    counters = [PixelCounter() for _ in frames]

    def drawn(file: int) -> Iterator[NDArray[np.uint8]]:
        for number, (counter, where) in enumerate(zip(counters, files, strict=True)):
            if where == file:
                yield from counter.watch(video.frames(number))

    for file in sorted(set(files)):
        path = folder / _path(VIDEO, file, video.key)
        path.parent.mkdir(parents=True, exist_ok=True)
        count = write_video(path, drawn(file), fps)
        expected = sum(n for n, where in zip(frames, files, strict=True) if where == file)
        if count != expected:
            raise InvalidInputError(video.key, f"{expected} frames", f"{count}")
    return counters


def _video_places(layout: Layout, frames: list[int], files: list[int], number: int) -> dict[str, Any]:
    """Say where in its video an episode begins and ends, s."""
    before = sum(frames[k] for k in range(number) if files[k] == files[number])
    places: dict[str, Any] = {}
    for video in layout.videos:
        places |= _place(f"videos/{video.key}", files[number])
        places[f"videos/{video.key}/from_timestamp"] = before / layout.fps
        places[f"videos/{video.key}/to_timestamp"] = (before + frames[number]) / layout.fps
    return places


def _finite_statistics(columns: dict[str, NDArray[Any]]) -> dict[str, Statistics]:
    """Describe those columns whose numbers are all finite; JSON knows no others."""
    return {
        name: column_statistics(array) if array.ndim == 2 else image_statistics(array)
        for name, array in columns.items()
        if np.isfinite(array).all()
    }


def _statistics_columns(columns: dict[str, NDArray[Any]], seen: dict[str, PixelCounter]) -> dict[str, list[Any]]:
    described = {**_finite_statistics(columns), **{key: counter.statistics() for key, counter in seen.items()}}
    return {f"stats/{key}/{name}": value for key, statistics in described.items() for name, value in statistics.items()}


def _write_episodes(folder: Path, layout: Layout, rows: list[dict[str, Any]]) -> None:
    pa = import_pyarrow()
    types = {name: pa.list_(pa.from_numpy_dtype(array.dtype)) for name, array in layout.episodes[0].extras.items()}
    names = list(dict.fromkeys(name for row in rows for name in row))
    columns = {name: pa.array([row.get(name) for row in rows], types.get(name)) for name in names}
    (folder / EPISODES).parent.mkdir(parents=True, exist_ok=True)
    pa.parquet.write_table(pa.table(columns), folder / EPISODES)


def _write_tasks(folder: Path, task: str) -> None:
    """Write the table of tasks as pandas would, whose index the tasks' words have to be."""
    pa = import_pyarrow()
    text, number = {"pandas_type": "unicode", "numpy_type": "object"}, {"pandas_type": "int64", "numpy_type": "int64"}
    pandas = {
        "index_columns": ["task"],
        "column_indexes": [{"name": None, "field_name": None, **text, "metadata": {"encoding": "UTF-8"}}],
        "columns": [
            {"name": "task_index", "field_name": "task_index", **number, "metadata": None},
            {"name": "task", "field_name": "task", **text, "metadata": None},
        ],
        "creator": {"library": "pyarrow", "version": pa.__version__},
        "pandas_version": "2.2.0",
    }
    table = pa.table({"task_index": pa.array([0], pa.int64()), "task": pa.array([task], pa.string())})
    pa.parquet.write_table(table.replace_schema_metadata({"pandas": json.dumps(pandas)}), folder / TASKS)


def _info(layout: Layout, frames: int) -> dict[str, Any]:
    features: dict[str, Any] = {
        name: {"dtype": f.dtype, "shape": list(f.shape), "names": list(f.names)} for name, f in layout.features.items()
    }
    features |= {video.key: _video_feature(video, layout.fps) for video in layout.videos}
    features |= {name: {"dtype": dtype, "shape": [1], "names": None} for name, dtype in _INDICES.items()}
    return {
        "codebase_version": VERSION,
        "robot_type": layout.robot,
        "total_episodes": len(layout.episodes),
        "total_frames": frames,
        "total_tasks": 1,
        "chunks_size": _FILES_A_CHUNK,
        "data_files_size_in_mb": _DATA_MB,
        "video_files_size_in_mb": _VIDEO_MB,
        "fps": layout.fps,
        "splits": {"train": f"0:{len(layout.episodes)}"},
        "data_path": DATA,
        "video_path": VIDEO if layout.videos else None,
        "features": features,
    }


def _video_feature(video: Video, fps: int) -> dict[str, Any]:
    width, height = video.size
    info = {
        "video.height": height,
        "video.width": width,
        "video.codec": "h264",
        "video.pix_fmt": "yuv420p",
        "video.is_depth_map": False,
        "video.fps": fps,
        "video.channels": 3,
        "has_audio": False,
    }
    return {"dtype": "video", "shape": [height, width, 3], "names": ["height", "width", "channels"], "info": info}


def _write_json(path: Path, value: dict[str, Any]) -> None:
    path.write_text(json.dumps(value, indent=4, allow_nan=False) + "\n", encoding="utf-8")
