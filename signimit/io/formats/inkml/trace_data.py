"""What stands in a ``<trace>``: explicit values, first and second differences, wildcards, hexadecimals and booleans.

InkML 1.1, section 3.2.1. A prefix holds for its channel until the next: ``!`` explicit, ``'`` difference to the value
before, ``"`` difference to the difference before. ``*`` goes on as before: the same value, the same difference or the
same second difference. ``?`` was not reported.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError
from signimit.io.formats.inkml.trace_format import Channel, TraceFormat
from signimit.validation import LARGEST

_ORDERS = {"!": 0, "'": 1, '"': 2}
_PLAIN = re.compile(r"[\d\s.,+\-eE]*", re.ASCII)  # nothing but explicit numbers
_VALUE = re.compile(
    r"""\s*(?P<prefix>[!'"]?)\s*
    (?P<word>[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?(?![\d.]) | [+-]?\#[0-9A-Fa-f]{1,15} | [TF*?])\s*""",
    re.ASCII | re.VERBOSE,
)


class TraceData(NamedTuple):
    """The points of a trace.

    Attributes:
        values: One row a point, one column a channel, NaN where nothing was reported.
        stray_commas: How many commas have no point behind or before them.
    """

    values: NDArray[np.float64]
    stray_commas: int


def read_trace_data(text: str, layout: TraceFormat) -> TraceData:
    """Decode the text of a trace.

    Raises:
        FileFormatError: Names the point, counted from 0, and what was expected there.
    """
    data = _decoded(text, layout)
    large = np.argwhere(np.abs(data.values) > LARGEST)  # a comparison with NaN is false
    if len(large):
        value = data.values[tuple(large[0])]
        raise FileFormatError(f"point {large[0][0]}", f"numbers up to {LARGEST:g}", f"{value:g}")
    return data


def _decoded(text: str, layout: TraceFormat) -> TraceData:
    points = [point for point in text.split(",") if point and not point.isspace()]
    stray = text.count(",") + 1 - len(points) if points else text.count(",")
    if _PLAIN.fullmatch(text):
        try:
            rows = [[float(word) for word in point.split()] for point in points]
        except ValueError:  # values without a blank between, as in 3-5
            rows = []
        if rows and all(len(row) == len(layout.channels) for row in rows):
            return TraceData(np.array(rows, dtype=np.float64), stray)
    columns = [_Column(channel) for channel in layout.channels]
    values = [_read_point(point, columns, layout, f"point {i}") for i, point in enumerate(points)]
    return TraceData(np.array(values, dtype=np.float64).reshape(-1, len(columns)), stray)


class _Column:
    """The running state of one channel: how it is encoded, its value and its differences."""

    def __init__(self, channel: Channel) -> None:
        self.channel = channel
        self.order = 0
        self.value: float | None = None
        self.difference = self.second = 0.0

    def read(self, prefix: str, word: str) -> float:
        """Return the next value.

        Raises:
            ValueError: If the channel cannot hold it, or has no value yet to which it is a difference.
        """
        self.order = _ORDERS.get(prefix, self.order)
        if word == "?":
            return np.nan
        if word in ("T", "F"):
            if self.channel.numeric:
                raise ValueError
            self.value = float(word == "T")
            return self.value
        if word == "*" and self.value is None:
            self.value = self.channel.default
        if self.value is None and self.order:
            raise ValueError
        return self._follow(None if word == "*" else _number(word))

    def _follow(self, number: float | None) -> float:
        """Take a number as what the encoding says it is; none repeats what was."""
        before, difference = self.value or 0.0, self.difference
        if self.order == 0:
            value = before if number is None else number
            self.difference = 0.0 if self.value is None else value - before
        else:
            step = number if number is not None else (difference, self.second)[self.order - 1]
            self.difference = step if self.order == 1 else difference + step
            value = before + self.difference
        self.second = self.difference - difference
        self.value = value
        return value

    def hold(self) -> float:
        """Return the value of a channel that a point leaves out; a clock is not known there."""
        if self.channel.name == "T":
            return np.nan
        return self.channel.default if self.value is None else self.value


def _read_point(point: str, columns: Sequence[_Column], layout: TraceFormat, place: str) -> list[float]:
    words, end = [], 0
    while end < len(point) and (found := _VALUE.match(point, end)):
        words.append((found["prefix"], found["word"]))
        end = found.end()
    try:
        if end < len(point) or not layout.required <= len(words) <= len(columns):
            raise ValueError
        row = [column.read(*word) for column, word in zip(columns, words, strict=False)]
    except ValueError:
        raise FileFormatError(place, layout.point_description, repr(point.strip()[:60])) from None
    return row + [column.hold() for column in columns[len(words) :]]


def _number(word: str) -> float:
    if "#" in word:
        return float(int(word.replace("#", ""), 16))
    return float(word)
