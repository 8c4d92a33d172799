"""What LeRobot's layout says of the frames: their features, statistics, episodes and tasks."""

from __future__ import annotations

import json
from collections.abc import Mapping
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
    Video,
    file_place,
    import_pyarrow,
)
from signimit_envs.recording.formats.lerobot.statistics import (
    PixelCounter,
    Statistics,
    column_statistics,
    image_statistics,
)

Columns = dict[str, NDArray[Any]]
Seen = Mapping[str, list[PixelCounter]]


def write_metadata(folder: Path, layout: Layout, tables: list[Columns], seen: Seen) -> None:
    """Write the folder ``meta``.

    Args:
        folder: The data set.
        layout: What it is.
        tables: The frames of each episode, with their indices.
        seen: For each camera what was seen in each episode.
    """
    (folder / EPISODES).parent.mkdir(parents=True, exist_ok=True)
    _write_episodes(folder, layout, tables, seen)
    _write_tasks(folder, layout.task)
    _write_json(folder / INFO, _info(layout))
    everything = {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
    totals = {key: sum(counters[1:], counters[0]) for key, counters in seen.items()}
    _write_json(folder / STATS, _describe(everything, totals))


def _write_episodes(folder: Path, layout: Layout, tables: list[Columns], seen: Seen) -> None:
    pa = import_pyarrow()
    rows = [_episode_row(layout, number, table, seen) for number, table in enumerate(tables)]
    types = {name: pa.list_(pa.from_numpy_dtype(array.dtype)) for name, array in layout.episodes[0].extras.items()}
    names = dict.fromkeys(name for row in rows for name in row)
    columns = {name: pa.array([row.get(name) for row in rows], types.get(name)) for name in names}
    pa.parquet.write_table(pa.table(columns), folder / EPISODES)


def _episode_row(layout: Layout, number: int, table: Columns, seen: Seen) -> dict[str, Any]:
    start, stop = layout.starts[number : number + 2].tolist()
    described = _describe(table, {key: counters[number] for key, counters in seen.items()})
    return {
        "episode_index": number,
        "tasks": [layout.task],
        "length": stop - start,
        **file_place("data", layout.files[number]),
        "dataset_from_index": start,
        "dataset_to_index": stop,
        **file_place("meta/episodes", 0),
        **_video_places(layout, number),
        **{f"stats/{key}/{name}": value for key, stats in described.items() for name, value in stats.items()},
        **{name: array.tolist() for name, array in layout.episodes[number].extras.items()},
    }


def _video_places(layout: Layout, number: int) -> dict[str, Any]:
    """Say where in its videos an episode begins and ends, s."""
    first = layout.files.index(layout.files[number])
    begin, end = ((layout.starts[number : number + 2] - layout.starts[first]) / layout.fps).tolist()
    places: dict[str, Any] = {}
    for video in layout.videos:
        key = f"videos/{video.key}"
        places |= {**file_place(key, layout.files[number]), f"{key}/from_timestamp": begin, f"{key}/to_timestamp": end}
    return places


def _describe(columns: Columns, seen: Mapping[str, PixelCounter]) -> dict[str, Statistics]:
    """Describe videos and those columns whose numbers are all finite; JSON knows no others."""
    described = {
        name: column_statistics(array) if array.ndim == 2 else image_statistics(array)
        for name, array in columns.items()
        if np.isfinite(array).all()
    }
    return {**described, **{key: counter.statistics() for key, counter in seen.items()}}


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


def _info(layout: Layout) -> dict[str, Any]:
    features: dict[str, Any] = {
        name: {"dtype": f.dtype, "shape": list(f.shape), "names": list(f.names)} for name, f in layout.features.items()
    }
    features |= {video.key: _video_feature(video, layout.fps) for video in layout.videos}
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


def _write_json(path: Path, value: Mapping[str, Any]) -> None:
    path.write_text(json.dumps(value, indent=4, allow_nan=False) + "\n", encoding="utf-8")
