"""The study of what the paper's own method needs of its demonstrations."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Sequence
from pathlib import Path

from tqdm import tqdm

from signimit.benchmark.results import installed_versions
from signimit.benchmark.studies.paper_conditions import (
    RUNS,
    IdealGamma,
    LevelScore,
    Result,
    run_ideal_gamma,
    run_levels,
    score_levels,
)
from signimit.benchmark.studies.paper_levels import LADDERS, study_levels
from signimit.benchmark.studies.tables import write_csv
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.strokes import StrokeLibrary
from signimit_envs.cli.command_line import check_output_folder, command_text

CONTRASTS = (1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0)  # of made-up γ
SPREADS = (0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.05, 1.2)
PEOPLE = ("built-in", "real")


def compare_conditions(
    *,
    movers: Path | None = None,
    sessions: int = 24,
    first_seed: int = 0,
    only: str = "",
    workers: int = 0,
    out: Path = Path("out/paper_conditions"),
) -> None:
    """Vary demonstrations one thing at a time, and measure Algorithm 1 and the 50 nearest points alone.

    Args:
        movers: Stroke library of real people who draw "circle" and "triangle", apex up; left out, built-in people only.
        sessions: How many sessions at each level, of each kind of people.
        first_seed: Seed of the first session; the others follow.
        only: Vary only factors whose names contain this; then no figures are drawn.
        workers: Processes; left out, as many as there are processors.
        out: Folder for results.csv, levels.csv, gamma.csv, study.json, two tables and two figures.
    """
    levels = [level for level in study_levels() if only in level.factor]
    if not levels:
        factors = dict.fromkeys(level.factor for level in study_levels())
        raise InvalidInputError("only", f"part of the name of a factor ({'; '.join(factors)})", f"{only!r}")
    if workers < 0:
        raise InvalidInputError("workers", "1 or more, or 0 for all processors", f"{workers}")
    check_output_folder(out)
    libraries = [None] if movers is None else [None, StrokeLibrary.load(movers)]
    results: list[Result] = []
    for library in libraries:
        found = run_levels(levels, sessions, library, first_seed, workers or os.cpu_count() or 1)
        for rows in tqdm(found, total=sessions, unit="session"):
            results += rows
    scores, map_ = score_levels(results), list(run_ideal_gamma(CONTRASTS, SPREADS))
    facts = {
        "command": command_text(),
        "versions": installed_versions("signimit", "numpy", "scipy"),
        "people": ["built-in", *(library.source for library in libraries if library)],
        "seeds": [first_seed, first_seed + sessions - 1],
        "sessions at each level": sessions,
        "runs of Algorithm 1 on each session": RUNS,
        "intervals": "Wilson, 95 %, with the spread between sessions allowed for",
        "levels": [score._asdict() for score in scores],
    }
    out.mkdir(parents=True, exist_ok=True)
    with whole_files(out) as folder:
        write_csv(folder / "results.csv", Result._fields, results)
        write_csv(folder / "levels.csv", LevelScore._fields, scores)
        write_csv(folder / "gamma.csv", IdealGamma._fields, map_)
        text = json.dumps(facts, indent=1).replace("NaN", "null")
        (folder / "study.json").write_text(text + "\n", encoding="utf-8")
        (folder / "factors.md").write_text(conditions_table(scores) + "\n", encoding="utf-8")
        (folder / "ladder.md").write_text(ladder_table(scores) + "\n", encoding="utf-8")
        if not only:
            from signimit.plots.paper_conditions import draw_groups, draw_policy

            draw_groups(scores, results, map_).savefig(folder / "groups.png", dpi=90)
            draw_policy(scores).savefig(folder / "policy.png", dpi=90)
    print(conditions_table(scores), ladder_table(scores), sep="\n\n")
    print(f"Written to {out}.")


def conditions_table(scores: Sequence[LevelScore]) -> str:
    """Return the scores of all factors as a Markdown table, a row for each value, in per cent with 95 % intervals."""
    one_sense = {(s.people, s.factor, s.value): s for s in scores if s.senses == "+++"}
    against = {(s.people, s.factor, s.value): s for s in scores if s.senses != "+++"}
    rows = []
    for factor, value in dict.fromkeys((s.factor, s.value) for s in scores if s.factor not in LADDERS):
        first, second = ([found.get((people, factor, value)) for people in PEOPLE] for found in (against, one_sense))
        rows.append((factor, value, *map(_right, first), *map(_right, second), *map(_obeyed, first)))
    senses = [f"{people}, {senses}" for senses in ("circle against", "one sense") for people in PEOPLE]
    head = ("factor", "value", *(f"runs right: {name}" for name in senses), *(f"obeyed: {name}" for name in PEOPLE))
    return markdown_table(head, rows)


def ladder_table(scores: Sequence[LevelScore]) -> str:
    """Return the scores of conditions added one by one as a Markdown table, in per cent with 95 % intervals."""
    found = {(s.people, s.factor, s.value): s for s in scores if s.factor in LADDERS}
    rows = []
    for factor, value in dict.fromkeys(key[1:] for key in found):
        both = [found.get((people, factor, value)) for people in PEOPLE]
        rows.append((value, *map(_right, both), *map(_obeyed, both)))
    measures = [f"{measure}: {people}" for measure in ("runs right", "obeyed") for people in PEOPLE]
    return markdown_table(("conditions", *measures), rows)


def _right(score: LevelScore | None) -> str:
    return "" if score is None else _per_cent(score.right, score.right_low, score.right_high)


def _obeyed(score: LevelScore | None) -> str:
    known = score is not None and math.isfinite(score.obeyed)
    return _per_cent(score.obeyed, score.obeyed_low, score.obeyed_high) if score is not None and known else ""


def _per_cent(share: float, low: float, high: float) -> str:
    return f"{100 * share:.0f} [{100 * low:.0f}, {100 * high:.0f}]"
