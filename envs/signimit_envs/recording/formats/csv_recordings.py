"""Recordings as CSV tables in a folder.

``steps.csv`` has a line for the start of an episode and for each step: ``episode``, ``step``, what was observed then,
and the next action with its outcome; these cells are empty in an episode's last line. ``episodes.csv`` has a line for
each episode: its number of steps, its seed, and the observations that are constant in all episodes. ``recording.json``
has types and shapes, ``model.xml`` the model.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.formats.csv_tables import CsvRow, read_table, write_table
from signimit.io.safe_files import whole_folder
from signimit_envs.recording.episodes import RecordedEpisode, Recording, episode_arrays, episode_from_arrays
from signimit_envs.recording.formats.columns import (
    Field,
    check_columns,
    constant_fields,
    fields_from_meta,
    fields_of,
    fields_to_meta,
    has_last_row,
)
from signimit_envs.recording.origin import read_origin, write_origin
from signimit_envs.recording.replay import check_recording
from signimit_envs.recording.storage import KIND, VERSION

STEPS, EPISODES = "steps.csv", "episodes.csv"
_MAX_COLUMNS = 10_000  # of a table; pixels are more
_STEP_KEYS, _EPISODE_KEYS = ("episode", "step"), ("episode", "steps", "seed")


def write_csv_recording(folder: str | os.PathLike[str], recording: Recording, overwrite: bool = False) -> None:
    """Write a folder of tables, whole or not at all.

    Raises:
        InvalidInputError: If a step has too many numbers (pixels), or the name is taken, unless by such tables and
            ``overwrite`` is true.
    """
    constant = constant_fields(recording)
    still, moving = _split(fields_of(recording), constant)
    check_columns([*still, *moving], _MAX_COLUMNS)
    header = {"kind": KIND, "version": VERSION, "fields": fields_to_meta(recording), "constant": sorted(constant)}
    with whole_folder(folder, STEPS, overwrite) as draft:
        write_origin(draft, recording.origin, header)
        write_table(draft / EPISODES, [*_EPISODE_KEYS, *_columns(still)], _episode_lines(recording, still))
        write_table(draft / STEPS, [*_STEP_KEYS, *_columns(moving)], _step_lines(recording, moving))


def read_csv_recording(folder: str | os.PathLike[str]) -> Recording:
    """Read the tables of `write_csv_recording`.

    Raises:
        FileFormatError: If a table is missing or wrong; names the file, the line and the column.
    """
    place = Path(folder)
    origin, header = read_origin(place, KIND, VERSION)
    fields = fields_from_meta(header.get("fields"), str(place))
    try:
        check_columns(fields, _MAX_COLUMNS)
        constant = header.get("constant")
        if not isinstance(constant, list):
            raise InvalidInputError("constant", "a list", type(constant).__name__)
        still, moving = _split(fields, set(map(str, constant)))
        lines = list(read_table(place / EPISODES, [*_EPISODE_KEYS, *_columns(still)]))
        steps = read_table(place / STEPS, [*_STEP_KEYS, *_columns(moving)])
        episodes = [_episode(number, line, steps, still, moving) for number, line in enumerate(lines)]
        for line in steps:
            raise line.complaint(0, f"no more than {len(episodes)} episodes")
        recording = Recording(origin, episodes)
    except FileNotFoundError as error:
        raise FileFormatError(str(place), f"a table {Path(error.filename).name}", "none") from None
    except FileFormatError:
        raise
    except InvalidInputError as error:
        raise FileFormatError(f"{place}: {error.where}", error.expected, error.found) from None
    return check_recording(recording, str(place))


def _split(fields: list[Field], constant: set[str]) -> tuple[list[Field], list[Field]]:
    """Return the fields of ``episodes.csv`` and those of ``steps.csv``."""
    return [f for f in fields if f.name in constant], [f for f in fields if f.name not in constant]


def _columns(fields: list[Field]) -> list[str]:
    """Return the names of all columns of fields."""
    return [column for field in fields for column in field.columns]


def _episode_lines(recording: Recording, fields: list[Field]) -> Iterator[list[object]]:
    """Return the lines of ``episodes.csv``."""
    for number, episode in enumerate(recording):
        arrays = episode_arrays(episode)
        cells = [cell for field in fields for cell in _cells(field, arrays[field.name][:1])[0]]
        yield [number, len(episode), "" if episode.seed is None else episode.seed, *cells]


def _step_lines(recording: Recording, fields: list[Field]) -> Iterator[list[object]]:
    """Return the lines of ``steps.csv``."""
    for number, episode in enumerate(recording):
        arrays = episode_arrays(episode)
        parts = [_cells(field, arrays[field.name]) for field in fields]
        for field, part in zip(fields, parts, strict=True):
            if not has_last_row(field.name):
                part.append([""] * field.width)
        for step, cells in enumerate(zip(*parts, strict=True)):
            yield [number, step, *(cell for part in cells for cell in part)]


def _cells(field: Field, array: NDArray[Any]) -> list[list[object]]:
    """Return a table of a field's numbers that Python writes exactly."""
    flat = field.flat(array)
    wide = flat.astype(np.float64) if field.dtype.kind == "f" else flat.astype(object)
    rows: list[list[object]] = (wide + 0 if field.dtype.kind == "b" else wide).tolist()
    return rows


def _episode(
    number: int, line: CsvRow, steps: Iterator[CsvRow], still: list[Field], moving: list[Field]
) -> RecordedEpisode:
    """Read an episode from its line in ``episodes.csv`` and the next lines of ``steps.csv``."""
    line.expect(0, [number])
    count = line.whole(1)
    if count < 1:
        raise line.complaint(1, "at least 1")
    table: dict[str, list[list[Any]]] = {field.name: [] for field in moving}
    for step in range(count + 1):
        row = next(steps, None)
        if row is None:
            raise FileFormatError(STEPS, f"step {step} of episode {number}", "the end of the file")
        row.expect(0, [number])
        row.expect(1, [step])
        start = len(_STEP_KEYS)
        for field in moving:
            if step < count or has_last_row(field.name):
                table[field.name].append(_read(row, start, field))
            elif any(row.cells[start : start + field.width]):
                raise row.complaint(start, "nothing in an episode's last line")
            start += field.width
    arrays = {field.name: field.shaped(table[field.name]) for field in moving}
    seed, start = line.whole(2) if line.cells[2] else None, len(_EPISODE_KEYS)
    for field in still:
        arrays[field.name] = np.repeat(field.shaped([_read(line, start, field)]), count + 1, axis=0)
        start += field.width
    return episode_from_arrays(arrays, seed)


def _read(row: CsvRow, start: int, field: Field) -> list[Any]:
    """Read the numbers of a field, and check that its type can hold them."""
    stop = start + field.width
    if field.dtype.kind != "f":
        values: list[Any] = [row.whole(column) for column in range(start, stop)]
    else:
        values = row.measurements(start, stop) if field.name.startswith("infos.") else row.numbers(start, stop)
    low, high = field.limits
    for column, value in enumerate(values, start):
        if math.isfinite(value) and not low <= value <= high:
            raise row.complaint(column, f"{field.dtype.name}, {low} to {high}")
    return values
