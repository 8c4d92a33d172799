"""The default learner: what everybody did, what everybody asked for and the word order, by one objective.

In the paper each step decides before the next one looks (grouping, then focus, then word order). Here one objective
weighs all that was seen (`signimit.learners.joint.objective`), and all word orders are compared by the best explanation
that each allows. A demonstration may answer something else than was asked, or be beside the point.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import logsumexp

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.inference import WordOrder
from signimit.learners.base import Asked, Belief, Learner, Understanding
from signimit.learners.joint.distance_model import SIGNS, DistanceModel
from signimit.learners.joint.drawing_dissimilarity import DRAWINGS, DrawingWeights
from signimit.learners.joint.measurements import EarlierMeasurements, Measurements, extend_measurements, measure
from signimit.learners.joint.objective import NOTHING, PEOPLE, Assumptions, Objective, Scores, word_evidence
from signimit.learners.joint.search import best_partition_value, first_hypotheses, search
from signimit.learners.joint.sign_distance import VocabularyReader, sign_features
from signimit.validation import finite_array

Array = NDArray[np.float64]


@dataclass(frozen=True)
class JointLearner(Learner):
    """Explains all demonstrations at once; needs no prototypes.

    Attributes:
        assumed: What it assumes of people.
        drawings: What features of drawings say.
        signs: What a distance of signs says.
    """

    assumed: Assumptions = PEOPLE
    drawings: DrawingWeights = DRAWINGS
    signs: DistanceModel = SIGNS

    def infer(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, rng: np.random.Generator
    ) -> Understanding:
        """Compare all word orders and return the best explanation; nothing is random."""
        return self.explain_measurements(measure(demonstrations, self.drawings))

    def extend(self, demonstrations: DemonstrationSet, understanding: Understanding) -> Understanding:
        """Take one more demonstration, the last, into account.

        Only its distances are measured. The search, which costs less, starts anew: early mistakes are not kept.
        """
        known = understanding.evidence
        if isinstance(known, Measurements):
            return self.explain_measurements(extend_measurements(demonstrations, known, self.drawings))
        return self.explain_measurements(
            measure(demonstrations, self.drawings)
        )  # a model of version 0.1.0 has other measurements

    def reader(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, understanding: Understanding
    ) -> VocabularyReader:
        """Make a reader that compares signs with all signs of each meaning."""
        features = [sign_features([d.signs[w] for d in demonstrations]) for w in range(len(demonstrations[0].signs))]
        return VocabularyReader(tuple(features), understanding, demonstrations.objects.shape[1])

    def restore_evidence(
        self, demonstrations: DemonstrationSet, arrays: Mapping[str, NDArray[Any]]
    ) -> Measurements | EarlierMeasurements | None:
        """Make the measurements again from the arrays of a model file; None where some are missing."""
        count, places, words = len(demonstrations), demonstrations.objects.shape[1], len(demonstrations[0].signs)
        shapes = {
            "drawings": (count, count),
            "sign_distances": (words, count, count),
            "offsets": (count, places, 2),
            "place_evidence": (count, places),
            "distances": (count, count, places, places),
            "scale": (2,),
        }
        for kind in (Measurements, EarlierMeasurements):
            if set(kind._fields) <= arrays.keys():
                found = kind(*(finite_array(arrays[n], n.replace("_", " "), shapes[n]) for n in kind._fields))
                if (found.sign_distances < 0).any():
                    raise InvalidInputError(
                        "sign distances", "numbers of at least 0", f"{found.sign_distances.min():g}"
                    )
                return found
        return None

    def explain_measurements(self, seen: Measurements) -> Understanding:
        """Compare all word orders and return the best explanation of what was measured."""
        words = word_evidence(seen.sign_distances, self.assumed, self.signs)
        idle = [best_partition_value(word) for word in words] if len(words) > 2 else [0.0] * len(words)
        found = []
        for order in word_orders(len(words)):
            objective = Objective(seen, words, order, self.assumed)
            value, hypothesis = search(objective, first_hypotheses(seen, words[order.movement], self.assumed))
            value += sum(idle[w] for w in range(len(words)) if w not in order)
            found.append((value, order, hypothesis, objective))
        _, order, hypothesis, objective = max(found, key=lambda end: end[0])
        objective.start(hypothesis)
        return _understanding(seen, objective, order, {o: value for value, o, *_ in found})


def word_orders(words: int) -> list[WordOrder]:
    """Return all word orders of utterances of so many words."""
    if words == 1:
        return [WordOrder(0, 0)]
    return [WordOrder(f, m) for f, m in itertools.permutations(range(words), 2)]


def _understanding(
    seen: Measurements, objective: Objective, order: WordOrder, values: Mapping[WordOrder, float]
) -> Understanding:
    known, words = objective.hypothesis, len(seen.sign_distances)
    trust, movement, focus = _probabilities(objective.scores())
    order_evidence = np.full((words, words), -np.inf)
    for other, value in values.items():
        order_evidence[other] = value
    nothing = known.movement == NOTHING
    return Understanding(
        known.movement,
        np.where(nothing, NOTHING, known.place),
        order,
        Belief(focus, movement, order_evidence),
        seen,
        Asked(known.asked_movement, known.asked_focus),
        trust,
    )


def _probabilities(scores: Scores) -> tuple[Array, Array, Array]:
    """Return trust, shape (N,), and probabilities of movements, (N, K + 1), and places, (N, C), that are done."""
    count = len(scores.done)
    asked = logsumexp(scores.askable, axis=1) + logsumexp(scores.focus, axis=1)
    meant, mistaken = scores.meant, scores.mistaken + asked[:, None, None]
    done = np.logaddexp(meant, mistaken)
    nothing = asked - scores.irrelevance
    total = np.logaddexp(logsumexp(done.reshape(count, -1), axis=1), nothing)
    movement = np.exp(logsumexp(done, axis=2) - total[:, None])
    movement[:, -1] += np.exp(nothing - total)
    focus = logsumexp(done, axis=1)
    return (
        np.exp(logsumexp(meant.reshape(count, -1), axis=1) - total),
        movement,
        np.exp(focus - logsumexp(focus, axis=1, keepdims=True)),
    )
