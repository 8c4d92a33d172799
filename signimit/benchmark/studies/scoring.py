"""Was an answer right, how often, and how far can that be trusted."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.studies.cells import StudySession
from signimit.benchmark.studies.methods import Answer
from signimit.learning import ImitationModel
from signimit.teaching.composition import GroundTruth

BINS = 10


class Verdict(NamedTuple):
    """Which inferences were right."""

    group: bool
    focus: bool
    order: bool

    @property
    def all(self) -> bool:
        """Whether nothing was wrong."""
        return self.group and self.focus and self.order


def judge(answer: Answer, truth: GroundTruth) -> Verdict:
    """Compare an answer with the truth."""
    ours, theirs = answer.labels.tolist(), truth.movement.tolist()
    group = len(set(zip(ours, theirs, strict=True))) == len(set(ours)) == len(set(theirs))
    order = tuple(answer.order) == (truth.language.focus_word, truth.language.movement_word)
    return Verdict(group, bool((answer.focus == truth.focus).all()), order)


def confidences(model: ImitationModel, session: StudySession) -> list[tuple[float, bool]]:
    """Ask for every pair once.

    Returns:
        For each command how sure the model is, and whether it is right: the object is the one asked for, and most
        members of the movement show the one asked for.
    """
    means = {
        m: Counter(session.truth.movement[list(movement.members)].tolist()).most_common(1)[0][0]
        for m, movement in enumerate(model.movements)
    }
    found = []
    for pair, signs, objects in session.commands:
        response = model.respond(signs, objects)
        right = response.focus == pair.focus and means[response.movement] == pair.movement
        found.append((response.confidence, right))
    return found


class Calibration(NamedTuple):
    """How well confidences fit what happens.

    Attributes:
        confidence: Mean confidence of each bin that is not empty.
        accuracy: Share that was right in it.
        counts: How many commands it has.
        error: Expected calibration error: mean |confidence - accuracy|, weighted by counts.
        coverage: Share of commands obeyed when those of lower confidence are declined, ascending.
        risk: Share of wrong ones among the obeyed, at each coverage.
    """

    confidence: NDArray[np.float64]
    accuracy: NDArray[np.float64]
    counts: NDArray[np.int64]
    error: float
    coverage: NDArray[np.float64]
    risk: NDArray[np.float64]


def calibrate(confidence: ArrayLike, right: ArrayLike) -> Calibration:
    """Compare confidences, shape (n,), with what was right, shape (n,).

    The expected calibration error is that of M. P. Naeini, G. Cooper and M. Hauskrecht, AAAI 2015, with ten bins of
    equal width.
    """
    sure, truth = np.asarray(confidence, dtype=np.float64), np.asarray(right, dtype=np.float64)
    number = np.minimum((sure * BINS).astype(int), BINS - 1)
    count = np.bincount(number, minlength=BINS)
    full = count > 0
    mean = np.bincount(number, sure, BINS)[full] / count[full]
    accuracy = np.bincount(number, truth, BINS)[full] / count[full]
    error = float((count[full] * np.abs(mean - accuracy)).sum() / len(sure))
    order = np.argsort(-sure, kind="stable")
    asked = np.arange(1, len(sure) + 1)
    risk = np.cumsum(1 - truth[order]) / asked
    return Calibration(mean, accuracy, count[full], error, asked / len(sure), risk)
