"""How well demonstrations are understood: every table and figure of the studies, from seeds."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from tqdm import tqdm

from signimit.benchmark.judge import CRITERION, judge_hash
from signimit.benchmark.results import installed_versions
from signimit.benchmark.statistics import wilson_interval
from signimit.benchmark.studies.asking import asking_conditions, run_lessons
from signimit.benchmark.studies.conditions import Recordings, study_conditions
from signimit.benchmark.studies.left_out_people import FoldRow, leave_people_out
from signimit.benchmark.studies.real_people import (
    RealRow,
    people_table,
    read_people,
    real_conditions,
    run_real_session,
    tabulate_people,
)
from signimit.benchmark.studies.running import Run, run_session, run_sessions
from signimit.benchmark.studies.signs import METHODS, QUIZZES, SignRow, run_quizzes
from signimit.benchmark.studies.tables import (
    OURS,
    LessonRow,
    MethodScore,
    beaten_cells,
    calibrate,
    demonstrations_needed,
    shares_table,
    tabulate,
    tabulate_lessons,
    write_csv,
)
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import Record, read_records, whole_files
from signimit.strokes import StrokeLibrary
from signimit.teaching.sessions import Condition
from signimit_envs.cli.command_line import check_output_folder, command_text
from signimit_envs.cli.options import ALL_CELLS, CellOptions
from signimit_envs.cli.study_assumptions import study_assumptions
from signimit_envs.cli.study_clumsiness import study_clumsiness
from signimit_envs.cli.study_drawing_weights import compare_libraries, study_drawing_weights
from signimit_envs.cli.study_judge import study_judge
from signimit_envs.cli.study_paper import compare_conditions
from signimit_envs.cli.study_policies import compare_on_lasa, compare_policies

OUT = Path("out/study")
UNDERSTOOD = 0.95  # share of commands that a lesson shall come to


def cells(plan: CellOptions = ALL_CELLS) -> None:
    """Compare the default learner with all baselines, cell by cell. Goes on where a killed run stopped.

    Args:
        plan: Which cells, how often, and where.
    """
    from signimit.plots.benchmark import draw_cells

    recordings = load_recordings(plan.signs, plan.movements)
    chosen = plan.choose(study_conditions(recordings))
    seeds = plan.seeds
    rows = tabulate(run_missing(run_session, chosen, seeds, plan.workers, plan.out / "sessions.jsonl"))
    with whole_files(plan.out) as folder:
        write_csv(folder / "cells.csv", MethodScore._fields, rows)
        (folder / "cells.md").write_text(shares_table(rows) + "\n", encoding="utf-8")
        sources = [recordings.signs.source, recordings.movements.source] if recordings else ["synthetic"]
        facts = {"seeds": [seeds[0], seeds[-1]], "people": sources, "beaten": beaten_cells(rows)}
        write_facts(folder / "cells.json", facts)
        draw_cells(rows).savefig(folder / "cells.png", dpi=90)
    print(shares_table(rows))
    for cell, method, theirs, ours in beaten_cells(rows):
        print(f"{cell}: {method} was right in {theirs} sessions, {OURS} in {ours}")


def asking(plan: CellOptions = ALL_CELLS) -> None:
    """Measure how much sooner a learner understands that asks. Goes on where a killed run stopped.

    Args:
        plan: Which cells, how often, and where.
    """
    from signimit.plots.benchmark import draw_lessons

    recordings = load_recordings(plan.signs, plan.movements)
    chosen = plan.choose(asking_conditions(recordings))
    seeds = plan.seeds
    rows = tabulate_lessons(run_missing(run_lessons, chosen, seeds, plan.workers, plan.out / "lessons.jsonl"))
    needed = demonstrations_needed(rows, UNDERSTOOD)
    with whole_files(plan.out) as folder:
        write_csv(folder / "asking.csv", LessonRow._fields, rows)
        facts = {"seeds": [seeds[0], seeds[-1]], f"demonstrations until {UNDERSTOOD:.0%} are understood": needed}
        write_facts(folder / "asking.json", facts)
        draw_lessons(rows).savefig(folder / "asking.png", dpi=90)
    for cell, strategy, count in needed:
        print(f"{cell}, asking {strategy}: {UNDERSTOOD:.0%} understood from {count or 'more'} demonstrations on")


def load_recordings(signs: Path | None, movements: Path | None) -> Recordings | None:
    """Load real people's strokes, if both kinds are given."""
    if signs is None or movements is None:
        return None
    return Recordings(StrokeLibrary.load(signs), StrokeLibrary.load(movements))


def run_missing(run: Run, chosen: list[Condition], seeds: range, workers: int, file: Path) -> list[Record]:
    """Run the sessions that are not in a file of records yet, and return those of all, by cell and seed."""
    if workers < 0:
        raise InvalidInputError("workers", "1 or more, or 0 for all processors but one", f"{workers}")
    if not seeds or not chosen:
        raise InvalidInputError("cells", "at least 1 session of 1 cell", f"{len(seeds)} of {len(chosen)}")
    workers = workers or max(1, (os.cpu_count() or 2) - 1)
    for _ in tqdm(run_sessions(run, chosen, seeds, file, workers), unit="session"):
        pass
    order = {condition.name: number for number, condition in enumerate(chosen)}
    found = [r for r in read_records(file) if r["cell"] in order and r["seed"] in seeds]
    return sorted(found, key=lambda r: (order[r["cell"]], r["seed"]))


def calibration(*, out: Path = OUT) -> None:
    """Say how well confidences fit, over all commands of the sessions that ``study cells`` ran.

    Args:
        out: Folder of these sessions, and for what is written.
    """
    from signimit.plots.benchmark import draw_calibration

    records = read_records(out / "sessions.jsonl")
    if not records:
        raise InvalidInputError(str(out / "sessions.jsonl"), "sessions; run `study cells` first", "none")
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
        write_facts(folder / "calibration.json", facts)
        draw_calibration(calibrate(*_asked(records))).savefig(folder / "calibration.png", dpi=90)
    print(json.dumps(facts, indent=1))


def _asked(records: list[Record]) -> tuple[list[float], list[int]]:
    asked = [tuple(command) for r in records for command in r["commands"]]
    return [sure for sure, _ in asked], [right for _, right in asked]


def left_out_people(
    *,
    signs: Path,
    movements: Path,
    strangers: tuple[Path, ...] = (),
    without: tuple[str, ...] = (),
    sessions: int = 20,
    out: Path = OUT,
) -> None:
    """Cross-validate the constants of the evidence: learn from people who were left out when they were measured.

    Args:
        signs: Stroke library of real people who make signs.
        movements: Stroke library of real people who draw movements.
        strangers: Libraries of further people, who are never left out; weights of drawings are fitted to them too.
        without: Labels that are left out of these, if everybody drew one thing.
        sessions: How many of each cell.
        out: Folder for what is written.
    """
    if sessions < 1:
        raise InvalidInputError("people", "at least 1 session", str(sessions))
    check_output_folder(out)
    recordings, rows = Recordings(StrokeLibrary.load(signs), StrokeLibrary.load(movements)), []
    for row in leave_people_out(recordings, sessions, compare_libraries(strangers, without)):
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
        sources = [recordings.signs.source, recordings.movements.source]
        write_facts(folder / "people.json", {"people": sources, "right, of, 95 %": shares})


def reading_signs(*, signs: Path | None = None, sessions: int = 20, out: Path = OUT) -> None:
    """Compare how signs are read, on their own.

    Args:
        signs: Stroke library of real people who make signs; left out, synthetic people.
        sessions: How many quizzes of each kind.
        out: Folder for what is written.
    """
    if sessions < 1:
        raise InvalidInputError("signs", "at least 1 session", str(sessions))
    check_output_folder(out)
    library, rows = None if signs is None else StrokeLibrary.load(signs), []
    for row in tqdm(run_quizzes(library, sessions), total=len(QUIZZES) * len(METHODS), unit="row"):
        tqdm.write(f"{row.signs}, {row.shown} shown, signers {row.signers}, {row.method}: {row.right} of {row.asked}")
        rows.append(row)
    with whole_files(out) as folder:
        write_csv(folder / "signs.csv", SignRow._fields, rows)
        write_facts(folder / "signs.json", {"people": library.source if library else "synthetic"})


def real_people(
    *,
    signs: tuple[Path, ...],
    movements: tuple[Path, ...],
    sessions: int = 0,
    seed: int = 0,
    workers: int = 0,
    out: Path = Path("out/real-people"),
) -> None:
    """Let real people demonstrate and ask, everybody in turn, and compare our defaults with the paper's method.

    Goes on where a killed run stopped.

    Args:
        signs: Files of digits: pendigits-orig.tra and .tes as UCI distributes them, or libraries made of them.
        movements: The $1 recogniser's folder xml_logs, or a library made of it.
        sessions: How many, nine commands each; 0 for one turn of everybody.
        seed: Of everything drawn at random.
        workers: Processes; left out, one less than there are processors.
        out: Folder for the records, one a session, and the table.
    """
    recordings = Recordings(read_people(signs), read_people(movements))
    conditions = real_conditions(recordings, sessions)
    records = run_missing(run_real_session, conditions, range(seed, seed + 1), workers, out / "sessions.jsonl")
    rows = tabulate_people(records)
    with whole_files(out) as folder:
        write_csv(folder / "people.csv", RealRow._fields, rows)
        (folder / "people.md").write_text(f"{CRITERION}\n\n{people_table(rows)}\n", encoding="utf-8")
        sources = [recordings.signs.source, recordings.movements.source]
        turns = {role: {record[role] for record in records} for role in ("signer", "mover")}
        given = {"signer": recordings.signs.writers, "mover": recordings.movements.writers}
        idle = [f"{role} {who}" for role, all_of_them in given.items() for who in sorted({*all_of_them} - turns[role])]
        people = {role: len(who) for role, who in turns.items()}
        facts = {"people": sources, **people, "without a turn": idle, "seed": seed, "judge": judge_hash()}
        write_facts(folder / "people.json", facts)
    print(f"{CRITERION}\n\n{people_table(rows)}")
    if idle:
        print(f"Without a turn, or with too few strokes: {', '.join(idle)}.")
    print(f"Written to {out}.")


def write_facts(path: Path, facts: dict[str, Any]) -> None:
    """Write how a table was made beside it."""
    made = {
        "command": command_text(),
        "versions": installed_versions("signimit", "numpy", "scipy", "scikit-learn"),
    }
    path.write_text(json.dumps(facts | made, indent=1) + "\n", encoding="utf-8")


SUBCOMMANDS = {
    "cells": cells, "calibration": calibration, "asking": asking, "people": left_out_people, "signs": reading_signs,
    "real-people": real_people, "judge": study_judge, "paper": compare_conditions,
    "policies": compare_policies, "lasa": compare_on_lasa, "drawing-weights": study_drawing_weights,
    "assumptions": study_assumptions, "clumsiness": study_clumsiness,
}  # fmt: skip
