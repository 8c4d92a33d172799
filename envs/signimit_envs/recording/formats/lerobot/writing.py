"""Writing LeRobot's layout: the tables of frames and the videos."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit_envs.recording.formats.lerobot.images import png_from_image
from signimit_envs.recording.formats.lerobot.layout import (
    DATA,
    INDICES,
    VIDEO,
    EpisodeFrames,
    Layout,
    Video,
    file_path,
    import_pyarrow,
)
from signimit_envs.recording.formats.lerobot.metadata import Columns, write_metadata
from signimit_envs.recording.formats.lerobot.statistics import PixelCounter
from signimit_envs.video.mp4 import write_video


def write_layout(folder: Path, layout: Layout) -> None:
    """Write a data set into a folder.

    Raises:
        InvalidInputError: If a camera gives another number of frames than there are.
        RenderingError: If there are cameras, and no OpenGL.
        MissingDependencyError: If pyarrow is not installed.
    """
    tables = [
        _with_indices(episode, number, int(layout.starts[number]), layout.fps)
        for number, episode in enumerate(layout.episodes)
    ]
    _write_data(folder, layout, tables)
    seen = {video.key: _write_videos(folder, layout, video) for video in layout.videos}
    write_metadata(folder, layout, tables, seen)


def _with_indices(episode: EpisodeFrames, number: int, start: int, fps: int) -> Columns:
    frame = np.arange(episode.length)[:, None]
    indices = {
        "timestamp": frame / fps,
        "frame_index": frame,
        "episode_index": np.full_like(frame, number),
        "index": frame + start,
        "task_index": np.zeros_like(frame),
    }
    return {**episode.columns, **{name: indices[name].astype(dtype) for name, dtype in INDICES.items()}}


def _write_data(folder: Path, layout: Layout, tables: list[Columns]) -> None:
    """Write the data files, an episode a row group."""
    pa = import_pyarrow()
    for file in sorted(set(layout.files)):
        path = folder / file_path(DATA, file)
        path.parent.mkdir(parents=True, exist_ok=True)
        inside = [table for table, where in zip(tables, layout.files, strict=True) if where == file]
        arrow = [pa.table({name: _arrow_column(array) for name, array in table.items()}) for table in inside]
        with pa.parquet.ParquetWriter(path, arrow[0].schema) as writer:
            for table in arrow:
                writer.write_table(table)


def _arrow_column(array: NDArray[Any]) -> Any:
    """Return an array, shape (T, w), as a column of scalars if w is 1, else of lists of a fixed size; images as PNG."""
    pa = import_pyarrow()
    if array.ndim == 4:
        png = pa.struct({"bytes": pa.binary(), "path": pa.string()})
        return pa.array([{"bytes": png_from_image(image), "path": None} for image in array], png)
    flat = pa.array(np.ascontiguousarray(array).ravel())
    return flat if array.shape[1] == 1 else pa.FixedSizeListArray.from_arrays(flat, array.shape[1])


def _write_videos(folder: Path, layout: Layout, video: Video) -> list[PixelCounter]:
    """Write the files of one camera, and return what was seen in each episode."""
    counters = [PixelCounter() for _ in layout.episodes]

    def drawn(file: int) -> Iterator[NDArray[np.uint8]]:
        for number, where in enumerate(layout.files):
            if where == file:
                yield from counters[number].watch(video.frames(number))

    for file in sorted(set(layout.files)):
        path = folder / file_path(VIDEO, file, video.key)
        path.parent.mkdir(parents=True, exist_ok=True)
        write_video(path, drawn(file), layout.fps)
    for counter, episode in zip(counters, layout.episodes, strict=True):
        if counter.frames != episode.length:
            raise InvalidInputError(video.key, f"{episode.length} frames of an episode", f"{counter.frames}")
    return counters
