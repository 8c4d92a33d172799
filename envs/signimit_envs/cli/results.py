"""The tables of the README, written from the files of results: none is typed."""

from __future__ import annotations

import csv
import itertools
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from signimit.benchmark.statistics import wilson_interval
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import replaced_file

REGION = re.compile(r"(<!-- table: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)

CHECKED = {
    "base": "3 movements, 3 objects, one signer, one mover, 12 demonstrations",
    "each": "the same with 6 demonstrations",
    "mixed": "another person for every sign and every movement",
    "six": "6 movements, 4 objects, 18 demonstrations, each pair once",
    "seven": "7 movements, 6 objects, another person every time, 28 demonstrations",
    "paper": "the paper's inference, 12 demonstrations",
    "literal": "Algorithm 1 as printed",
}


def write_readme(readme: Path = Path("README.md")) -> None:
    """Write the tables of the README anew, from the folder ``results`` beside it.

    Args:
        readme: The file; whatever stands between ``<!-- table: NAME -->`` and ``<!-- end -->`` is replaced.
    """
    old = readme.read_text(encoding="utf-8")
    new = with_tables(old, readme.parent / "results")
    with replaced_file(readme) as file:
        file.write(new.encode())
    print(f"{len(REGION.findall(old))} tables, {'changed' if new != old else 'as they were'}.")


def with_tables(text: str, results: Path) -> str:
    """Replace all tables of a text by those of a folder of results."""

    def replaced(match: re.Match[str]) -> str:
        start, name, end = match.groups()
        if name not in TABLES:
            raise InvalidInputError("README: table", ", ".join(TABLES), repr(name))
        return start + TABLES[name](results) + "\n" + end

    return REGION.sub(replaced, text)


def read_json(path: Path) -> Any:
    """Read a JSON file of results."""
    return json.loads(path.read_text(encoding="utf-8"))


def read_csv(path: Path) -> list[dict[str, str]]:
    """Read a CSV file of results."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def table_of_page(path: Path) -> str:
    """Return the first Markdown table of a page."""
    lines = itertools.dropwhile(lambda line: not line.startswith("|"), path.read_text(encoding="utf-8").splitlines())
    return "\n".join(itertools.takewhile(lambda line: line.startswith("|"), lines))


def share(count: int, total: int) -> str:
    """Say a share with Wilson's 95 % interval, per cent."""
    low, high = wilson_interval(count, total)
    return f"{100 * count / total:.1f} % [{100 * low:.1f}, {100 * high:.1f}]"


def checker(results: Path) -> str:
    """Sessions of real people, as another program than ours makes and judges them."""
    rows = []
    for name, what in CHECKED.items():
        found = read_json(results / "checker" / f"{name}.json")
        right, obeyed = (
            [int(number) for number in re.findall(r"\((\d+)/(\d+)\)", found[key])[0]]
            for key in ("all inferences right", "obeyed")
        )
        rows.append((what, right[1], right[0], share(*obeyed)))
    return markdown_table(("sessions", "", "every inference right", "commands obeyed [95 %]"), rows)


def sessions(results: Path) -> str:
    """Built-in sessions on the physics, of the paper's learner and of ours."""
    rows = []
    for method in ("paper", "joint"):
        found = read_json(results / "sessions" / method / "sessions.json")["shares"]
        stages = ("grouping right", "all foci right", "word order right")
        counts = [f"{found[stage]['count']} of {found[stage]['total']}" for stage in stages]
        rows.append((f"`{method}`", *counts, share(found["obeyed"]["count"], found["obeyed"]["total"])))
    return markdown_table(("", "grouping", "focus", "word order", "obeyed [95 %]"), rows)


def policies(results: Path) -> str:
    """Policies on the same lessons of real people."""
    lines = table_of_page(results / "policies" / "real" / "table.md").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    wanted = [cells[0].index(name) for name in ("kind", "drawn", "misfit", "corner gap", "detour", "back after shove")]
    return markdown_table([cells[0][i] for i in wanted], [[row[i] for i in wanted] for row in cells[2:]])


def study(results: Path) -> str:
    """Learners and baselines: sessions with every inference right, by people and condition."""
    rows = read_csv(results / "study" / "cells.csv")
    methods = list(dict.fromkeys(row["method"] for row in rows))
    kinds = dict.fromkeys((row["cell"].split()[0], row["cell"].split(" ", 2)[2]) for row in rows)
    lines = []
    for people, condition in kinds:
        mine = [r for r in rows if r["cell"].split(" ", 2)[::2] == [people, condition]]
        counts = {m: [(int(r["all_right"]), int(r["sessions"])) for r in mine if r["method"] == m] for m in methods}
        shares = [f"{100 * sum(n for n, _ in c) / sum(of for _, of in c):.0f}" for c in counts.values()]
        cells = len({r["cell"] for r in mine})
        lines.append((f"{people}, {condition}", cells, f"**{shares[0]}**", *shares[1:]))
    return markdown_table(("%", "cells", *methods), lines)


def signs(results: Path) -> str:
    """Signs read on their own, by method."""
    rows = [((r["signs"], r["shown"], r["signers"]), r) for r in read_csv(results / "study" / "signs.csv")]
    methods = list(dict.fromkeys(row["method"] for _, row in rows))
    right = {(*quiz, row["method"]): share(int(row["right"]), int(row["asked"])) for quiz, row in rows}
    lines = [(*quiz, *(right[*quiz, method] for method in methods)) for quiz in dict.fromkeys(quiz for quiz, _ in rows)]
    return markdown_table(("signs", "examples of each", "signers", *methods), lines)


def asking(results: Path) -> str:
    """How many demonstrations it takes by what is asked for."""
    facts = read_json(results / "study" / "asking.json")
    needed = next(value for key, value in facts.items() if key.startswith("demonstrations until"))
    strategies = list(dict.fromkeys(strategy for _, strategy, _ in needed))
    count = {(cell, strategy): number for cell, strategy, number in needed}
    cells = dict.fromkeys(cell for cell, _, _ in needed)
    rows = [(cell, *(count[cell, s] or "more than were shown" for s in strategies)) for cell in cells]
    return markdown_table(("people, movements x objects", *strategies), rows)


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
    return table_of_page(results / "benchmark" / "README.md")


def throughput(results: Path) -> str:
    """Many reproductions at once beside one at a time."""
    head = ("at once", "threads", "reproductions a second", "least of all turns", "the same by computing time")
    rows = read_json(results / "throughput" / "throughput.json")["batches"]
    times = ("faster", "lowest", "computing")
    return markdown_table(
        head, [(r["batch"], r["threads"] or "all", *(f"{r[name]:.1f} x" for name in times)) for r in rows]
    )


TABLES: dict[str, Callable[[Path], str]] = {
    "checker": checker, "sessions": sessions, "policies": policies, "study": study, "signs": signs,
    "asking": asking, "growth": growth, "benchmark": benchmark, "throughput": throughput,
}  # fmt: skip
SUBCOMMANDS = {"readme": write_readme}
