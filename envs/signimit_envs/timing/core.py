"""The learning core beside the loops that its formulas spell out."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from signimit import dtw_distance, learn, policy_distances
from signimit.similarity import directed_points
from signimit.teaching.composition import compose_demonstrations, compose_prototypes
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library
from signimit_envs.timing.measuring import Timing, time_in_turns

Array = NDArray[np.float64]


def time_core(seed: int, turns: int) -> list[Timing]:
    """Time Δ, dynamic time warping and learning on the twelve demonstrations of a synthetic session.

    Args:
        seed: Of the session.
        turns: How often everything is timed.
    """
    language, rng = PAPER_LANGUAGE, np.random.default_rng(seed)
    strokes = synthetic_library((*language.focus_signs, *language.movement_signs, *language.prototypes), rng=rng)
    movements = synthetic_library(language.movements, rng=rng)
    demonstrations, _ = compose_demonstrations(language, strokes, movements, rng)
    prototypes = compose_prototypes(language, strokes, rng)
    paths, objects = [demo.hand for demo in demonstrations], np.stack([demo.objects for demo in demonstrations])
    pairs = list(pairwise(demo.signs[0] for demo in demonstrations))
    ways: dict[str, Callable[[], object]] = {
        "Δ": partial(policy_distances, paths, objects),
        "plain Δ": partial(plain_distances, paths, objects),
        "DTW": lambda: [dtw_distance(*pair) for pair in pairs],
        "plain DTW": lambda: [plain_dtw(*pair) for pair in pairs],
        "paper": partial(learn, demonstrations, prototypes, method="paper"),
        "joint": partial(learn, demonstrations, prototypes, method="joint"),
    }
    times = time_in_turns(ways, turns)
    return [
        Timing.of(f"Δ of {len(paths)} paths", times["Δ"], times["plain Δ"], limit=0.05),
        Timing.of("dynamic time warping of two signs", times["DTW"], times["plain DTW"], pieces=len(pairs)),
        Timing.of("learning, method paper", times["paper"], limit=0.15),
        Timing.of("learning, method joint", times["joint"]),
    ]


def plain_distances(paths: list[Array], objects: Array) -> Array:
    """Compute Δ_{t;k;i;j} by four loops, as the paper's section II-B reads, shape (N, N, O, O), rad²."""
    directed = [directed_points(path) for path in paths]
    count, frames = objects.shape[:2]
    one_way = np.empty((count, count, frames, frames))
    for t, k, i, j in np.ndindex(one_way.shape):
        here, there = directed[t].positions - objects[t, i], directed[k].positions - objects[k, j]
        nearest = ((here[:, None] - there[None]) ** 2).sum(axis=2).argmin(axis=1)
        gaps = np.abs(directed[t].angles - directed[k].angles[nearest])
        one_way[t, k, i, j] = (np.minimum(gaps, 2 * np.pi - gaps) ** 2).mean()
    return np.minimum(one_way, one_way.transpose(1, 0, 3, 2))


def plain_dtw(first: Array, second: Array) -> float:
    """Compute the dynamic-time-warping distance of two signs by two loops, as its recursion reads."""
    total = np.full((len(first) + 1, len(second) + 1), np.inf)
    total[0, 0] = 0.0
    for (i, a), (j, b) in product(enumerate(first), enumerate(second)):
        total[i + 1, j + 1] = np.hypot(*(a - b)) + min(total[i, j], total[i, j + 1], total[i + 1, j])
    return float(total[-1, -1])
