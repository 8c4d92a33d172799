"""Search for the hypothesis with the highest objective: from many starts, one demonstration moves at a time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

from signimit.learners.joint.measurements import Measurements
from signimit.learners.joint.objective import (
    NOTHING,
    Assumptions,
    Hypothesis,
    Objective,
    Scores,
    drawing_evidence,
)

Array = NDArray[np.float64]

_MOST_MOVEMENTS = 12  # of a start; the search may find more
_SETTLED = 6  # starts that are followed to their end: those that begin highest
_MOVES = 30  # for each demonstration; a guard, the objective rises with each


def first_hypotheses(seen: Measurements, movement_word: Array, assumed: Assumptions) -> list[Hypothesis]:
    """Return hypotheses to start from: trees of drawings, and of drawings and words, cut into 1 to 12 movements.

    Args:
        seen: What was measured.
        movement_word: Weighted evidence of the signs that ask for movements, shape (N, N).
        assumed: What is assumed of people.
    """
    place = seen.place_evidence.argmax(axis=1)
    drawn = drawing_evidence(seen.drawings, assumed)
    trees = [_tree(drawn + movement_word), _tree(drawn)]
    cuts = {
        tuple(fcluster(tree, count, "maxclust").tolist())
        for tree in trees
        for count in range(1, min(_MOST_MOVEMENTS, len(place) - 1) + 1)
    } or {(1,) * len(place)}
    return [Hypothesis(np.array(cut) - 1, place, np.array(cut) - 1, place).compact() for cut in sorted(cuts)]


def _tree(evidence: Array) -> Array:
    """Average linkage of symmetric evidence, shape (N, N)."""
    if len(evidence) < 2:
        return np.zeros((0, 4))
    distances = evidence.max() - evidence
    np.fill_diagonal(distances, 0.0)
    return np.asarray(linkage(squareform(distances, checks=False), "average"))


def best_partition_value(evidence: Array) -> float:
    """Find how well the best partition of signs explains them where it is free, nats: for words that mean nothing.

    Args:
        evidence: Weighted evidence of each pair, shape (N, N).
    """
    best, tree = 0.0, _tree(evidence)
    for count in range(1, min(_MOST_MOVEMENTS, len(evidence) - 1) + 1):
        member = np.eye(count + 1)[fcluster(tree, count, "maxclust")]
        sums, sizes = ((evidence @ member) * member).sum(axis=0), member.sum(axis=0)
        best = max(best, float((sums / np.maximum(sizes, 1)).sum()))
    return best


def search(objective: Objective, starts: list[Hypothesis]) -> tuple[float, Hypothesis]:
    """Return the highest objective that is reached from any start, nats, and the hypothesis."""
    ranked = []
    for start in starts:
        objective.start(start)
        ranked.append(objective.value())
    chosen = np.argsort(-np.array(ranked), kind="stable")[:_SETTLED]
    found = [(_settle(objective, starts[i]), objective.hypothesis) for i in chosen]
    return max(found, key=lambda end: end[0])


def _settle(objective: Objective, start: Hypothesis) -> float:
    """Move one demonstration after another to where it fits best, the most urgent first, until none wants to move."""
    objective.start(start)
    everyone = np.arange(objective.count)
    for _ in range(_MOVES * objective.count):
        scores, known = objective.scores(), objective.hypothesis
        done = np.where(
            known.movement == NOTHING,
            -scores.irrelevance,
            scores.done[everyone, known.movement, known.place]
            - scores.mistake[everyone, known.movement] * ~known.meant,
        )
        askable = scores.shown[everyone, known.asked_movement] | (known.movement == known.asked_movement)
        asked = np.where(askable, scores.movement[everyone, known.asked_movement], -np.inf)
        now = done + asked + scores.focus[everyone, known.asked_focus]
        gains = best_choices(scores) - now[:, None]
        mover = int(gains.max(axis=1).argmax())
        if not gains[mover].max() > 1e-9:
            break
        objective.move(mover, *_choose(scores, mover, int(gains[mover].argmax())))
    return objective.value()


def best_choices(scores: Scores) -> Array:
    """Return the best gains, shape (N, 3): doing what is asked for, doing something else, being beside the point."""
    count = len(scores.done)
    asked = scores.askable.max(axis=1) + scores.focus.max(axis=1)
    mistaken = scores.mistaken.reshape(count, -1).max(axis=1) + asked
    return np.column_stack([scores.meant.reshape(count, -1).max(axis=1), mistaken, asked - scores.irrelevance])


def _choose(scores: Scores, member: int, choice: int) -> tuple[int, int, int, int]:
    """Return what a demonstration does and asks for by one of the three choices."""
    gain = scores.meant[member] if choice == 0 else scores.mistaken[member]
    movement, place = (int(i) for i in np.unravel_index(int(gain.argmax()), gain.shape))
    if choice == 0:
        return movement, place, movement, place
    asked = int(scores.askable[member].argmax()), int(scores.focus[member].argmax())
    return (movement, place, *asked) if choice == 1 else (NOTHING, place, *asked)
