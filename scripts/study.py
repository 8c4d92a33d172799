#!/usr/bin/env python3
"""Every table and figure of how well demonstrations are understood, from seeds."""

from __future__ import annotations

import json
import os
import platform
import shlex
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any, Literal

import numpy as np
import scipy
from tqdm import tqdm

import signimit
from signimit.benchmark.studies.asking import asking_cells, run_lessons
from signimit.benchmark.studies.cells import Cell, People, study_cells
from signimit.benchmark.studies.left_out_people import FoldRow, leave_people_out
from signimit.benchmark.studies.records import OURS, Record, read_records, run_session, run_sessions
from signimit.benchmark.studies.scaling import Measurement, measure_growth
from signimit.benchmark.studies.scoring import calibrate
from signimit.benchmark.studies.signs import METHODS, QUIZZES, SignRow, run_quizzes
from signimit.benchmark.studies.tables import (
    LessonRow,
    Row,
    beaten_cells,
    demonstrations_needed,
    markdown,
    tabulate,
    tabulate_lessons,
    write_csv,
)
from signimit.exceptions import InvalidInputError
from signimit.intervals import wilson_interval
from signimit.io.safe_files import whole_files
from signimit.plots.studies import draw_calibration, draw_cells, draw_growth, draw_lessons
from signimit.strokes import StrokeLibrary
from signimit_envs.cli.command_line import run_program

OUT = Path("results/study")
UNDERSTOOD = 0.95  # share of commands that a lesson shall come to
LONGEST = 100.0  # s of processors; a step that would take longer is not measured at larger sizes


def main(
    what: Literal["cells", "calibration", "asking", "people", "signs", "scaling"],
    /,
    *,
    sessions: int = 20,
    first_seed: int = 0,
    signs: Path | None = None,
    movements: Path | None = None,
    only: str = "",
    workers: int = 0,
    counts: tuple[int, ...] = (12, 25, 50, 100, 200, 500, 1000),
    out: Path = OUT,
) -> None:
    """Compare the default learner with all baselines, look at its confidence, measure how it grows.

    Args:
        what: The table of all cells; the calibration of confidence in the sessions of that table; how much sooner a
            learner understands that asks; how people are understood who had no part in its constants; how signs are
            read, on their own; or time and memory against the number of demonstrations. Cells and asking go on where
            a killed run stopped.
        sessions: How many of each cell.
        first_seed: Seed of the first; the others follow.
        signs: Stroke library of real people who make signs; with movements, it adds the cells of real people.
        movements: Stroke library of real people who draw movements.
        only: Run only cells whose names contain this.
        workers: Processes; left out, one less than there are processors.
        counts: Numbers of demonstrations to measure, ascending.
        out: Folder for what is written.
    """
    if what == "calibration":
        calibration(out)
    elif what == "scaling":
        scaling(counts, out)
    elif what == "people":
        people_left_out(load_people(signs, movements), sessions, out)
    elif what == "signs":
        reading_signs(None if signs is None else StrokeLibrary.load(signs), sessions, out)
    else:
        people = load_people(signs, movements)
        kinds = study_cells if what == "cells" else asking_cells
        chosen = [c for c in kinds(people is not None) if only in c.name]
        if sessions < 1 or not chosen:
            raise InvalidInputError("cells", "at least 1 session of 1 cell", f"{sessions} of {len(chosen)}")
        workers = workers or max(1, (os.cpu_count() or 2) - 1)
        seeds = range(first_seed, first_seed + sessions)
        (cells if what == "cells" else asking)(chosen, seeds, people, workers, out)


def load_people(signs: Path | None, movements: Path | None) -> People | None:
    """Load real people's strokes, if both kinds are given."""
    if signs is None or movements is None:
        return None
    return People(StrokeLibrary.load(signs), StrokeLibrary.load(movements))


def cells(chosen: list[Cell], seeds: range, people: People | None, workers: int, out: Path) -> None:
    """Run the sessions that were not run yet, and write the table of all."""
    records = out / "sessions.jsonl"
    for _ in tqdm(run_sessions(run_session, chosen, seeds, records, people, workers), unit="session"):
        pass
    order = {c.name: number for number, c in enumerate(chosen)}
    found = [r for r in read_records(records) if r["cell"] in order and r["seed"] in seeds]
    rows = tabulate(sorted(found, key=lambda r: (order[r["cell"]], r["seed"])))
    with whole_files(out) as folder:
        write_csv(folder / "cells.csv", Row._fields, rows)
        (folder / "cells.md").write_text(markdown(rows) + "\n", encoding="utf-8")
        sources = [p.source for p in people] if people else ["synthetic"]
        facts = {"seeds": [seeds[0], seeds[-1]], "people": sources, "beaten": beaten_cells(rows)}
        _write_facts(folder / "cells.json", facts)
        draw_cells(rows).savefig(folder / "cells.png", dpi=90)
    print(markdown(rows))
    for cell, method, theirs, ours in beaten_cells(rows):
        print(f"{cell}: {method} was right in {theirs} sessions, {OURS} in {ours}")


def asking(chosen: list[Cell], seeds: range, people: People | None, workers: int, out: Path) -> None:
    """Run the lessons that were not run yet, and write the curves of all."""
    records = out / "lessons.jsonl"
    for _ in tqdm(run_sessions(run_lessons, chosen, seeds, records, people, workers), unit="lesson"):
        pass
    names = [c.name for c in chosen]
    found = [r for r in read_records(records) if r["cell"] in names and r["seed"] in seeds]
    rows = tabulate_lessons(sorted(found, key=lambda r: (names.index(r["cell"]), r["seed"])))
    needed = demonstrations_needed(rows, UNDERSTOOD)
    with whole_files(out) as folder:
        write_csv(folder / "asking.csv", LessonRow._fields, rows)
        facts = {"seeds": [seeds[0], seeds[-1]], f"demonstrations until {UNDERSTOOD:.0%} are understood": needed}
        _write_facts(folder / "asking.json", facts)
        draw_lessons(rows).savefig(folder / "asking.png", dpi=90)
    for cell, strategy, count in needed:
        print(f"{cell}, asking {strategy}: {UNDERSTOOD:.0%} understood from {count or 'more'} demonstrations on")


def people_left_out(people: People | None, sessions: int, out: Path) -> None:
    """Learn from people who had no part in the constants of the evidence, each left out once."""
    if people is None or sessions < 1:
        raise InvalidInputError("people", "--signs, --movements and at least 1 session", "less")
    rows = []
    for row in leave_people_out(people, sessions):
        print(
            f"{row.mover}, {row.cell}: {row.right_without} of {row.sessions} right with constants measured without "
            f"these people, {row.right_shipped} with the package's",
            flush=True,
        )
        rows.append(row)
    with whole_files(out) as folder:
        write_csv(folder / "people.csv", FoldRow._fields, rows)
        total = sum(row.sessions for row in rows)
        counts = {"without": sum(r.right_without for r in rows), "shipped": sum(r.right_shipped for r in rows)}
        shares = {k: [n, total, *(round(x, 4) for x in wilson_interval(n, total))] for k, n in counts.items()}
        _write_facts(folder / "people.json", {"people": [p.source for p in people], "right, of, 95 %": shares})


def reading_signs(library: StrokeLibrary | None, quizzes: int, out: Path) -> None:
    """Compare how signs are read, on their own."""
    if quizzes < 1:
        raise InvalidInputError("signs", "at least 1 session", str(quizzes))
    rows = []
    for row in tqdm(run_quizzes(library, quizzes), total=len(QUIZZES) * len(METHODS), unit="row"):
        tqdm.write(f"{row.signs}, {row.shown} shown, signers {row.signers}, {row.method}: {row.right} of {row.asked}")
        rows.append(row)
    with whole_files(out) as folder:
        write_csv(folder / "signs.csv", SignRow._fields, rows)
        _write_facts(folder / "signs.json", {"people": library.source if library else "synthetic"})


def calibration(out: Path) -> None:
    """Say how well confidences fit, over all commands of the sessions in the folder."""
    records = read_records(out / "sessions.jsonl")
    if not records:
        raise InvalidInputError(str(out / "sessions.jsonl"), "sessions; run `study.py cells` first", "none")
    groups = {"all": records} | {
        kind: [r for r in records if r["cell"].startswith(kind)] for kind in ("synthetic", "real")
    }
    rows, facts = [], {}
    for kind, mine in groups.items():
        if not mine:
            continue
        found = calibrate(*_asked(mine))
        facts[kind] = {"commands": int(found.counts.sum()), "expected calibration error": round(found.error, 4)}
        rows += [
            (kind, f"{c:.4f}", f"{a:.4f}", n)
            for c, a, n in zip(found.confidence, found.accuracy, found.counts, strict=True)
        ]
    with whole_files(out) as folder:
        write_csv(folder / "calibration.csv", ("people", "confidence", "accuracy", "commands"), rows)
        _write_facts(folder / "calibration.json", facts)
        draw_calibration(calibrate(*_asked(records))).savefig(folder / "calibration.png", dpi=90)
    print(json.dumps(facts, indent=1))


def _asked(records: list[Record]) -> tuple[list[float], list[int]]:
    asked = [tuple(command) for r in records for command in r["commands"]]
    return [sure for sure, _ in asked], [right for _, right in asked]


def scaling(counts: tuple[int, ...], out: Path) -> None:
    """Measure how time and memory grow with the number of demonstrations."""
    found = []
    for measurement in measure_growth(counts, LONGEST):
        print(
            "{:5d} demonstrations, {:24s}{:8s}{:9.3f} s, {:9.3f} s of processors, {:8.1f} MB".format(*measurement),
            flush=True,
        )
        found.append(measurement)
    with whole_files(out) as folder:
        write_csv(folder / "scaling.csv", Measurement._fields, found)
        _write_facts(folder / "scaling.json", {"processors": os.cpu_count(), "load": os.getloadavg()[0]})
        draw_growth(found).savefig(folder / "scaling.png", dpi=90)


def _write_facts(path: Path, facts: dict[str, Any]) -> None:
    """Write how a table was made beside it."""
    made = {
        "command": shlex.join(["python", *sys.argv]),
        "versions": {
            "signimit": signimit.__version__, "python": platform.python_version(), "numpy": np.__version__,
            "scipy": scipy.__version__, "scikit-learn": version("scikit-learn"),
        },
    }  # fmt: skip
    path.write_text(json.dumps(facts | made, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    run_program(main)
