"""Metadata of LeRobot data sets: features, statistics, episodes and tasks."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit_envs.recording.formats.lerobot.layout import (
    DATA,
    DATA_MB,
    EPISODES,
    FILES_A_CHUNK,
    INDICES,
    INFO,
    STATS,
    TASKS,
    VERSION,
    VIDEO,
    VIDEO_MB,
    Layout,
    file_place,
    import_pyarrow,
)

Columns = dict[str, NDArray[Any]]
Statistics = dict[str, list[Any]]

_QUANTILES = {"q01": 0.01, "q10": 0.10, "q50": 0.50, "q90": 0.90, "q99": 0.99}  # LeRobot's
_PIXEL_STRIDE = 4  # every fourth pixel, each way, is enough for statistics
_LEVELS = 256  # of a byte


def write_metadata(
    folder: Path, layout: Layout, tables: list[Columns], pixels: Mapping[str, list[PixelCounter]]
) -> None:
    """Write the folder ``meta``.

    Args:
        folder: Folder of the data set.
        layout: The data set.
        tables: The frames of each episode, with their indices.
        pixels: For each camera the pixels of each episode.
    """
    pa = import_pyarrow()
    (folder / EPISODES).parent.mkdir(parents=True, exist_ok=True)
    rows = [
        _episode_row(layout, number, table, {key: counters[number] for key, counters in pixels.items()})
        for number, table in enumerate(tables)
    ]
    types = {name: pa.list_(pa.from_numpy_dtype(array.dtype)) for name, array in layout.episodes[0].extras.items()}
    names = dict.fromkeys(name for row in rows for name in row)
    columns = {name: pa.array([row.get(name) for row in rows], types.get(name)) for name in names}
    pa.parquet.write_table(pa.table(columns), folder / EPISODES)
    _write_tasks(folder, layout.task)
    everything = {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
    totals = {key: sum(counters[1:], counters[0]) for key, counters in pixels.items()}
    for path, value in ((INFO, _info(layout)), (STATS, _describe(everything, totals))):
        (folder / path).write_text(json.dumps(value, indent=4, allow_nan=False) + "\n", encoding="utf-8")


def _episode_row(layout: Layout, number: int, table: Columns, pixels: Mapping[str, PixelCounter]) -> dict[str, Any]:
    """Return an episode's row in the table of episodes, which says where its frames are, and their statistics."""
    start, stop = layout.starts[number : number + 2].tolist()
    first = layout.files.index(layout.files[number])
    begin, end = ((layout.starts[number : number + 2] - layout.starts[first]) / layout.fps).tolist()  # s, in its video
    videos: dict[str, Any] = {}
    for video in layout.videos:
        key = f"videos/{video.key}"
        videos |= {**file_place(key, layout.files[number]), f"{key}/from_timestamp": begin, f"{key}/to_timestamp": end}
    described = _describe(table, pixels)
    return {
        "episode_index": number,
        "tasks": [layout.task],
        "length": stop - start,
        **file_place("data", layout.files[number]),
        "dataset_from_index": start,
        "dataset_to_index": stop,
        **file_place("meta/episodes", 0),
        **videos,
        **{f"stats/{key}/{name}": value for key, stats in described.items() for name, value in stats.items()},
        **{name: array.tolist() for name, array in layout.episodes[number].extras.items()},
    }


def _describe(columns: Columns, pixels: Mapping[str, PixelCounter]) -> dict[str, Statistics]:
    """Return statistics of the videos and of the columns whose numbers are all finite; JSON has no others."""
    described = {
        name: column_statistics(array) if array.ndim == 2 else image_statistics(array)
        for name, array in columns.items()
        if np.isfinite(array).all()
    }
    return {**described, **{key: counter.statistics() for key, counter in pixels.items()}}


def _write_tasks(folder: Path, task: str) -> None:
    """Write the table of tasks as pandas would: the words of the tasks have to be its index."""
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


def _info(layout: Layout) -> dict[str, Any]:
    """Return the content of ``meta/info.json``."""
    features: dict[str, Any] = {
        name: {"dtype": f.dtype, "shape": list(f.shape), "names": list(f.names)} for name, f in layout.features.items()
    }
    for video in layout.videos:
        width, height = video.size
        encoding = {
            "video.height": height,
            "video.width": width,
            "video.codec": "h264",
            "video.pix_fmt": "yuv420p",
            "video.is_depth_map": False,
            "video.fps": layout.fps,
            "video.channels": 3,
            "has_audio": False,
        }
        shape, names = [height, width, 3], ["height", "width", "channels"]
        features[video.key] = {"dtype": "video", "shape": shape, "names": names, "info": encoding}
    features |= {name: {"dtype": dtype, "shape": [1], "names": None} for name, dtype in INDICES.items()}
    return {
        "codebase_version": VERSION,
        "robot_type": layout.robot,
        "total_episodes": len(layout.episodes),
        "total_frames": int(layout.starts[-1]),
        "total_tasks": 1,
        "chunks_size": FILES_A_CHUNK,
        "data_files_size_in_mb": DATA_MB,
        "video_files_size_in_mb": VIDEO_MB,
        "fps": layout.fps,
        "splits": {"train": f"0:{len(layout.episodes)}"},
        "data_path": DATA,
        "video_path": VIDEO if layout.videos else None,
        "features": features,
    }


def column_statistics(values: NDArray[Any]) -> Statistics:
    """Return statistics of a feature, shape (T, w), each of shape (w,)."""
    numbers = values.astype(np.float64)
    described = {
        "min": numbers.min(axis=0),
        "max": numbers.max(axis=0),
        "mean": numbers.mean(axis=0),
        "std": numbers.std(axis=0),
        **{name: np.quantile(numbers, share, axis=0) for name, share in _QUANTILES.items()},
    }
    return {**{name: value.tolist() for name, value in described.items()}, "count": [len(values)]}


def image_statistics(images: NDArray[np.uint8]) -> Statistics:
    """Return statistics of images, shape (T, height, width, 3), each of shape (3, 1, 1), levels from 0 to 1."""
    counter = PixelCounter()
    for _ in counter.watch(images):
        pass
    return counter.statistics()


class PixelCounter:
    """Histogram of the levels of each channel over many frames.

    Attributes:
        frames: Number of frames.
    """

    def __init__(self) -> None:
        """Start with no frames."""
        self._counts = np.zeros((3, _LEVELS), dtype=np.int64)
        self.frames = 0

    def watch(self, frames: Iterable[NDArray[np.uint8]]) -> Iterator[NDArray[np.uint8]]:
        """Pass frames on, each of shape (height, width, 3), and count their levels."""
        for frame in frames:
            self.frames += 1
            for channel, counts in enumerate(self._counts):
                counts += np.bincount(frame[::_PIXEL_STRIDE, ::_PIXEL_STRIDE, channel].ravel(), minlength=_LEVELS)
            yield frame

    def __add__(self, other: PixelCounter) -> PixelCounter:
        """Return the counts of both counters together."""
        both = PixelCounter()
        both._counts, both.frames = self._counts + other._counts, self.frames + other.frames
        return both

    def statistics(self) -> Statistics:
        """Return statistics of the channels, each of shape (3, 1, 1), levels from 0 to 1."""
        levels = np.arange(_LEVELS) / (_LEVELS - 1)
        shares = self._counts / self._counts.sum(axis=1, keepdims=True)
        mean = shares @ levels
        described = {
            "min": levels[(self._counts > 0).argmax(axis=1)],
            "max": levels[_LEVELS - 1 - (self._counts[:, ::-1] > 0).argmax(axis=1)],
            "mean": mean,
            "std": np.sqrt(np.maximum(shares @ levels**2 - mean**2, 0.0)),
            **{name: levels[(shares.cumsum(axis=1) >= share).argmax(axis=1)] for name, share in _QUANTILES.items()},
        }
        return {
            **{name: value.reshape(3, 1, 1).tolist() for name, value in described.items()},
            "count": [self.frames],
        }
