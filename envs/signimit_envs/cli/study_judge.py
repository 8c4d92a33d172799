"""The study of the judge: what `signimit.performed` accepts, on people who were left out."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
from tqdm import tqdm

from signimit.benchmark.results import installed_versions
from signimit.benchmark.studies.judge import (
    STRANGERS,
    Trial,
    acceptance_table,
    built_in_people,
    choose_thresholds,
    count_accepted,
    leave_groups_out,
    people_of,
    run_judge,
    tabulate_acceptance,
)
from signimit.evaluation import COVERED, SIZES, TOLERANCE
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.strokes import StrokeLibrary
from signimit.teaching.people import MOVEMENT_LABELS
from signimit_envs.cli.command_line import check_output_folder, command_text

MOVEMENTS = (*MOVEMENT_LABELS, "triangle", "rectangle", "octagon", "boomerang", "peanut")


def study_judge(
    libraries: tuple[Path, ...] = (),
    /,
    *,
    movements: tuple[str, ...] = MOVEMENTS,
    built_in: int = 20,
    sessions: int = 10,
    seed: int = 0,
    out: Path = Path("out/judge"),
) -> None:
    """Measure what the judge accepts, with its thresholds and with such as were chosen without the person.

    Args:
        libraries: Stroke libraries of people who draw movements; where nobody drew one often, they are strangers, and
            a redrawing is a drawing that was shown.
        movements: Labels that sessions are made of, where a library has them; its other labels are other shapes.
        built_in: How many synthetic people draw besides.
        sessions: How many sessions of each person, of three movements.
        seed: Of everything drawn at random.
        out: Folder for acceptance.md, acceptance.csv and judge.json.
    """
    if sessions < 1 or built_in < 0:
        raise InvalidInputError("judge", "at least 1 session and no fewer than 0 people", f"{sessions}, {built_in}")
    check_output_folder(out)
    people = [("built-in", f"built-in {n}", one) for n, one in enumerate(built_in_people(built_in, seed), 1)]
    for path in libraries:
        library = StrokeLibrary.load(path)
        source = library.source or path.stem
        people += [(source, f"{source} {name}", one) for name, one in people_of(library, movements).items()]
    trials: dict[str, list[Trial]] = {}
    for number, (source, name, library) in enumerate(tqdm(people, unit="person")):
        rng, redrawn = np.random.default_rng([seed, number]), not name.endswith(STRANGERS)
        trials.setdefault(source, []).extend(run_judge(library, name, movements, sessions, rng, redrawn))
    everything = [trial for mine in trials.values() for trial in mine]
    chosen = leave_groups_out(everything)
    rows = [row for source, mine in trials.items() for row in tabulate_acceptance(source, mine, chosen)]
    with whole_files(out) as folder:
        (folder / "acceptance.md").write_text(acceptance_table(rows) + "\n", encoding="utf-8")
        with open(folder / "acceptance.csv", "w", encoding="utf-8", newline="") as file:
            table = csv.writer(file)
            table.writerow(("people", "kind", "paths", "accepted", "low", "high", "accepted_left_out"))
            for people_, kind, share, left_out in rows:
                interval = (round(bound, 4) for bound in share.interval)
                table.writerow((people_, kind, share.total, share.count, *interval, left_out.count))
        facts = {
            "command": command_text(),
            "versions": installed_versions("signimit", "numpy", "scipy"),
            "thresholds": {"tolerance": TOLERANCE, "covered": COVERED, "sizes": SIZES},
            "chosen on all": choose_thresholds([count_accepted(everything)]),
            "chosen without": chosen,
        }
        (folder / "judge.json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
    print(acceptance_table(rows))
    print(f"chosen on all people: {facts['chosen on all']}; the package has {TOLERANCE}, {COVERED}")
