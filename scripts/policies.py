#!/usr/bin/env python3
"""Compare all kinds of policies on the same people, and draw what each does."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path

import numpy as np
from tqdm import tqdm

import signimit
from signimit.benchmark.studies.policies import StudyPlan, Trial, compose_lessons, run_study, study_table, summarise
from signimit.io.safe_files import whole_files
from signimit.plots.policy_field import draw_portraits
from signimit.policies import POLICY_KINDS, make_policy
from signimit.strokes import StrokeLibrary
from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS, synthetic_library
from signimit_envs.cli.command_line import run_program

PEOPLE = 10  # synthetic, unless a library is given
PORTRAYED = 8  # movements in a picture
DOTS_PER_INCH = 50  # a picture of all is below 150 KB


def main(
    *,
    movers: Path | None = None,
    labels: tuple[str, ...] = (),
    kinds: tuple[str, ...] = POLICY_KINDS,
    sessions: int = 10,
    starts: int = 12,
    seed: int = 0,
    out: Path = Path("results/policies"),
) -> None:
    """Compare all kinds of policies on the same people, and draw what each does.

    Args:
        movers: Stroke library of people's movements; left out, synthetic people draw.
        labels: Movements to compare on; left out, all that the library has.
        kinds: Policies to compare.
        sessions: How many people demonstrate each movement.
        starts: Places on the table that each policy starts from.
        seed: Of everything drawn at random.
        out: Folder for the table, trials.csv, study.json and a picture of each kind.
    """
    library = _synthetic(seed) if movers is None else StrokeLibrary.load(movers)
    plan = StudyPlan(labels=labels or tuple(dict.fromkeys(library.labels)), sessions=sessions, starts=starts, seed=seed)
    total = len(plan.labels) * sessions * len(kinds)
    trials = list(tqdm(run_study(library, plan, kinds), total=total, unit="trial"))
    summaries = summarise(trials)
    out.mkdir(parents=True, exist_ok=True)
    with whole_files(out) as folder:
        (folder / "table.md").write_text(study_table(summaries) + "\n")
        _write_trials(folder / "trials.csv", trials)
        facts = {
            "version": signimit.__version__,
            "numpy": np.__version__,
            "people": library.source,
            "seed": seed,
        }
        facts |= {"sessions": sessions, "starts": starts, "labels": plan.labels}
        facts["kinds"] = {s.kind: s.measures for s in summaries}
        (folder / "study.json").write_text(json.dumps(facts, indent=1) + os.linesep)
        lessons = [lesson for _, lesson in compose_lessons(library, plan)][: len(plan.labels)][:PORTRAYED]
        for kind in kinds:
            policies = [make_policy(lesson.paths, lesson.times, kind) for lesson in lessons]
            draw_portraits(policies, lessons).savefig(folder / f"{kind}.png", dpi=DOTS_PER_INCH)
    print(study_table(summaries))
    print(f"Written to {out}.")


def _synthetic(seed: int) -> StrokeLibrary:
    rng = np.random.default_rng(seed)
    return synthetic_library((*MOVEMENT_LABELS, *GOAL_LABELS), writers=PEOPLE, samples=8, rng=rng)


def _write_trials(path: Path, trials: list[Trial]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Trial._fields)
        writer.writerows([[f"{v:.4g}" if isinstance(v, float) else v for v in t] for t in trials])


if __name__ == "__main__":
    run_program(main)
