"""Reading LeRobot's layout, version 3."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit_envs.recording.formats.lerobot.images import image_from_png
from signimit_envs.recording.formats.lerobot.layout import INFO, EpisodeFrames, import_pyarrow

_TOTALS = {"total_episodes": "episodes", "total_frames": "frames"}


def read_layout(folder: str | os.PathLike[str], prefix: str) -> list[EpisodeFrames]:
    """Read all frames of a data set, videos apart.

    Args:
        folder: The data set.
        prefix: How those columns of the table of episodes begin that shall be the extras.

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
        numbers = {name: _array(pa, data.column(name)) for name in data.column_names}
        extras = [name for name in episodes.column_names if name.startswith(prefix)]
        return [_episode(row, numbers, extras) for row in episodes.to_pylist()]


@contextmanager
def lerobot_errors(folder: Path) -> Iterator[None]:
    """Turn what pyarrow and JSON raise of a broken data set into one sentence."""
    try:
        yield
    except FileFormatError:
        raise
    except InvalidInputError as error:
        raise FileFormatError(f"{folder}: {error.where}", error.expected, error.found) from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError, NotImplementedError) as error:
        reason = f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
        raise FileFormatError(str(folder), "a whole LeRobot data set", reason) from None


def _tables(pa: Any, folder: Path, order: str) -> Any:
    """Join the files of a folder, in the order of a column."""
    paths = sorted(folder.glob("chunk-*/file-*.parquet"))
    if not paths:
        raise FileFormatError(str(folder), "chunk-000/file-000.parquet", "none")
    table = pa.concat_tables([pa.parquet.read_table(path) for path in paths])
    return table.take(np.argsort(table.column(order).to_numpy(), kind="stable"))


def _array(pa: Any, column: Any) -> NDArray[Any]:
    """Return a column of scalars or of lists as numbers, shape (T, w), one of images as pixels."""
    rows = len(column)
    if pa.types.is_struct(column.type):
        return np.stack([image_from_png(cell["bytes"]) for cell in column.to_pylist()])
    flat = column.combine_chunks()
    if flat.null_count:
        raise FileFormatError("data", "a number in every cell", f"{flat.null_count} empty ones")
    if not pa.types.is_primitive(flat.type):
        flat = flat.flatten()
    return np.asarray(flat.to_numpy(zero_copy_only=False)).reshape(rows, -1)


def _episode(row: dict[str, Any], numbers: dict[str, NDArray[Any]], extras: list[str]) -> EpisodeFrames:
    start, stop = row["dataset_from_index"], row["dataset_to_index"]
    columns = {name: array[start:stop] for name, array in numbers.items()}
    if row["length"] != stop - start or set(columns["episode_index"].ravel().tolist()) != {row["episode_index"]}:
        raise FileFormatError(
            f"episode {row['episode_index']}", f"{row['length']} frames", f"those at {start} to {stop}"
        )
    return EpisodeFrames(columns, {name: np.array(row[name]) for name in extras if row[name] is not None})
