"""Columns of a recording as a table: one for each number of a step, with its unit in the name."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit_envs.recording.episodes import Recording, episode_arrays, row_shapes

_UNITS = {
    "hand": "m",
    "hand_velocity": "m_per_s",
    "objects": "m",
    "joints": "rad",
    "joint_velocities": "rad_per_s",
    "controls": "rad_per_s",
    "ik_residual": "m",
}
_PLANAR = ("hand", "hand_velocity", "objects", "signs")  # their last axis is x and y
_MAX_NUMBERS = 2**31  # in a row of a field that a file may ask for


class Field(NamedTuple):
    """Field of an episode (one of its arrays) as columns of a table.

    Attributes:
        name: Its name in `episode_arrays`.
        dtype: Type of its numbers.
        shape: Shape of a step's row.
    """

    name: str
    dtype: np.dtype[Any]
    shape: tuple[int, ...]

    @property
    def width(self) -> int:
        """Number of columns."""
        return math.prod(self.shape)

    @property
    def limits(self) -> tuple[float, float]:
        """Least and largest number of its type; Python's numbers, as NumPy's would cast what is compared with them."""
        if self.dtype.kind == "b":
            return 0, 1
        if self.dtype.kind == "f":
            return float(np.finfo(self.dtype).min), float(np.finfo(self.dtype).max)
        return np.iinfo(self.dtype).min, np.iinfo(self.dtype).max

    @property
    def columns(self) -> list[str]:
        """Names of its columns, e.g. ``observations.hand_x_m``."""
        short = self.name.rpartition(".")[2]
        unit = f"_{_UNITS[short]}" if short in _UNITS else ""
        names = []
        for index in np.ndindex(self.shape):
            places = [str(number) for number in index]
            if short in _PLANAR and self.shape[-1:] == (2,):
                places[-1] = "xy"[index[-1]]
            names.append("_".join([self.name, *places]) + unit)
        return names

    def flat(self, array: NDArray[Any]) -> NDArray[Any]:
        """Reshape an array to a table, shape (rows, width)."""
        return array.reshape(len(array), self.width)

    def shaped(self, rows: Any) -> NDArray[Any]:
        """Reshape a table, shape (rows, width), to an array of the field's type and shape."""
        return np.asarray(rows).astype(self.dtype).reshape(len(rows), *self.shape)


def fields_of(recording: Recording) -> list[Field]:
    """Return the fields of a recording, the same in all episodes."""
    return [Field(name, np.dtype(dtype), shape) for name, (dtype, shape) in row_shapes(recording[0]).items()]


def constant_fields(recording: Recording) -> set[str]:
    """Return the names of the observations and infos that stay the same throughout each episode."""
    names = {name for name in episode_arrays(recording[0]) if "." in name}
    for episode in recording:
        arrays = episode_arrays(episode)
        names = {name for name in names if (_bits(arrays[name]) == _bits(arrays[name][:1])).all()}
    return names


def _bits(array: NDArray[Any]) -> NDArray[np.uint8]:
    """Return the bytes of each row, so that 0.0 and -0.0 differ and NaN equals itself."""
    return np.frombuffer(array.tobytes(), np.uint8).reshape(len(array), -1)


def has_last_row(name: str) -> bool:
    """Return whether a field has a row for the end of an episode: observations, infos and states have, actions not."""
    return name == "states" or "." in name


def fields_to_meta(recording: Recording) -> dict[str, Any]:
    """Return types and shapes of the fields in JSON types."""
    return {field.name: [field.dtype.str, list(field.shape)] for field in fields_of(recording)}


def fields_from_meta(meta: Any, where: str) -> list[Field]:
    """Return the fields that `fields_to_meta` wrote.

    Raises:
        FileFormatError: If they are no fields of numbers; the message begins with ``where``.
    """
    try:
        fields = [
            Field(str(name), np.dtype(str(dtype)), tuple(map(int, shape))) for name, (dtype, shape) in meta.items()
        ]
    except (AttributeError, TypeError, ValueError, OverflowError, SyntaxError) as error:
        raise FileFormatError(where, "the types and shapes of a recording", f"{error!r:.80}") from None
    for field in fields:
        if field.dtype.kind not in "biuf" or min(field.shape, default=0) < 0 or field.width > _MAX_NUMBERS:
            raise FileFormatError(f"{where}: {field.name}", "a field of numbers", f"{field.dtype} {field.shape}")
    return fields


def check_columns(fields: Sequence[Field], most: int) -> None:
    """Check that fields take at most ``most`` columns, all of different names.

    Raises:
        InvalidInputError: If they do not.
    """
    total = sum(field.width for field in fields)
    if total > most:
        expected = f"at most {most} numbers a step (record states, and let replay.py draw the pixels)"
        raise InvalidInputError("recording", expected, f"{total}")
    name, count = Counter(column for field in fields for column in field.columns).most_common(1)[0]
    if count > 1:
        raise InvalidInputError("recording", "a column for each number", f"{name!r} twice")
