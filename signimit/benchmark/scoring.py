"""Scores of one session: inferences, readings of signs and hand paths against the ground truth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.statistics import Share
from signimit.evaluation import PathJudge, performed
from signimit.inference import WordOrder
from signimit.learners.base import Reading
from signimit.teaching.composition import GroundTruth
from signimit.teaching.languages import Request
from signimit.teaching.sessions import Command

WORST = 3.0  # half sizes; a larger misfit, or a hand that rested, counts as this much


class Inferences(Protocol):
    """Inferences from demonstrations: of an `ImitationModel`, or an `Understanding`."""

    @property
    def labels(self) -> NDArray[np.int64]:
        """Movement of each demonstration, shape (N,), numbered in any way."""
        ...

    @property
    def focus(self) -> NDArray[np.int64]:
        """Object of each demonstration, shape (N,)."""
        ...

    @property
    def word_order(self) -> WordOrder:
        """Which word names the object and which the movement."""
        ...


class InferenceVerdict(NamedTuple):
    """Verdicts on inferences from demonstrations.

    Attributes:
        grouping: Demonstrations of one movement, and only they, are in one group.
        focus: Every demonstration's object is right.
        word_order: Both words are right.
        foci_right: How many demonstrations' objects are right.
        rand_index: Adjusted Rand index of the grouping, 1 at best, 0 by chance.
    """

    grouping: bool
    focus: bool
    word_order: bool
    foci_right: Share
    rand_index: float

    @property
    def all_right(self) -> bool:
        """Whether nothing was inferred wrong."""
        return self.grouping and self.focus and self.word_order


def judge_inference(inferred: Inferences, truth: GroundTruth) -> InferenceVerdict:
    """Compare inferences with the ground truth."""
    foci = Share.of(np.asarray(inferred.focus) == truth.focus)
    order = tuple(inferred.word_order) == (truth.language.focus_word, truth.language.movement_word)
    return InferenceVerdict(
        same_partition(inferred.labels, truth.movement),
        foci.count == foci.total,
        order,
        foci,
        adjusted_rand_index(inferred.labels, truth.movement),
    )


def same_partition(labels: ArrayLike, others: ArrayLike) -> bool:
    """Return whether two labellings, each of shape (N,), are the same partition."""
    a, b = np.asarray(labels).tolist(), np.asarray(others).tolist()
    return len(set(zip(a, b, strict=True))) == len(set(a)) == len(set(b))


def adjusted_rand_index(found: ArrayLike, true: ArrayLike) -> float:
    """Compute the adjusted Rand index of two groupings, each of shape (N,).

    Source: L. Hubert and P. Arabie, Journal of Classification 2, 1985 (doi:10.1007/BF01908075).
    """

    def pairs(counts: NDArray[np.generic]) -> float:
        numbers = counts.astype(np.float64)
        return float((numbers * (numbers - 1) / 2).sum())

    ours, theirs = (np.unique(np.asarray(labels), return_inverse=True)[1] for labels in (found, true))
    table = np.zeros((ours.max() + 1, theirs.max() + 1))
    np.add.at(table, (ours, theirs), 1)
    together = pairs(table)
    rows, columns, everything = pairs(table.sum(axis=1)), pairs(table.sum(axis=0)), pairs(np.array(len(ours)))
    expected = rows * columns / everything if everything else 0.0
    best = (rows + columns) / 2
    return 1.0 if best == expected else float((together - expected) / (best - expected))


def count_signs_read(reading: Reading, inferred: Inferences, truth: GroundTruth, request: Request) -> int:
    """Count the signs of an utterance that were read right, 0 to 2: the movement's and the object's.

    A movement that was found stands for what most of its members show.
    """
    members = np.asarray(inferred.labels) == int(np.argmax(reading.movement))
    shown = np.bincount(truth.movement[members]) if members.any() else np.zeros(1)
    return int(shown.argmax() == request.movement and shown.any()) + int(np.argmax(reading.focus) == request.focus)


class CommandScore(NamedTuple):
    """Score of a command.

    Attributes:
        obeyed: Whether the hand did what was asked for.
        misfit: Of the hand's path to what was asked for, in half sizes of the drawings, at most 1.
    """

    obeyed: bool
    misfit: float


def score_path(
    path: NDArray[np.float64], command: Command, templates: Sequence[Sequence[NDArray[np.float64]]]
) -> CommandScore:
    """Score the path of a hand by what a command asks for.

    Args:
        path: Where it was, shape (T, 2), m, table frame.
        command: The command.
        templates: Drawings of each movement, each (T, 2), m, object's frame.
    """
    movement, focus = command.request
    asked = PathJudge(templates[movement : movement + 1]).judge(path, command.objects[focus : focus + 1])
    misfit = min(WORST, asked.misfit)
    if asked.movement < 0:  # then no comparison with other movements and objects can make it right
        return CommandScore(False, misfit)
    performance = performed(path, command.objects, templates)
    return CommandScore((performance.movement, performance.focus) == command.request, misfit)
