"""Sessions of real people: everybody whose strokes are given signs and moves, and two methods learn from them.

The sessions are composed, and the hands' paths judged, as those of the benchmark are; only the people differ.
"""

from __future__ import annotations

import hashlib
import math
import os
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from signimit.benchmark.entries import ENTRANTS
from signimit.benchmark.running import code_hash, make_entry, obey
from signimit.benchmark.scoring import judge_inference, score_path
from signimit.benchmark.statistics import estimate_share, share_text
from signimit.benchmark.studies.conditions import Recordings
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError
from signimit.io.formats import read_strokes
from signimit.io.safe_files import Record
from signimit.strokes import StrokeLibrary
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.people.choosing import People
from signimit.teaching.people.relabelling import with_both_triangles
from signimit.teaching.sessions import Condition, compose_session

METHODS = ("joint", "paper")  # entries of the benchmark: our defaults, and the paper with its own policy
LEAST_SIGNS = 6  # samples of a sign that a signer needs: it is shown up to four times, and asked for three times
LEAST_MOVEMENTS = 4  # samples of a movement that a mover needs: a demonstration draws it several times


def read_people(paths: Sequence[str | os.PathLike[str]]) -> StrokeLibrary:
    """Read files or folders of strokes as `signimit.io.formats.read_strokes` does; each path is of other people.

    A writer whose name an earlier path has already is called by the name and the path's.
    """
    library: StrokeLibrary | None = None
    for path in paths:
        new = read_strokes([path])
        if library is not None:
            taken = set(library.writers)
            writers = tuple(f"{w} of {Path(path).name}" if w in taken else w for w in new.writers)
            new = library + StrokeLibrary(new.strokes, new.labels, writers, new.source)
        library = new
    if library is None:
        raise InvalidInputError("real people", "at least one file of strokes", "none")
    return library


def people_who_drew(library: StrokeLibrary, labels: Iterable[str], least: int) -> list[str]:
    """Return the writers with at least so many strokes of every label, in order of their numbers or names."""
    drawn = Counter(zip(library.writers, library.labels, strict=True))
    able = [w for w in set(library.writers) if all(drawn[w, label] >= least for label in labels)]
    return sorted(able, key=lambda writer: (len(writer), writer))  # "2" before "13"


def real_conditions(recordings: Recordings, sessions: int = 0, language: Language = PAPER_LANGUAGE) -> list[Condition]:
    """Return a condition for each session: signers and movers in turn, who meet others in every round.

    Args:
        recordings: Strokes of all.
        sessions: How many; 0 for as many as it takes until everybody had a turn.
        language: What they speak.

    Raises:
        InvalidInputError: If nobody drew all that the language needs.
    """
    movements = with_both_triangles(recordings.movements)
    signers = people_who_drew(recordings.signs, language.signs, LEAST_SIGNS)
    movers = people_who_drew(movements, language.movements, LEAST_MOVEMENTS)
    for who, able, labels, least in (
        ("signers", signers, language.signs, LEAST_SIGNS), ("movers", movers, language.movements, LEAST_MOVEMENTS),
    ):  # fmt: skip
        if not able:
            raise InvalidInputError(f"real people: {who}", f"{least} strokes each of {', '.join(labels)}", "nobody's")
    conditions = []
    for number in range(sessions or max(len(signers), len(movers))):
        signer = signers[number % len(signers)]
        shift = number // math.lcm(len(signers), len(movers))  # or the same two would meet again
        mover = movers[(number + shift) % len(movers)]
        strokes = recordings.signs.select(writer=signer), movements.select(writer=mover)
        # Records of other code, or of other people of these names, are another session's.
        identity = hashlib.sha256(code_hash().encode())
        for stroke in (*strokes[0], *strokes[1]):
            identity.update(stroke.points.tobytes())
        name = f"{number} {identity.hexdigest()[:8]} signer {signer} mover {mover}"
        pair = partial(_these_two, *strokes)
        conditions.append(Condition(name=name, change="real people", language=language, choose_people=pair))
    return conditions


def _these_two(
    signs: StrokeLibrary,
    movements: StrokeLibrary,
    language: Language,
    samples: int,
    who: np.random.Generator,
    how: np.random.Generator,
) -> People[StrokeLibrary]:
    return People(language, signs, movements, names=(signs.writers[0], movements.writers[0]))


def run_real_session(condition: Condition, seed: int) -> Record:
    """Let two people demonstrate and ask for all nine pairs, and score what each method understands and does.

    Returns:
        A record with the people, and for each method its three verdicts (groups, foci, word order), whether each
        command was obeyed, and the misfits in half sizes.
    """
    number, _, *pair = condition.name.split()
    rng = np.random.default_rng([seed, int(number)])
    people = condition.choose_people(condition.language, 0, rng, rng)
    # An entry's random numbers depend on the condition's name, and must not on the identity of the code in it.
    session = compose_session(replace(condition, name=" ".join([number, *pair])), seed, people, rng)
    found = {}
    for method in METHODS:
        entry: Any = make_entry(ENTRANTS[method], session)
        entry.observe(session.demonstrations)
        verdict = judge_inference(entry.understanding, session.truth)
        scores = [score_path(obey(entry, command), command, session.truth.templates) for command in session.commands]
        found[method] = {
            "verdicts": [int(verdict.grouping), int(verdict.focus), int(verdict.word_order)],
            "obeyed": [int(score.obeyed) for score in scores],
            "misfit": [round(score.misfit, 4) for score in scores],
        }
    signer, mover = people.names
    return {"cell": condition.name, "seed": seed, "signer": signer, "mover": mover, "methods": found}


class RealRow(NamedTuple):
    """Scores of one method in the sessions of all, or of one person; commands with their clustered 95 % interval."""

    who: str
    method: str
    sessions: int
    inferred: int
    commands: int
    obeyed: int
    low: float
    high: float


def tabulate_people(records: Sequence[Record]) -> list[RealRow]:
    """Count for everybody together, then for each signer and each mover, by method."""
    groups: dict[str, list[Record]] = {"all": list(records)}
    for role in ("signer", "mover"):
        for person in sorted({r[role] for r in records}, key=lambda name: (len(name), name)):
            groups[f"{role} {person}"] = [r for r in records if r[role] == person]
    rows = []
    for who, mine in groups.items():
        for method in METHODS:
            scores = [r["methods"][method] for r in mine]
            found = estimate_share([sum(s["obeyed"]) for s in scores], [len(s["obeyed"]) for s in scores])
            inferred = sum(all(s["verdicts"]) for s in scores)
            interval = round(found.low, 4), round(found.high, 4)
            rows.append(RealRow(who, method, len(mine), inferred, found.count, round(found.total), *interval))
    return rows


def people_table(rows: Sequence[RealRow]) -> str:
    """Return the rows as Markdown, a line for each method, or for each person with the methods side by side."""
    lines = []
    for row in rows:
        low, high = 100 * row.low, 100 * row.high
        obeyed = f"{row.obeyed} of {row.commands}: {100 * row.obeyed / row.commands:.1f} % [{low:.1f}, {high:.1f}]"
        lines.append((row.who, f"`{row.method}`", row.sessions, share_text(row.inferred, row.sessions), obeyed))
    return markdown_table(("who", "method", "sessions", "every inference right [95 %]", "obeyed [95 %]"), lines)
