"""One way to measure, in turns, and one form of results: tables as JSON for programs and as Markdown for people."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.results import installed_versions
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError
from signimit_envs.sessions.report import PACKAGES


def read_clock() -> tuple[float, float]:
    """Return the time on the wall and the computing time of all threads of this process, s."""
    return time.perf_counter(), time.process_time()


def time_in_turns(
    ways: Mapping[str, Callable[[], object]], turns: int, prepare: Mapping[str, Callable[[int], object]] | None = None
) -> dict[str, NDArray[np.float64]]:
    """Time several ways of doing the same work in turns, so that what else the machine does strikes all of them.

    Args:
        ways: What is timed, by name.
        turns: How often.
        prepare: What is called before, untimed, with the number of the turn, for those ways that need it.

    Returns:
        Time on the wall and computing time of each way in each turn, shape (turns, 2), s.

    Raises:
        InvalidInputError: If there is to be no turn.
    """
    if turns < 1:
        raise InvalidInputError("turns", "at least 1", f"{turns}")
    times = {name: np.empty((turns, 2)) for name in ways}
    for turn in range(turns):
        for name, run in ways.items():
            if prepare and name in prepare:
                prepare[name](turn)
            start = read_clock()
            run()
            times[name][turn] = np.subtract(read_clock(), start)
    return times


class Timing(NamedTuple):
    """How long a piece of work takes, beside the plainest way of doing it where there is one.

    Attributes:
        work: What is done.
        seconds: Time on the wall, the least of all turns, s.
        plain: Time of the plain way, the least, s.
        ratio: Median over the turns of ours over plain.
        limit: What the ratio, or where there is none the time, should not exceed.
    """

    work: str
    seconds: float
    plain: float | None = None
    ratio: float | None = None
    limit: float | None = None

    @classmethod
    def of(
        cls,
        work: str,
        ours: NDArray[np.float64],
        plain: NDArray[np.float64] | None = None,
        *,
        limit: float | None = None,
        pieces: int = 1,
    ) -> Timing:
        """Summarise what `time_in_turns` returned for so many pieces of work."""
        wall = ours[:, 0] / pieces
        if plain is None:
            return cls(work, float(wall.min()), limit=limit)
        theirs = plain[:, 0] / pieces
        return cls(work, float(wall.min()), float(theirs.min()), float(np.median(wall / theirs)), limit)


class Table(NamedTuple):
    """Rows of a result: named tuples, whose fields are the columns.

    Attributes:
        name: Key in the JSON, and heading on the page.
        text: What the numbers are, for people.
        rows: At least one.
    """

    name: str
    text: str
    rows: Sequence[Any]


def result_facts(command: str, plan: Mapping[str, Any], tables: Sequence[Table]) -> dict[str, Any]:
    """Return all rows, and how and with what they were measured, in what JSON can say."""
    made = {"command": command, "processors": os.cpu_count(), "load": os.getloadavg()[0]}
    rows = {table.name: [row._asdict() for row in table.rows] for table in tables}
    return {**made, "versions": installed_versions(*PACKAGES), "plan": dict(plan), **rows}


def result_page(title: str, facts: Mapping[str, Any], tables: Sequence[Table]) -> str:
    """Return a Markdown page with all tables."""
    versions = ", ".join(f"{name} {version}" for name, version in facts["versions"].items())
    made = f"Made by `{facts['command']}` on {facts['processors']} processors, load {facts['load']:.1f}."
    parts = [f"# {title}", f"{made}\nVersions: {versions}."]
    for table in tables:
        head = [name.replace("_", " ") for name in table.rows[0]._fields]
        rows = [
            ["" if v is None else f"{v:.4g}" if isinstance(v, float) else str(v) for v in row] for row in table.rows
        ]
        parts += [f"## {table.name.capitalize()}", table.text, markdown_table(head, rows)]
    return "\n\n".join(parts) + "\n"
