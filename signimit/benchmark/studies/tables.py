"""Tables of the study: a row for each condition and method, and the calibration of confidences."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.statistics import wilson_interval
from signimit.benchmark.tables import markdown_table
from signimit.io.safe_files import Record, replaced_path

OURS = "joint"  # the method that stands first in tables
BINS = 10  # of confidences, of equal width


class MethodScore(NamedTuple):
    """Number of sessions in which a method was right, with Wilson's 95 % interval of all inferences right."""

    cell: str
    method: str
    sessions: int
    group_right: int
    focus_right: int
    order_right: int
    all_right: int
    all_low: float
    all_high: float


def tabulate(records: Sequence[Record]) -> list[MethodScore]:
    """Count for each cell and method, ours first, in the order they first appear."""
    rows = []
    for cell in dict.fromkeys(r["cell"] for r in records):
        mine = [r["verdicts"] for r in records if r["cell"] == cell]
        for method in sorted(mine[0], key=lambda name: name != OURS):
            verdicts = [v[method] for v in mine]
            every = sum(all(v) for v in verdicts)
            low, high = wilson_interval(every, len(verdicts))
            group, focus, order = (sum(v[i] for v in verdicts) for i in range(3))
            rows.append(
                MethodScore(cell, method, len(verdicts), group, focus, order, every, round(low, 3), round(high, 3))
            )
    return rows


def beaten_cells(rows: Sequence[MethodScore]) -> list[tuple[str, str, int, int]]:
    """Name every cell in which a baseline was right more often than ours: cell, method, its count and ours."""
    ours = {row.cell: row.all_right for row in rows if row.method == OURS}
    return [(r.cell, r.method, r.all_right, ours[r.cell]) for r in rows if r.all_right > ours[r.cell]]


def shares_table(rows: Sequence[MethodScore]) -> str:
    """Return the share of sessions with every inference right, per cent [95 %], as Markdown: a line for each cell."""
    methods = list(dict.fromkeys(row.method for row in rows))
    lines = []
    for cell in dict.fromkeys(row.cell for row in rows):
        mine = {row.method: row for row in rows if row.cell == cell}
        lines.append((cell, mine[methods[0]].sessions, *(_share(mine[method]) for method in methods)))
    return markdown_table(("cell", "n", *methods), lines)


def _share(row: MethodScore) -> str:
    text = f"{100 * row.all_right / row.sessions:.0f}"
    interval = f"[{100 * row.all_low:.0f}, {100 * row.all_high:.0f}]"
    return f"**{text}** {interval}" if row.method == OURS else f"{text} {interval}"


class Calibration(NamedTuple):
    """Calibration of confidences, and the risk when doubtful commands are declined.

    Attributes:
        confidence: Mean confidence of each bin that is not empty.
        accuracy: Share that was right in it.
        counts: How many commands it has.
        error: Expected calibration error: mean ``|confidence - accuracy|``, weighted by counts.
        coverage: Share of commands obeyed when those of lower confidence are declined, ascending.
        risk: Share of wrong ones among the obeyed, at each coverage.
    """

    confidence: NDArray[np.float64]
    accuracy: NDArray[np.float64]
    counts: NDArray[np.int64]
    error: float
    coverage: NDArray[np.float64]
    risk: NDArray[np.float64]


def calibrate(confidence: ArrayLike, right: ArrayLike) -> Calibration:
    """Compute the calibration of confidences, shape (n,), by what was right, shape (n,).

    The expected calibration error is that of M. P. Naeini, G. Cooper and M. Hauskrecht, AAAI 2015, with ten bins of
    equal width.
    """
    sure, truth = np.asarray(confidence, dtype=np.float64), np.asarray(right, dtype=np.float64)
    number = np.minimum((sure * BINS).astype(int), BINS - 1)
    count = np.bincount(number, minlength=BINS)
    full = count > 0
    mean = np.bincount(number, sure, BINS)[full] / count[full]
    accuracy = np.bincount(number, truth, BINS)[full] / count[full]
    error = float((count[full] * np.abs(mean - accuracy)).sum() / len(sure))
    order = np.argsort(-sure, kind="stable")
    asked = np.arange(1, len(sure) + 1)
    risk = np.cumsum(1 - truth[order]) / asked
    return Calibration(mean, accuracy, count[full], error, asked / len(sure), risk)


class LessonRow(NamedTuple):
    """Share of commands understood after so many demonstrations: mean over lessons and its 95 % interval."""

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
                LessonRow(cell, asking, mine[0]["first"] + i, len(mine), *(round(float(x), 4) for x in ends))
                for i, ends in enumerate(np.clip(np.column_stack([mean, mean - half, mean + half]), 0, 1))
            ]
    return rows


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


def write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write a table with a header, whole or not at all."""
    with replaced_path(path) as beside, beside.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(rows)
