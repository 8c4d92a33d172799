"""Scores of one session, stage by stage: what was understood, what was read, what was done."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.commands import Command
from signimit.evaluation import TOLERANCE, movement_error, performed, prepare_templates, settled_part
from signimit.learners.base import Reading, Understanding
from signimit.teaching.composition import GroundTruth
from signimit.teaching.languages import Request

WORST = 1.0  # half sizes; a larger misfit, or a hand that rested, counts as this much


class Understood(NamedTuple):
    """How well the demonstrations were understood.

    Attributes:
        groups: Adjusted Rand index of the movements found, 1 at best, 0 by chance.
        focus: Share of demonstrations whose object is right.
        order: Whether the word order is right, 0 or 1.
    """

    groups: float
    focus: float
    order: float


class Done(NamedTuple):
    """What became of a command.

    Attributes:
        obeyed: Whether the hand did what was asked for.
        misfit: Of the hand's path to what was asked for, in half sizes of the drawings, at most 1.
    """

    obeyed: bool
    misfit: float


def adjusted_rand_index(found: ArrayLike, true: ArrayLike) -> float:
    """Compare two groupings, each of shape (N,).

    Source: L. Hubert and P. Arabie, Journal of Classification 2, 1985 (doi:10.1007/BF01908075).
    """
    ours, theirs = (np.unique(np.asarray(labels), return_inverse=True)[1] for labels in (found, true))
    table = np.zeros((ours.max() + 1, theirs.max() + 1))
    np.add.at(table, (ours, theirs), 1)
    together = _pairs(table)
    rows, columns, everything = _pairs(table.sum(axis=1)), _pairs(table.sum(axis=0)), _pairs(np.array(len(ours)))
    expected = rows * columns / everything if everything else 0.0
    best = (rows + columns) / 2
    return 1.0 if best == expected else float((together - expected) / (best - expected))


def _pairs(counts: NDArray[np.generic]) -> float:
    numbers = counts.astype(np.float64)
    return float((numbers * (numbers - 1) / 2).sum())


def score_understanding(understanding: Understanding, truth: GroundTruth) -> Understood:
    """Compare what was inferred from demonstrations with what they were."""
    order = tuple(understanding.word_order) == (truth.language.focus_word, truth.language.movement_word)
    groups = adjusted_rand_index(understanding.labels, truth.movement)
    return Understood(groups, float((np.asarray(understanding.focus) == truth.focus).mean()), float(order))


def count_signs_read(reading: Reading, understanding: Understanding, truth: GroundTruth, request: Request) -> int:
    """Count the signs of an utterance that were read right, 0 to 2: the movement's and the object's.

    A movement that was found stands for what most of its members show.
    """
    members = np.asarray(understanding.labels) == int(np.argmax(reading.movement))
    shown = np.bincount(truth.movement[members]) if members.any() else np.zeros(1)
    return int(shown.argmax() == request.movement and shown.any()) + int(np.argmax(reading.focus) == request.focus)


class Judge:
    """Judges paths by the drawings that were demonstrated in a session."""

    def __init__(self, templates: Sequence[Sequence[NDArray[np.float64]]]) -> None:
        """Take the drawings of each movement, each (T, 2), m, object's frame."""
        self._templates = templates
        self._prepared = prepare_templates(templates)

    def judge(self, path: NDArray[np.float64], command: Command) -> Done:
        """Say whether a path, shape (T, 2), m, table frame, does what a command asks for."""
        movement, focus = command.request
        tail, misfit = settled_part(path), WORST
        if tail is not None:
            misfit = min(WORST, movement_error(tail - command.objects[focus], self._prepared[movement]))
        if misfit > TOLERANCE:  # then no comparison with other movements and objects can make it right
            return Done(False, misfit)
        performance = performed(path, command.objects, self._templates)
        return Done((performance.movement, performance.focus) == command.request, misfit)
