"""The study of the joint learner's assumptions."""

from __future__ import annotations

import json
import os
from pathlib import Path

from tqdm import tqdm

from signimit.benchmark.results import installed_versions
from signimit.benchmark.studies.assumptions import (
    SettingRow,
    ablation_table,
    assumption_conditions,
    assumptions_table,
    run_settings,
    tabulate_settings,
)
from signimit.benchmark.studies.conditions import Recordings
from signimit.benchmark.studies.running import run_sessions
from signimit.benchmark.studies.tables import write_csv
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.learners.joint.objective import PEOPLE
from signimit.strokes import StrokeLibrary
from signimit_envs.cli.command_line import check_output_folder, command_text
from signimit_envs.cli.options import CellOptions

PLAN = CellOptions(out=Path("out/assumptions"))


def study_assumptions(plan: CellOptions = PLAN) -> None:
    """Halve and double each assumption of the default learner, and leave parts of its objective out.

    Args:
        plan: Which kinds of sessions, how often, and where.
    """
    if plan.sessions < 1 or plan.workers < 0:
        found = f"{plan.sessions} sessions, {plan.workers} workers"
        raise InvalidInputError("assumptions", "at least 1 session and no fewer than 0 workers", found)
    if (plan.signs is None) != (plan.movements is None):
        raise InvalidInputError("assumptions", "libraries of signs and of movements, or neither", "one of them")
    check_output_folder(plan.out)
    recordings = None
    if plan.signs is not None and plan.movements is not None:
        recordings = Recordings(StrokeLibrary.load(plan.signs), StrokeLibrary.load(plan.movements))
    people = [recordings.signs.source, recordings.movements.source] if recordings else []
    conditions = plan.choose(assumption_conditions(recordings))
    workers = plan.workers or max(1, (os.cpu_count() or 2) - 1)
    with whole_files(plan.out) as folder:
        running = run_sessions(run_settings, conditions, plan.seeds, folder / "sessions.jsonl", workers)
        records = list(tqdm(running, total=len(conditions) * plan.sessions, unit="session"))
        order = [condition.name for condition in conditions]
        rows = tabulate_settings(sorted(records, key=lambda r: (order.index(r["cell"]), r["seed"])))
        ablations, assumptions = ablation_table(rows), assumptions_table(rows)
        write_csv(folder / "settings.csv", SettingRow._fields, rows)
        (folder / "ablations.md").write_text(f"{ablations}\n", encoding="utf-8")
        (folder / "assumptions.md").write_text(f"{assumptions}\n", encoding="utf-8")
        facts = {
            "command": command_text(),
            "versions": installed_versions("signimit", "numpy", "scipy"),
            "people": ["synthetic", *people],
            "seeds": [plan.seeds[0], plan.seeds[-1]],
            "assumptions": PEOPLE._asdict(),
            "shares": "sessions with sound demonstrations grouped and placed right; words read right; 95 % intervals",
        }
        (folder / "assumptions.json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
    print(assumptions, ablations, f"Written to {plan.out}.", sep="\n\n")
