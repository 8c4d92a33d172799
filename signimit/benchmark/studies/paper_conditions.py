"""Study of what must be true of demonstrations for the paper's own method to do as well as in its paper (section III).

Algorithm 1 was right in 50 of 51 runs there, and 50 nearest points drew 36 of 36 reproductions. Here one thing at a
time is varied, and both are measured on the same sessions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.scoring import same_partition
from signimit.benchmark.statistics import estimate_share
from signimit.benchmark.studies.paper_levels import Level
from signimit.benchmark.studies.varied_demonstrations import (
    CIRCLE_AGAINST,
    Variation,
    VariedSession,
    choose_mover,
    compose_varied,
)
from signimit.benchmark.workers import SessionProcesses
from signimit.evaluation import performed
from signimit.exceptions import InvalidInputError
from signimit.grouping import STEPS
from signimit.inference import infer_focus
from signimit.policies import run_policy
from signimit.policies.base import CONTROL_PERIOD, Array
from signimit.policies.knn import KNearestPolicy
from signimit.similarity import maximum_similarities, policy_distances
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.scenes import sample_hand, sample_scene

RUNS = 51  # of Algorithm 1 on each session, as in the paper
SECONDS = 10.0  # that a hand moves for each command
STARTS = 3  # commands for each movement, from random starts about random objects
SHOWN = 4  # drawings of each movement that the judge compares a path with
NEARNESS = (
    0.1  # largest membership, beside 1 of its own group, that a demonstration has before the columns are rescaled
)


class Result(NamedTuple):
    """What came out in one session at one level.

    Attributes:
        people: "built-in" or "real".
        senses: Senses of rotation of triangle up, triangle down and circle: "+" counter-clockwise.
        factor: What is varied.
        value: Its value.
        seed: Of the session.
        runs: Runs of Algorithm 1, each from another M_1.
        right: Runs that found the three movements.
        merged: Runs that put demonstrations of two movements in one group.
        circle_merged: Runs that did so with a circle and a triangle.
        split: Runs that put demonstrations of one movement in two groups.
        contrast: Geometric mean of γ within movements over that between movements.
        spread: Standard deviation of ln γ within movements.
        foci: Demonstrations, of 12, whose object is right when the movements are known.
        commands: Commands given to the policy; 0 where it was not tried.
        obeyed: Commands that it obeyed.
        misfit: Median misfit of its paths, half sizes.
    """

    people: str
    senses: str
    factor: str
    value: str
    seed: int
    runs: int
    right: int
    merged: int
    circle_merged: int
    split: int
    contrast: float
    spread: float
    foci: int
    commands: int = 0
    obeyed: int = 0
    misfit: float = float("nan")


def run_levels(
    levels: Sequence[Level], sessions: int, library: StrokeLibrary | None = None, first_seed: int = 0, workers: int = 1
) -> Iterator[list[Result]]:
    """Run every level on every session; yields the results of one session after the other.

    Args:
        levels: What to try.
        sessions: How many; session number s has the same requests, scenes and mover at every level.
        library: Strokes of real people; left out, built-in people draw.
        first_seed: Seed of the first session; the others follow.
        workers: Processes; with one, none is started.
    """
    if sessions < 1:
        raise InvalidInputError("sessions", "at least 1", f"{sessions}")
    tasks = [(levels, library, seed) for seed in range(first_seed, first_seed + sessions)]
    if workers < 2:
        yield from map(run_session, tasks)
        return
    with SessionProcesses(min(workers, sessions)) as pool:
        yield from pool.map(run_session, tasks)


def run_session(task: tuple[Sequence[Level], StrokeLibrary | None, int]) -> list[Result]:
    """Run every level on one session, given as levels, library and seed; what levels share is computed once."""
    levels, library, seed = task
    mover, people = choose_mover(library, seed), "built-in" if library is None else "real"
    groups: dict[tuple[Variation, str], Result] = {}
    draws: dict[tuple[Variation, int, bool], tuple[int, int, float]] = {}
    results = []
    for level in levels:
        way, obeying = (level.variation, level.first), (level.variation, level.neighbours, level.steady)
        if way not in groups or obeying not in draws:
            session = compose_varied(mover, level.variation, seed)
        if way not in groups:
            groups[way] = judge_groups(session, level.first, seed)
        if obeying not in draws and level.variation.senses == CIRCLE_AGAINST:  # one sense or another, it draws the same
            draws[obeying] = judge_policy(session, level, seed)
        commands, obeyed, misfit = draws.get(obeying, (0, 0, float("nan")))
        senses = "".join("+" if sense > 0 else "-" for sense in level.variation.senses)
        results.append(
            groups[way]._replace(
                people=people, senses=senses, factor=level.factor, value=level.value,
                commands=commands, obeyed=obeyed, misfit=misfit,
            )
        )  # fmt: skip
    return results


def judge_groups(session: VariedSession, first: str, seed: int) -> Result:
    """Run Algorithm 1 again and again on one session's demonstrations, and infer objects with movements known."""
    distances = policy_distances(session.paths, session.objects)
    gamma, movement = maximum_similarities(distances), session.movement
    found = group_many_times(gamma, [seed * RUNS + run for run in range(RUNS)], first)
    together = (found[:, :, None] == found[:, None]) & ~np.eye(len(movement), dtype=bool)
    same = movement[:, None] == movement
    circle = (movement == 2)[:, None] != (movement == 2)
    merged, split = (together & ~same).any(axis=(1, 2)), (~together & same & ~np.eye(len(same), dtype=bool)).any((1, 2))
    within, between = np.log(gamma[np.triu(same, 1)]), np.log(gamma[np.triu(~same, 1)])
    return Result(
        "", "", "", "", seed, RUNS, sum(same_partition(labels, movement) for labels in found),
        int(merged.sum()), int((together & circle).any(axis=(1, 2)).sum()), int(split.sum()),
        round(float(np.exp(within.mean() - between.mean())), 3), round(float(within.std()), 3),
        int((infer_focus(distances, movement) == session.focus).sum()),
    )  # fmt: skip


def group_many_times(gamma: Array, seeds: Sequence[int], first: str = "random") -> NDArray[np.int64]:
    """Run `group_movements` from many random M_1 at once; returns labels, shape (runs, N), not renamed.

    With ``first="random"`` the groups are those of `group_movements` with the same seeds.

    Args:
        gamma: γ, shape (N, N), with a diagonal of 0.
        seeds: Of M_1, one a run.
        first: "random"; or "near identity": each demonstration mostly in a group of its own.
    """
    count = len(gamma)
    m = np.stack([np.random.default_rng(seed).random((count, count)) for seed in seeds])
    if first == "near identity":
        m = np.eye(count) + NEARNESS * m
    m /= m.sum(axis=1, keepdims=True)
    for _ in range(STEPS):
        joint = (m[:, :, :, None] * m[:, :, None, :]).max(axis=1)
        joint /= joint.sum(axis=2, keepdims=True)
        mean = (joint * gamma).sum(axis=2, keepdims=True)
        gain = np.exp(np.clip(gamma / np.maximum(mean, 1e-300) - 1.0, None, 50.0)) - 1.0
        gain[:, np.eye(count, dtype=bool)] = 0.0
        new = m.copy()
        for k in range(count):
            new *= 1.0 + m[:, :, k, None] * gain[:, None, :, k]
            new /= new.max(axis=1, keepdims=True)
        new /= new.sum(axis=1, keepdims=True)
        new *= new.sum(axis=2, keepdims=True) ** 0.25
        new = new / new.sum(axis=1, keepdims=True) + 1e-4
        m = new / new.sum(axis=1, keepdims=True)
    return np.asarray(m.argmax(axis=1), dtype=np.int64)


def judge_policy(session: VariedSession, level: Level, seed: int) -> tuple[int, int, float]:
    """Let the paper's policy draw, movements and objects known: commands, how many it obeyed, the median misfit."""
    rng = np.random.default_rng([seed, 6])
    shown = [drawings[:SHOWN] for drawings in session.drawings]
    obeyed, misfits = 0, []
    for movement in range(len(shown)):
        members = np.flatnonzero(session.movement == movement)
        local = [session.paths[t] - session.objects[t, session.focus[t]] for t in members]
        period = CONTROL_PERIOD / level.variation.density
        shown_strokes = [Stroke(path, period * np.arange(len(path), dtype=np.float64)) for path in local]
        policy = KNearestPolicy.learn(shown_strokes, neighbours=level.neighbours)
        hands = np.array([sample_hand(rng) - sample_scene(rng)[0] for _ in range(STARTS)])
        drawn = run_policy(partial(_steady_velocity, policy) if level.steady else policy, hands, SECONDS)
        for path in drawn.transpose(1, 0, 2):
            performance = performed(path, np.zeros((1, 2)), shown)
            obeyed += performance.movement == movement
            misfits.append(performance.misfit)
    return len(misfits), obeyed, round(float(np.median(misfits)), 4)


def _steady_velocity(policy: KNearestPolicy, hands: Array) -> Array:
    velocity = policy(hands)
    return np.asarray(policy.speed * velocity / np.maximum(np.linalg.norm(velocity, axis=-1, keepdims=True), 1e-12))


SHARES = ("right", "right_low", "right_high", "foci", "obeyed", "obeyed_low", "obeyed_high")


class LevelScore(NamedTuple):
    """Results of a level over all sessions, shares with 95 % intervals that allow for sessions."""

    people: str
    senses: str
    factor: str
    value: str
    sessions: int
    right: float
    right_low: float
    right_high: float
    merged: float
    circle_merged: float
    split: float
    contrast: float
    spread: float
    foci: float
    obeyed: float
    obeyed_low: float
    obeyed_high: float
    misfit: float


def score_levels(results: Sequence[Result]) -> list[LevelScore]:
    """Average over sessions, a row for each level in the order of appearance; contrast, spread, misfit by medians."""
    groups: dict[tuple[str, str, str, str], list[Result]] = {}
    for result in results:
        key = (result.people, result.senses, result.factor, result.value)
        groups.setdefault(key, []).append(result)
    scores = []
    for (people, senses, factor, value), mine in groups.items():
        runs = [r.runs for r in mine]
        right = estimate_share([r.right for r in mine], runs)
        merged, circle_merged, split = (
            round(sum(counts) / sum(runs), 4)
            for counts in zip(*((r.merged, r.circle_merged, r.split) for r in mine), strict=True)
        )
        contrast, spread, misfit = np.median([(r.contrast, r.spread, r.misfit) for r in mine], axis=0).round(4).tolist()
        drawn = None
        if all(r.commands for r in mine):
            drawn = estimate_share([r.obeyed for r in mine], [r.commands for r in mine])
        obeyed, low, high = (drawn.mean, drawn.low, drawn.high) if drawn else (float("nan"),) * 3
        foci = sum(r.foci for r in mine) / (12 * len(mine))
        shares = (right.mean, right.low, right.high, foci, obeyed, low, high)
        rounded = dict(zip(SHARES, (round(share, 4) for share in shares), strict=True))
        scores.append(
            LevelScore(
                people=people, senses=senses, factor=factor, value=value, sessions=len(mine), merged=merged,
                circle_merged=circle_merged, split=split, contrast=contrast, spread=spread, misfit=misfit, **rounded,
            )
        )  # fmt: skip
    return scores


class IdealGamma(NamedTuple):
    """How often Algorithm 1 is right on similarities made up: contrast and spread as in `Result`."""

    contrast: float
    spread: float
    runs: int
    right: int


def run_ideal_gamma(
    contrasts: Sequence[float], spreads: Sequence[float], matrices: int = 5, seed: int = 0
) -> Iterator[IdealGamma]:
    """Run Algorithm 1 on γ that is log-normal: ``contrast`` within movements, 1 between, the same spread in both."""
    rng, movement = np.random.default_rng(seed), np.repeat(np.arange(3), 4)
    mean = movement[:, None] == movement
    for contrast in contrasts:
        for spread in spreads:
            right = 0
            for _ in range(matrices):
                noise = np.triu(rng.normal(size=mean.shape), 1)
                gamma = np.where(mean, contrast, 1.0) * np.exp(spread * (noise + noise.T))
                np.fill_diagonal(gamma, 0.0)
                found = group_many_times(gamma, range(RUNS))
                right += sum(same_partition(labels, movement) for labels in found)
            yield IdealGamma(contrast, spread, matrices * RUNS, right)
