"""Demonstrations as three CSV tables in a folder.

=============== ============================================= ======================================================
table           columns                                       a line is
=============== ============================================= ======================================================
``hands.csv``   demonstration,sample,time_s,hand_x_m,hand_y_m where the hand was at a time, table frame
``objects.csv`` demonstration,object,x_m,y_m                  where an object is, table frame
``signs.csv``   demonstration,sign,sample,x_any,y_any         a point of a sign, in the unit in which it was drawn
=============== ============================================= ======================================================

Everything is counted from 0 and comes in the order of its numbers.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.formats.csv_tables import CsvRow, read_table, write_table
from signimit.io.safe_files import whole_folder

HANDS, OBJECTS, SIGNS = "hands.csv", "objects.csv", "signs.csv"
COLUMNS = {
    HANDS: ("demonstration", "sample", "time_s", "hand_x_m", "hand_y_m"),
    OBJECTS: ("demonstration", "object", "x_m", "y_m"),
    SIGNS: ("demonstration", "sign", "sample", "x_any", "y_any"),
}
Path2D = NDArray[np.float64]


def write_csv_demonstrations(
    folder: str | os.PathLike[str], demonstrations: DemonstrationSet, overwrite: bool = False
) -> None:
    """Write a folder of tables, whole or not at all.

    Raises:
        InvalidInputError: If there is something of that name, unless such tables that may be replaced.
    """
    with whole_folder(folder, HANDS, overwrite) as draft:
        for name, columns in COLUMNS.items():
            write_table(draft / name, columns, _lines(name, demonstrations))


def read_csv_demonstrations(folder: str | os.PathLike[str]) -> DemonstrationSet:
    """Read what `write_csv_demonstrations` wrote, or anybody else who keeps to the columns.

    Raises:
        FileNotFoundError: If a table is missing.
        FileFormatError: Names the file, the line and the column.
    """
    place = Path(folder)
    hands, objects = (_blocks(place / name, depth=1) for name in (HANDS, OBJECTS))
    signs = _blocks(place / SIGNS, depth=2)
    if not len(hands) == len(objects) == len(signs):
        found = f"{len(hands)} in {HANDS}, {len(objects)} in {OBJECTS}, {len(signs)} in {SIGNS}"
        raise FileFormatError(os.fspath(folder), "as many demonstrations in each table", found)
    try:
        return DemonstrationSet(
            _demonstration(number, *parts) for number, parts in enumerate(zip(hands, objects, signs, strict=True))
        )
    except InvalidInputError as error:
        raise FileFormatError(f"{folder}: {error.where}", error.expected, error.found) from None


def _demonstration(number: int, hand: list[Path2D], objects: list[Path2D], signs: list[Path2D]) -> Demonstration:
    try:
        return Demonstration(tuple(signs), objects[0], hand[0][:, 1:], hand[0][:, 0])
    except InvalidInputError as error:
        raise error.inside(f"demonstration {number}") from None


def _lines(name: str, demonstrations: DemonstrationSet) -> Iterator[tuple[object, ...]]:
    for number, one in enumerate(demonstrations):
        if name == HANDS:
            rows = np.column_stack([one.times, one.hand])
            yield from ((number, k, *row) for k, row in enumerate(rows.tolist()))
        elif name == OBJECTS:
            yield from ((number, k, *row) for k, row in enumerate(one.objects.tolist()))
        else:
            for word, sign in enumerate(one.signs):
                yield from ((number, word, k, *row) for k, row in enumerate(sign.tolist()))


def _blocks(path: Path, depth: int) -> list[list[Path2D]]:
    """Read the numbers behind ``depth`` counters and a running number: for each demonstration its blocks of lines."""
    blocks: list[list[list[list[float]]]] = []
    for row in read_table(path, COLUMNS[path.name]):
        _open_block(blocks, row, depth)
        row.expect(depth, [len(blocks[-1][-1])])
        blocks[-1][-1].append(row.numbers(depth + 1))
    if not blocks:
        raise FileFormatError(str(path), "at least one line below the header", "none")
    return [[np.array(lines) for lines in group] for group in blocks]


def _open_block(blocks: list[list[list[list[float]]]], row: CsvRow, depth: int) -> None:
    """Begin a new demonstration, or within it a new sign, where the counters say so; they may only count up."""
    last = len(blocks) - 1
    if row.expect(0, [last, last + 1] if blocks else [0]) > last:
        blocks.append([[]])
        if depth == 2:
            row.expect(1, [0])
    elif depth == 2 and row.expect(1, [len(blocks[-1]) - 1, len(blocks[-1])]) == len(blocks[-1]):
        blocks[-1].append([])
