"""What the joint learner's assumptions are worth: each halved and doubled, and parts of the objective left out.

Sessions are composed in which people keep to the rules, and others in which they break one. Each is measured once and
then explained under every setting. Only demonstrations that do what they ask for count as understood or not.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from signimit.benchmark.scoring import count_signs_read, judge_inference
from signimit.benchmark.statistics import Share, estimate_share
from signimit.benchmark.studies.conditions import (
    AS_WITH_A_MOUSE,
    BESIDE,
    Recordings,
    compose_study_session,
    study_condition,
)
from signimit.benchmark.tables import markdown_table
from signimit.io.safe_files import Record
from signimit.learners import get_learner
from signimit.learners.base import Learner, Understanding
from signimit.learners.joint.learner import JointLearner
from signimit.learners.joint.measurements import measure
from signimit.learners.joint.objective import PEOPLE, Assumptions
from signimit.signs import prototype_points
from signimit.teaching.sessions import Condition, Session

KINDS = (
    ((3, 3, 2), "plain"), ((3, 3, 1), "plain"), ((5, 4, 1), "plain"), ((5, 4, 1), "mixed"), ((3, 3, 2), "unbalanced"),
    ((3, 3, 2), "filler"), ((3, 3, 1), "once"), ((3, 3, 1), "goes home"), ((3, 3, 1), "1 wrong"),
    ((3, 3, 1), "2 wrong"), ((3, 3, 1), BESIDE), ((3, 3, 1), "synonyms"), ((3, 3, 1), AS_WITH_A_MOUSE),
)  # fmt: skip
"""Kinds of sessions: movements, objects, demonstrations of each pair; and the variant.

Whoever errs shows each pair once, so that nothing else tells what was meant.
"""
FULL, PAPER = "full model", "the paper"
NEVER = 1e6  # nats, a price that nothing is worth
ABLATIONS = {
    FULL: PEOPLE,
    "without mistakes": PEOPLE._replace(mistake_price=NEVER, irrelevance_price=NEVER),
    "without words": PEOPLE._replace(word_weight=0.0),
    "without imbalance price": PEOPLE._replace(imbalance_price=0.0),
}
FACTORS = (0.5, 2.0)


def scaled(name: str, factor: float) -> str:
    """Return the name of the setting with one assumption scaled."""
    return f"{name} x {factor:g}"


def assumption_settings() -> dict[str, Assumptions]:
    """Return all settings of the assumptions by name: ablations, and each assumption scaled by each of `FACTORS`."""
    return ABLATIONS | {
        scaled(name, factor): PEOPLE._replace(**{name: factor * value})
        for name, value in PEOPLE._asdict().items()
        for factor in FACTORS
    }


def describe_assumptions() -> dict[str, str]:
    """Return what each assumption is, with its unit, from their documentation."""
    text = re.sub(r"\n +(?= {8})", "", inspect.getdoc(Assumptions) or "")
    entries = re.findall(r"^    (\w+): (.*(?:\n {8}.*)*)", text, re.MULTILINE)
    return {name: " ".join(said.split()).rstrip(".") for name, said in entries}


def assumption_conditions(recordings: Recordings | None = None) -> list[Condition]:
    """Return all kinds of sessions, of synthetic people and, where there are any, of real ones."""
    return [
        study_condition(*size, variant, whose)
        for whose in ([None] if recordings is None else [None, recordings])
        for size, variant in KINDS
    ]


def run_settings(condition: Condition, seed: int) -> Record:
    """Explain one session under every setting, and by the paper's method.

    Returns:
        A record with the words that are asked, and for each setting whether the sound demonstrations are all grouped
        and placed right, and how many words are read right.
    """
    session = compose_study_session(condition, seed)
    seen, known, scores = measure(session.demonstrations), dict[bytes, tuple[int, int]](), {}
    for name, assumed in assumption_settings().items():
        learner = JointLearner(assumed)
        found = learner.explain_measurements(seen)
        same = b"".join(np.asarray(part).tobytes() for part in (found.labels, found.focus, *found.requests))
        same += bytes(found.word_order)
        if same not in known:  # most settings come to one conclusion, and reading takes as long as concluding
            known[same] = _score(session, learner, found)
        scores[name] = known[same]
    paper = get_learner(PAPER.split()[-1])
    strokes = prototype_points(session.prototypes)
    scores[PAPER] = _score(session, paper, paper.infer(session.demonstrations, strokes, np.random.default_rng(seed)))
    return {"cell": condition.name, "seed": seed, "asked": 2 * len(session.commands), "scores": scores}


def _score(session: Session, learner: Learner, found: Understanding) -> tuple[int, int]:
    """Return whether all sound demonstrations are understood, and the number of words read right."""
    sound = np.flatnonzero(session.truth.sound)
    truth, part = session.truth.select(sound), found._replace(labels=found.labels[sound], focus=found.focus[sound])
    verdict = judge_inference(part, truth)
    reader = learner.reader(session.demonstrations, prototype_points(session.prototypes), found)
    read = sum(count_signs_read(reader.read(c.signs), part, truth, c.request) for c in session.commands)
    return int(verdict.grouping and verdict.focus), read


class SettingRow(NamedTuple):
    """Scores of one setting in the sessions of one kind, or of all; shares with 95 % intervals.

    Attributes:
        cell: Kind of sessions, `ALL` for all.
        setting: Name.
        sessions: How many.
        right: Of them with all sound demonstrations grouped and placed right; Wilson's interval.
        low: Its lower end.
        high: Its upper end.
        words: That are asked.
        read: Of them read right; the interval allows for words of one session being dependent.
        read_low: Its lower end.
        read_high: Its upper end.
    """

    cell: str
    setting: str
    sessions: int
    right: int
    low: float
    high: float
    words: int
    read: int
    read_low: float
    read_high: float


ALL = "all"


def tabulate_settings(records: Sequence[Record]) -> list[SettingRow]:
    """Count for each kind of sessions, and last for all, by setting."""
    rows = []
    for cell in (*dict.fromkeys(r["cell"] for r in records), ALL):
        mine = [r for r in records if cell in (r["cell"], ALL)]
        for setting in mine[0]["scores"]:
            right, read = zip(*(r["scores"][setting] for r in mine), strict=True)
            share, words = Share.of(right), estimate_share(read, [r["asked"] for r in mine])
            low, high, read_low, read_high = (round(b, 4) for b in (*share.interval, words.low, words.high))
            counts = share.total, share.count, low, high, words.count, round(words.total), read_low, read_high
            rows.append(SettingRow(cell, setting, *counts))
    return rows


def ablation_table(rows: Sequence[SettingRow]) -> str:
    """Return what is right without each part, as Markdown: a line for each kind, and the last for all.

    A cell is the share of sessions right, and that of words read right, in per cent with 95 % intervals.
    """
    settings = (*ABLATIONS, PAPER)
    found = {(row.cell, row.setting): row for row in rows}
    lines = []
    for cell in dict.fromkeys(row.cell for row in rows):
        lines.append((cell, found[cell, FULL].sessions, *(_cell(found[cell, setting]) for setting in settings)))
    return markdown_table(("sessions", "n", *settings), lines)


def assumptions_table(rows: Sequence[SettingRow]) -> str:
    """Return all assumptions as Markdown: value, meaning, and what is right of all sessions if it is scaled."""
    found = {row.setting: row for row in rows if row.cell == ALL}
    meaning = describe_assumptions()
    lines: list[tuple[object, ...]] = [
        ("*as they are*", "", "", _cell(found[FULL]), ""),
        *(
            (f"`{name}`", value, meaning[name], *(_cell(found[scaled(name, factor)]) for factor in FACTORS))
            for name, value in PEOPLE._asdict().items()
        ),
    ]
    title = f"n = {found[FULL].sessions} sessions, {found[FULL].words} words"
    head = ("assumption", "value", "what it is", *(f"x {factor:g}" for factor in FACTORS))
    return f"{title}\n\n{markdown_table(head, lines)}"


def _cell(row: SettingRow) -> str:
    right = _per_cent(row.right / row.sessions, row.low, row.high)
    return f"{right}; {_per_cent(row.read / row.words, row.read_low, row.read_high)}"


def _per_cent(share: float, low: float, high: float) -> str:
    return f"{100 * share:.1f} [{100 * low:.0f}, {100 * high:.0f}]"
