"""The tables of README and docs, made from the files of results: none is typed."""

from __future__ import annotations

import csv
import itertools
import json
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from signimit.benchmark.judge import CRITERION, judge_hash
from signimit.benchmark.results import read_comparable_summaries
from signimit.benchmark.statistics import share_text, wilson_interval
from signimit.benchmark.tables import markdown_table, overview
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit_envs.cli.checker_tables import checker, people_as_they_are

REGION = re.compile(r"(<!-- table: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)

HEADLINE_ENTRIES = ("joint",)  # of the benchmark, in the README; the board has all
UNDERSTOOD = 0.95  # share of commands that a lesson shall come to


def with_tables(text: str, results: Path) -> str:
    """Replace all tables of a text by those of a folder of results."""

    def replaced(match: re.Match[str]) -> str:
        start, name, end = match.groups()
        if name not in TABLES:
            raise InvalidInputError("table of results", ", ".join(TABLES), repr(name))
        return start + TABLES[name](results) + "\n" + end

    return REGION.sub(replaced, text)


def read_json(path: Path) -> Any:
    """Read a JSON file of results."""
    return json.loads(path.read_text(encoding="utf-8"))


def read_judged(path: Path, measurement: str) -> Any:
    """Read a JSON file of results that says what was obeyed.

    Raises:
        FileFormatError: If another judge said so.
    """
    found = read_json(path)
    if found.get("judge") != judge_hash():
        wanted = f"verdicts of judge {judge_hash()} (`results make {measurement}` measures them again)"
        raise FileFormatError(str(path), wanted, f"judge {found['judge']}" if "judge" in found else "no judge")
    return found


def read_csv(path: Path) -> list[dict[str, str]]:
    """Read a CSV file of results."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def table_of_page(path: Path) -> str:
    """Return the first Markdown table of a page."""
    lines = itertools.dropwhile(lambda line: not line.startswith("|"), path.read_text(encoding="utf-8").splitlines())
    return "\n".join(itertools.takewhile(lambda line: line.startswith("|"), lines))


def sessions(results: Path) -> str:
    """Built-in sessions on the physics, of the paper's imitator and of ours."""
    rows = []
    for method in ("joint", "paper"):
        found = read_judged(results / "sessions" / method / "sessions.json", "sessions")
        stages = ("grouping right", "all foci right", "word order right", "obeyed")
        counts = [share_text(found["shares"][s]["count"], found["shares"][s]["total"]) for s in stages]
        rows.append((f"`--method {method} --policy {found['policy']}`", *counts))
    head = ("", "grouping [95 %]", "every focus [95 %]", "word order [95 %]", "commands obeyed [95 %]")
    return markdown_table(head, rows)


def read_people(results: Path) -> list[dict[str, str]]:
    """Read the rows of the sessions of real people."""
    read_judged(results / "real-people" / "people.json", "real-people")
    return read_csv(results / "real-people" / "people.csv")


def obeyed_text(row: Mapping[str, str]) -> str:
    """Say the commands obeyed in a row of `signimit.benchmark.studies.real_people.RealRow`."""
    count, total, low, high = int(row["obeyed"]), int(row["commands"]), float(row["low"]), float(row["high"])
    return f"{count} of {total}: {100 * count / total:.1f} % [{100 * low:.1f}, {100 * high:.1f}]"


def real_people(results: Path) -> str:
    """Sessions of real people, as this project makes and judges them."""
    rows = [
        (f"`{r['method']}`", r["sessions"], share_text(int(r["inferred"]), int(r["sessions"])), obeyed_text(r))
        for r in read_people(results)
        if r["who"] == "all"
    ]
    return markdown_table(("", "sessions", "every inference right [95 %]", "commands obeyed [95 %]"), rows)


def each_person(results: Path) -> str:
    """The same by person."""
    rows = read_people(results)
    methods = list(dict.fromkeys(r["method"] for r in rows))
    lines = []
    for who in dict.fromkeys(r["who"] for r in rows if r["who"] != "all"):
        mine = {r["method"]: r for r in rows if r["who"] == who}
        cells = (f"{mine[m]['inferred']} of {mine[m]['sessions']} | {obeyed_text(mine[m])}" for m in methods)
        lines.append((who, *cells))
    head = (name for m in methods for name in (f"`{m}`: every inference right", f"`{m}`: obeyed [95 %]"))
    return markdown_table(("person", *head), lines)


def policies(results: Path) -> str:
    """Policies on the same lessons of real people: the measures that matter most."""
    wanted = ("kind", "lessons", "hands", "drawn", "misfit", "corner gap", "detour", "back after shove")
    lines = table_of_page(results / "policies" / "real" / "table.md").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    columns = [cells[0].index(name) for name in wanted]
    return markdown_table([cells[0][i] for i in columns], [[row[i] for i in columns] for row in cells[2:]])


def policies_synthetic(results: Path) -> str:
    """Policies on lessons of synthetic people: all measures."""
    return table_of_page(results / "policies" / "synthetic" / "table.md")


def policies_real(results: Path) -> str:
    """Policies on lessons of real people: all measures."""
    return table_of_page(results / "policies" / "real" / "table.md")


def study(results: Path) -> str:
    """Learners and baselines: sessions with every inference right, by people and condition."""
    rows = read_csv(results / "study" / "cells.csv")
    methods = list(dict.fromkeys(row["method"] for row in rows))
    kinds = dict.fromkeys((row["cell"].split()[0], row["cell"].split(" ", 2)[2]) for row in rows)
    lines = []
    for people, condition in kinds:
        mine = [r for r in rows if r["cell"].split(" ", 2)[::2] == [people, condition]]
        counts = {m: [(int(r["all_right"]), int(r["sessions"])) for r in mine if r["method"] == m] for m in methods}
        totals = [tuple(map(sum, zip(*c, strict=True))) for c in counts.values()]
        ends = [wilson_interval(n, of) for n, of in totals]
        shares = [
            f"{100 * n / of:.0f} [{100 * low:.0f}, {100 * high:.0f}]"
            for (n, of), (low, high) in zip(totals, ends, strict=True)
        ]
        cells = len({r["cell"] for r in mine})
        lines.append((f"{people}, {condition}", cells, totals[0][1], f"**{shares[0]}**", *shares[1:]))
    return markdown_table(("% [95 %]", "cells", "sessions", *methods), lines)


def signs(results: Path) -> str:
    """Signs read on their own, by method."""
    rows = [((r["signs"], r["shown"], r["signers"]), r) for r in read_csv(results / "study" / "signs.csv")]
    methods = list(dict.fromkeys(row["method"] for _, row in rows))
    right = {(*quiz, row["method"]): share_text(int(row["right"]), int(row["asked"])) for quiz, row in rows}
    lines = [(*quiz, *(right[*quiz, method] for method in methods)) for quiz in dict.fromkeys(quiz for quiz, _ in rows)]
    return markdown_table(("signs", "examples of each", "signers", *methods), lines)


def asking(results: Path) -> str:
    """How many demonstrations it takes by what is asked for: where the mean and the ends of its interval reach 95 %."""
    rows = read_csv(results / "study" / "asking.csv")
    strategies = list(dict.fromkeys(r["asking"] for r in rows))

    def reached(mine: list[dict[str, str]], column: str) -> str:
        """Return the number from which on a column stays at 95 % or more."""
        below = [int(r["demonstrations"]) for r in mine if float(r[column]) < UNDERSTOOD]
        enough = max(below, default=int(mine[0]["demonstrations"]) - 1) + 1
        return str(enough) if enough <= int(mine[-1]["demonstrations"]) else f"> {mine[-1]['demonstrations']}"

    lines = []
    for cell in dict.fromkeys(r["cell"] for r in rows):
        by = {s: [r for r in rows if (r["cell"], r["asking"]) == (cell, s)] for s in strategies}
        needed = (f"{reached(m, 'understood')} [{reached(m, 'high')}, {reached(m, 'low')}]" for m in by.values())
        lines.append((cell, by[strategies[0]][0]["lessons"], *needed))
    return markdown_table(("people, movements x objects", "lessons", *strategies), lines)


def growth(results: Path) -> str:
    """What learning costs by the number of demonstrations."""
    rows = [row for row in read_csv(results / "study" / "scaling.csv") if row["step"] == "learning"]
    cost = {(int(r["demonstrations"]), r["code"]): (float(r["processor_seconds"]), float(r["megabytes"])) for r in rows}
    counts = sorted({count for count, _ in cost})
    lines = [
        (n, *(f"{cost[n, code][i]:.{2 if i == 0 else 0}f}" for i in (0, 1) for code in ("numba", "numpy")))
        for n in counts
    ]
    head = ("demonstrations", "processor s, `fast`", "without", "MB, `fast`", "without")
    return markdown_table(head, lines)


def benchmark(results: Path) -> str:
    """The leaderboard's first table."""
    return overview(read_comparable_summaries(results / "benchmark"))


def clumsiness(results: Path) -> str:
    """How unlike people draw one thing, real and built-in."""
    return (results / "clumsiness" / "clumsiness.md").read_text(encoding="utf-8").strip()


def criterion(results: Path) -> str:
    """What "obeyed" means."""
    return CRITERION


def headline(results: Path) -> str:
    """The five numbers of the README: what was measured, by which command."""
    rows = []
    for method in ("joint", "paper"):
        found = read_judged(results / "sessions" / method / "sessions.json", "sessions")
        what, obeyed = f"{len(found['sessions'])} built-in sessions, on the physics", found["shares"]["obeyed"]
        command = f"`sessions --method {method} --policy {found['policy']}`"
        rows.append((what, method, share_text(obeyed["count"], obeyed["total"]), command))
    for row in read_people(results):
        if row["who"] == "all":
            what = f"{row['sessions']} sessions of real people"
            rows.append((what, row["method"], obeyed_text(row), "`study real-people`"))
    board = [s for s in read_comparable_summaries(results / "benchmark") if s["entry"] in HEADLINE_ENTRIES]
    for summary in sorted(board, key=lambda s: -s["all"]["mean"]):
        every, splits = summary["all"], len(summary["splits"])
        interval = f"[{100 * every['low']:.1f}, {100 * every['high']:.1f}]"
        text = f"of {every['count']}: {100 * every['mean']:.1f} % {interval}"
        command = f"`benchmark run --entry {summary['entry']}`"
        rows.append((f"benchmark, mean over {splits} splits", summary["entry"], text, command))
    return markdown_table(("", "method", "commands obeyed [95 %]", "command"), rows)


def throughput(results: Path) -> str:
    """Many reproductions at once beside one at a time."""
    head = ("at once", "threads", "reproductions a second", "least of all turns", "the same by computing time")
    rows = read_json(results / "throughput" / "throughput.json")["batches"]
    times = ("faster", "lowest", "computing")
    return markdown_table(
        head, [(r["batch"], r["threads"] or "all", *(f"{r[name]:.1f} x" for name in times)) for r in rows]
    )


TABLES: dict[str, Callable[[Path], str]] = {
    "checker": checker, "people_as_they_are": people_as_they_are, "sessions": sessions, "policies": policies,
    "study": study, "signs": signs, "asking": asking, "growth": growth, "benchmark": benchmark,
    "throughput": throughput, "headline": headline, "criterion": criterion, "real_people": real_people,
    "each_person": each_person, "policies_synthetic": policies_synthetic, "policies_real": policies_real,
    "clumsiness": clumsiness,
}  # fmt: skip
