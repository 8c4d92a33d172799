"""What came out of all sessions, as rows: one for each cell and method."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from signimit.benchmark.studies.records import OURS, Record
from signimit.intervals import wilson_interval


class Row(NamedTuple):
    """How often a method was right in a cell, with Wilson's 95 % interval of all inferences right."""

    cell: str
    method: str
    sessions: int
    group_right: int
    focus_right: int
    order_right: int
    all_right: int
    all_low: float
    all_high: float


def tabulate(records: Sequence[Record]) -> list[Row]:
    """Count for each cell and method, ours first, in the order they first appear."""
    rows = []
    for cell in dict.fromkeys(r["cell"] for r in records):
        mine = [r["verdicts"] for r in records if r["cell"] == cell]
        for method in sorted(mine[0], key=lambda name: name != OURS):
            verdicts = [v[method] for v in mine]
            every = sum(all(v) for v in verdicts)
            low, high = wilson_interval(every, len(verdicts))
            group, focus, order = (sum(v[i] for v in verdicts) for i in range(3))
            rows.append(Row(cell, method, len(verdicts), group, focus, order, every, round(low, 3), round(high, 3)))
    return rows


def beaten_cells(rows: Sequence[Row]) -> list[tuple[str, str, int, int]]:
    """Name every cell in which a baseline was right more often than ours: cell, method, its count and ours."""
    ours = {row.cell: row.all_right for row in rows if row.method == OURS}
    return [(r.cell, r.method, r.all_right, ours[r.cell]) for r in rows if r.all_right > ours[r.cell]]


def markdown(rows: Sequence[Row]) -> str:
    """Return the share of sessions with every inference right, in per cent, a line for each cell."""
    methods = list(dict.fromkeys(row.method for row in rows))
    lines = ["| cell | n | " + " | ".join(methods) + " |", "|---" * (len(methods) + 2) + "|"]
    for cell in dict.fromkeys(row.cell for row in rows):
        mine = {row.method: row for row in rows if row.cell == cell}
        shares = " | ".join(_share(mine[method]) for method in methods)
        lines.append(f"| {cell} | {mine[methods[0]].sessions} | {shares} |")
    return "\n".join(lines)


class LessonRow(NamedTuple):
    """How well commands were understood after so many demonstrations: mean over lessons and its 95 % interval."""

    cell: str
    asking: str
    demonstrations: int
    lessons: int
    understood: float
    low: float
    high: float


def tabulate_lessons(records: Sequence[Record]) -> list[LessonRow]:
    """Average the accuracy of lessons for each cell, strategy and number of demonstrations."""
    rows = []
    for cell in dict.fromkeys(r["cell"] for r in records):
        mine = [r for r in records if r["cell"] == cell]
        for asking in mine[0]["curves"]:
            curves = np.array([r["curves"][asking] for r in mine])
            mean = curves.mean(axis=0)
            half = 1.96 * curves.std(axis=0, ddof=min(1, len(curves) - 1)) / np.sqrt(len(curves))
            rows += [
                LessonRow(cell, asking, mine[0]["first"] + i, len(mine), *map(_to_share, (m, m - h, m + h)))
                for i, (m, h) in enumerate(zip(mean, half, strict=True))
            ]
    return rows


def _to_share(value: float) -> float:
    return round(min(max(float(value), 0.0), 1.0), 4)


def demonstrations_needed(rows: Sequence[LessonRow], share: float) -> list[tuple[str, str, int | None]]:
    """Count for each cell and strategy the demonstrations from which on at least ``share`` is understood."""
    found: list[tuple[str, str, int | None]] = []
    for cell, asking in dict.fromkeys((row.cell, row.asking) for row in rows):
        mine = [row for row in rows if (row.cell, row.asking) == (cell, asking)]
        below = [row.demonstrations for row in mine if row.understood < share]
        last = mine[-1].demonstrations
        enough = max(below, default=mine[0].demonstrations - 1) + 1
        found.append((cell, asking, enough if enough <= last else None))
    return found


def _share(row: Row) -> str:
    text = f"{100 * row.all_right / row.sessions:.0f}"
    return f"**{text}** [{100 * row.all_low:.0f}, {100 * row.all_high:.0f}]" if row.method == OURS else text


def write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write a table with a header."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(rows)
