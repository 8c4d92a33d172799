"""Comparison of all kinds of policies on the same demonstrations: how well each draws what was shown."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from signimit.benchmark.statistics import estimate_share
from signimit.benchmark.studies.path_quality import arrives_and_stays, back_after_shove, judge_path, shove_half_way
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError
from signimit.policies import POLICY_KINDS, make_policy, run_policy
from signimit.policies.base import Array, Policy
from signimit.strokes import StrokeLibrary
from signimit.teaching.composition import compose_loops, compose_path
from signimit.teaching.languages import Language
from signimit.teaching.people.glyphs import GOAL_LABELS
from signimit.teaching.scenes import sample_hand, sample_scene, sample_times
from signimit.teaching.stroke_sampler import StrokeSampler

TABLE = np.array([0.42, 0.38])  # m, half width and half depth of what the arm reaches
SHOVE = 0.08  # m
NOT_APPLICABLE = float("nan")
STAY = 0.02  # m from the object within which a reach has arrived


@dataclass(frozen=True, kw_only=True)
class StudyPlan:
    """Plan of the comparison.

    Attributes:
        labels: Movements to demonstrate; those of `GOAL_LABELS` end at the object.
        sessions: How many people demonstrate each movement (the library's writers, in turn).
        demonstrations: Of each movement.
        starts: Random places on the table that each policy starts from.
        seconds: How long each hand moves.
        seed: Of everything drawn at random.
    """

    labels: tuple[str, ...]
    sessions: int = 10
    demonstrations: int = 4
    starts: int = 12
    seconds: float = 12.0
    seed: int = 0

    def __post_init__(self) -> None:
        """Check that there is something to do."""
        for name in ("sessions", "demonstrations", "starts"):
            if getattr(self, name) < 1:
                raise InvalidInputError(f"study: {name}", "at least 1", f"{getattr(self, name)}")


class ShownMovement(NamedTuple):
    """Demonstrations of one movement by one person, in the object's frame.

    Attributes:
        label: The movement.
        paths: Each (T, 2), m.
        times: Each (T,), s.
        loops: What was drawn, without the reaches, each (T, 2), m.
        focus: Where the object of the trial is, m, table frame.
        hands: Where hands start in the trial, shape (B, 2), m, object's frame.
    """

    label: str
    paths: list[Array]
    times: list[Array]
    loops: list[Array]
    focus: Array
    hands: Array


class Trial(NamedTuple):
    """Measures of one kind of policy on one shown movement: shares or means over hands, NaN where they do not apply."""

    kind: str
    label: str
    session: int
    drawn: float = NOT_APPLICABLE
    misfit: float = NOT_APPLICABLE
    corner_gap: float = NOT_APPLICABLE
    detour: float = NOT_APPLICABLE
    back_after_shove: float = NOT_APPLICABLE
    speed_correlation: float = NOT_APPLICABLE
    speed_ratio: float = NOT_APPLICABLE
    on_table: float = NOT_APPLICABLE
    arrived: float = NOT_APPLICABLE
    learning_ms: float = NOT_APPLICABLE
    call_us: float = NOT_APPLICABLE


def compose_lessons(library: StrokeLibrary, plan: StudyPlan) -> Iterator[tuple[int, ShownMovement]]:
    """Let one person of the library after another demonstrate every movement; the same plan gives the same lessons."""
    writers = sorted(set(library.writers))
    for session in range(plan.sessions):
        person = library.select(writer=writers[session % len(writers)])
        for number, label in enumerate(plan.labels):
            rng = np.random.default_rng([plan.seed, session, number])
            language = Language(movements=(label,), movement_signs=("4",), unseen=())
            sampler = StrokeSampler(person)
            drawn = [compose_loops(language, sampler, 0, rng) for _ in range(plan.demonstrations)]
            paths = [compose_path(sample_hand(rng) - sample_scene(rng)[0], loops) for loops in drawn]
            focus = sample_scene(rng)[0]
            hands = rng.uniform(-TABLE, TABLE, (plan.starts, 2)) - focus
            times = [sample_times(len(path)) for path in paths]
            yield (
                session,
                ShownMovement(label, paths, times, [loop for loops in drawn for loop in loops], focus, hands),
            )


def run_study(library: StrokeLibrary, plan: StudyPlan, kinds: Sequence[str] = POLICY_KINDS) -> Iterator[Trial]:
    """Try every kind on every lesson; yields as it goes."""
    for session, lesson in compose_lessons(library, plan):
        for kind in kinds:
            begin = time.perf_counter()
            policy = make_policy(lesson.paths, lesson.times, kind)
            learning = time.perf_counter() - begin
            yield try_policy(policy, lesson, plan, session)._replace(learning_ms=1e3 * learning)


def try_policy(policy: Policy, lesson: ShownMovement, plan: StudyPlan, session: int = 0) -> Trial:
    """Move hands by a policy from random places, shove some, and judge all."""
    path = run_policy(policy, lesson.hands, plan.seconds)
    on_table = (np.abs(path + lesson.focus) < TABLE + 0.02).all(axis=(0, 2)).mean()
    begin = time.perf_counter()
    for hand in lesson.hands:
        policy(hand)
    call = (time.perf_counter() - begin) / len(lesson.hands)
    trial = Trial(policy.kind, lesson.label, session, on_table=float(on_table), call_us=1e6 * call)
    if lesson.label in GOAL_LABELS:
        return trial._replace(arrived=float(arrives_and_stays(path, np.zeros(2), STAY).mean()))
    angles = np.random.default_rng([plan.seed, session]).uniform(0, 2 * np.pi, len(lesson.hands))
    shove = SHOVE * np.column_stack([np.cos(angles), np.sin(angles)])
    conducts = [judge_path(path[:, b], lesson.loops) for b in range(len(lesson.hands))]
    good = np.array([c.draws for c in conducts])
    shoved_path = run_policy(policy, lesson.hands, plan.seconds, shove_half_way(shove, plan.seconds))
    shoved = back_after_shove(shoved_path, lesson.loops)
    means = [_mean(c[i] for c in conducts if c.draws) for i in range(5)]
    back = float(shoved[good].mean()) if good.any() else np.nan
    return trial._replace(
        drawn=float(good.mean()), misfit=means[0], corner_gap=means[1], detour=means[2],
        back_after_shove=back, speed_correlation=means[3], speed_ratio=means[4],
    )  # fmt: skip


def _mean(values: Iterable[float]) -> float:
    known = [v for v in values if np.isfinite(v)]
    return float(np.mean(known)) if known else float("nan")


class Summary(NamedTuple):
    """Measures of one kind over all trials: shares are means, the others medians, with the 95th percentile.

    Attributes:
        kind: Of policy.
        measures: Middle and 95th percentile, by name.
        intervals: Of the shares: 95 % interval for hands that come in clusters, one for each lesson.
        lessons: How many lessons were tried.
        hands: How many hands.
    """

    kind: str
    measures: dict[str, tuple[float, float]]
    intervals: dict[str, tuple[float, float]]
    lessons: int
    hands: int


SHARES = ("drawn", "back_after_shove", "on_table", "arrived")


def summarise(trials: Sequence[Trial], starts: int) -> list[Summary]:
    """Return a summary for each kind, in the order they first appear; each trial is of so many starts."""
    summaries = []
    for kind in dict.fromkeys(t.kind for t in trials):
        mine = [t for t in trials if t.kind == kind]
        measures, intervals = {}, {}
        for name in Trial._fields[3:]:
            told = [t for t in mine if np.isfinite(getattr(t, name))]
            values = [getattr(t, name) for t in told]
            middle = (np.mean if name in SHARES else np.median)(values) if values else np.nan
            measures[name] = (float(middle), float(np.percentile(values, 95)) if values else float("nan"))
            if name in SHARES and values:
                asked = [starts * (t.drawn if name == "back_after_shove" else 1.0) for t in told]  # hands
                found = estimate_share(np.multiply(values, asked), asked)
                intervals[name] = found.low, found.high
        summaries.append(Summary(kind, measures, intervals, len(mine), len(mine) * starts))
    return summaries


def study_table(summaries: Sequence[Summary]) -> str:
    """Return the summaries as a Markdown table, a row for each kind."""
    names = list(summaries[0].measures)
    rows = []
    for summary in summaries:
        cells = []
        for name, (middle, high) in summary.measures.items():
            if not np.isfinite(middle):
                cells.append("–")
            elif name in SHARES:
                low, high = summary.intervals[name]
                cells.append(f"{100 * middle:.1f} % [{100 * low:.1f}, {100 * high:.1f}]")
            else:
                cells.append(f"{middle:.3g} ({high:.3g})")
        rows.append((summary.kind, summary.lessons, summary.hands, *cells))
    return markdown_table(("kind", "lessons", "hands", *(name.replace("_", " ") for name in names)), rows)
