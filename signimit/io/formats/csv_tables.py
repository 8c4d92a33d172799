"""Tables as CSV text (RFC 4180): strict, one header line, and numbers that come back bit for bit."""

from __future__ import annotations

import csv
import io
import math
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from signimit.exceptions import FileFormatError
from signimit.io.formats.textfile import read_text

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")  # float() also takes "1_0", "nan" and " 1 "
_WHOLE = re.compile(r"-?\d{1,40}")
_NOT_FINITE = ("inf", "-inf", "nan")
_SHOWN = 40  # characters of a wrong cell that a complaint repeats


class CsvRow(NamedTuple):
    """One line of a table.

    Attributes:
        where: File and line, for complaints.
        columns: The columns' names.
        cells: The texts, as many as there are columns.
    """

    where: str
    columns: Sequence[str]
    cells: Sequence[str]

    def whole(self, column: int) -> int:
        """Read a whole number."""
        if not _WHOLE.fullmatch(self.cells[column]):
            raise self.complaint(column, "a whole number")
        return int(self.cells[column])

    def numbers(self, start: int, stop: int | None = None) -> list[float]:
        """Read finite numbers from neighbouring cells."""
        values = [float(cell) if _NUMBER.fullmatch(cell) else math.inf for cell in self.cells[start:stop]]
        for at, value in enumerate(values, start):
            if math.isinf(value):
                raise self.complaint(at, "a finite number")
        return values

    def measurements(self, start: int, stop: int | None = None) -> list[float]:
        """Read numbers from neighbouring cells that may also be ``inf``, ``-inf`` or ``nan``."""
        cells = self.cells[start:stop]
        return [float(c) if c in _NOT_FINITE else self.numbers(at, at + 1)[0] for at, c in enumerate(cells, start)]

    def expect(self, column: int, wanted: Iterable[int]) -> int:
        """Read a number that has to be one of a few."""
        known = list(wanted)
        value = self.whole(column)
        if value not in known:
            raise self.complaint(column, " or ".join(map(str, known)))
        return value

    def complaint(self, column: int, expected: str) -> FileFormatError:
        """Return an error that names file, line and column."""
        found = repr(self.cells[column][:_SHOWN])
        return FileFormatError(f"{self.where}, column {self.columns[column]}", expected, found)


def write_table(path: str | os.PathLike[str], columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table; floats as the shortest text that reads back to the same float."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def read_table(path: str | os.PathLike[str], columns: Sequence[str]) -> Iterator[CsvRow]:
    """Go through the lines of a table that must have exactly these columns.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: Names the file, the line and the column.
    """
    text = read_text(path)
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        header = next(reader, [])
        if header != list(columns):
            wrong = next((h for h, c in zip(header, columns, strict=False) if h != c), f"{len(header)} columns")
            shown = ",".join(columns)[:200]
            raise FileFormatError(f"{path}, line 1", f"the columns {shown}", repr(wrong[:_SHOWN]))
        if not text.endswith(("\n", "\r")):
            last = text.count("\n") + 1
            raise FileFormatError(f"{path}, line {last}", "a line's end, as whole files have", "the end of the file")
        for cells in reader:
            where = f"{path}, line {reader.line_num}"
            if len(cells) != len(columns):
                raise FileFormatError(where, f"{len(columns)} cells", f"{len(cells)}")
            yield CsvRow(where, columns, cells)
    except csv.Error as error:
        raise FileFormatError(f"{path}, line {reader.line_num}", "comma-separated values", str(error)) from None
