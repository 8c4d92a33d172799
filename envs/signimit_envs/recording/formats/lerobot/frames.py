"""Frames of LeRobot data sets: their tables and videos, written and read."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import MAX_BYTES
from signimit_envs.recording.formats.lerobot.layout import (
    DATA,
    INDICES,
    INFO,
    VIDEO,
    EpisodeFrames,
    Layout,
    Video,
    file_path,
    import_pyarrow,
)
from signimit_envs.recording.formats.lerobot.metadata import Columns, PixelCounter, write_metadata
from signimit_envs.video.mp4 import write_video

_TOTALS = {"total_episodes": "episodes", "total_frames": "frames"}


def write_layout(folder: Path, layout: Layout) -> None:
    """Write a data set into an empty folder.

    Raises:
        InvalidInputError: If a camera gives another number of frames than there are.
        RenderingError: If there are cameras, and no OpenGL.
        MissingDependencyError: If pyarrow is not installed.
    """
    pa = import_pyarrow()
    tables: list[Columns] = []
    for number, (episode, start) in enumerate(zip(layout.episodes, layout.starts[:-1].tolist(), strict=True)):
        frame = np.arange(episode.length)[:, None]
        indices = {
            "timestamp": frame / layout.fps,
            "frame_index": frame,
            "episode_index": np.full_like(frame, number),
            "index": frame + start,
            "task_index": np.zeros_like(frame),
        }
        tables.append({**episode.columns, **{name: indices[name].astype(dtype) for name, dtype in INDICES.items()}})
    # Tables of frames: many episodes a file, an episode a row group.
    for file in sorted(set(layout.files)):
        path = folder / file_path(DATA, file)
        path.parent.mkdir(parents=True, exist_ok=True)
        inside = [table for table, where in zip(tables, layout.files, strict=True) if where == file]
        arrow = [pa.table({name: _arrow_column(array) for name, array in table.items()}) for table in inside]
        with pa.parquet.ParquetWriter(path, arrow[0].schema) as writer:
            for table in arrow:
                writer.write_table(table)
    pixels = {video.key: _write_videos(folder, layout, video) for video in layout.videos}
    write_metadata(folder, layout, tables, pixels)


def _arrow_column(array: NDArray[Any]) -> Any:
    """Return an array, shape (T, w), as a column of scalars if w is 1, else of lists of a fixed size; images as PNG."""
    pa = import_pyarrow()
    if array.ndim == 4:
        png = pa.struct({"bytes": pa.binary(), "path": pa.string()})
        cells = []
        for image in array:
            buffer = io.BytesIO()
            Image.fromarray(image).save(buffer, "PNG", compress_level=1)
            cells.append({"bytes": buffer.getvalue(), "path": None})
        return pa.array(cells, png)
    flat = pa.array(np.ascontiguousarray(array).ravel())
    return flat if array.shape[1] == 1 else pa.FixedSizeListArray.from_arrays(flat, array.shape[1])


def _write_videos(folder: Path, layout: Layout, video: Video) -> list[PixelCounter]:
    """Write the files of one camera, and return the pixels of each episode."""
    counters = [PixelCounter() for _ in layout.episodes]

    def frames_of_file(file: int) -> Iterator[NDArray[np.uint8]]:
        for number, where in enumerate(layout.files):
            if where == file:
                yield from counters[number].watch(video.frames(number))

    for file in sorted(set(layout.files)):
        path = folder / file_path(VIDEO, file, video.key)
        path.parent.mkdir(parents=True, exist_ok=True)
        write_video(path, frames_of_file(file), layout.fps)
    for counter, episode in zip(counters, layout.episodes, strict=True):
        if counter.frames != episode.length:
            raise InvalidInputError(video.key, f"{episode.length} frames of an episode", f"{counter.frames}")
    return counters


def read_layout(folder: str | os.PathLike[str], prefix: str) -> list[EpisodeFrames]:
    """Read the frames of a data set without its videos.

    Args:
        folder: Folder of the data set.
        prefix: Prefix of the columns of the table of episodes that are the extras.

    Raises:
        FileFormatError: If it is half written or of another version.
        MissingDependencyError: If pyarrow is not installed.
    """
    pa = import_pyarrow()
    place = Path(folder)
    with lerobot_errors(place):
        info = json.loads((place / INFO).read_bytes())
        if not str(info["codebase_version"]).startswith("v3."):
            raise FileFormatError(str(place), "a LeRobot data set of version 3", str(info["codebase_version"]))
        data = _tables(pa, place / "data", "index")
        episodes = _tables(pa, place / "meta" / "episodes", "episode_index")
        for (total, noun), table in zip(_TOTALS.items(), (episodes, data), strict=True):
            if info[total] != table.num_rows:
                raise FileFormatError(str(place), f"{info[total]} {noun}, as info.json says", f"{table.num_rows}")
        numbers = {name: _numpy_column(pa, data.column(name)) for name in data.column_names}
        extras = [name for name in episodes.column_names if name.startswith(prefix)]
        read = []
        for row in episodes.to_pylist():
            start, stop = row["dataset_from_index"], row["dataset_to_index"]
            columns = {name: array[start:stop] for name, array in numbers.items()}
            indices = set(columns["episode_index"].ravel().tolist())
            if row["length"] != stop - start or indices != {row["episode_index"]}:
                where, found = f"episode {row['episode_index']}", f"those at {start} to {stop}"
                raise FileFormatError(where, f"{row['length']} frames", found)
            read.append(EpisodeFrames(columns, {n: np.array(row[n]) for n in extras if row[n] is not None}))
        return read


@contextmanager
def lerobot_errors(folder: Path) -> Iterator[None]:
    """Raise a `FileFormatError` for any error of pyarrow or JSON in a broken data set."""
    try:
        yield
    except FileFormatError:
        raise
    except InvalidInputError as error:
        raise FileFormatError(f"{folder}: {error.where}", error.expected, error.found) from None
    except Exception as error:  # JSON, Arrow, Parquet, PNG: each fails on damaged files in ways of its own
        reason = f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
        raise FileFormatError(str(folder), "a whole LeRobot data set", reason) from None


def _tables(pa: Any, folder: Path, order: str) -> Any:
    """Read the Parquet files of a folder as one table, sorted by a column."""
    paths = sorted(folder.glob("chunk-*/file-*.parquet"))
    if not paths:
        raise FileFormatError(str(folder), "chunk-000/file-000.parquet", "none")
    batches, most = [], MAX_BYTES
    for path in paths:
        with pa.parquet.ParquetFile(path) as file:
            # Its metadata tell the sizes too, but pyarrow 26 ends the process on some damaged ones (not so on reading).
            for batch in file.iter_batches():
                most -= batch.nbytes
                if most < 0:
                    raise FileFormatError(str(path), f"at most {MAX_BYTES} bytes of numbers", "more")
                batches.append(batch)
    table = pa.Table.from_batches(batches, schema=file.schema_arrow)
    return table.take(np.argsort(table.column(order).to_numpy(), kind="stable"))


def _numpy_column(pa: Any, column: Any) -> NDArray[Any]:
    """Return a column of scalars or lists as an array, shape (T, w); of images, shape (T, height, width, 3)."""
    rows = len(column)
    if pa.types.is_struct(column.type):
        images = []
        for cell in column.to_pylist():
            with Image.open(io.BytesIO(cell["bytes"]), formats=["PNG"]) as image:
                images.append(np.array(image, dtype=np.uint8))
        return np.stack(images)
    flat = column.combine_chunks()
    if flat.null_count:
        raise FileFormatError("data", "a number in every cell", f"{flat.null_count} empty ones")
    if not pa.types.is_primitive(flat.type):
        flat = flat.flatten()
    return np.asarray(flat.to_numpy(zero_copy_only=False)).reshape(rows, -1)
