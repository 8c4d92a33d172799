"""The default learner: movements, foci, word order and sign meanings are inferred together.

In the paper each step decides before the next one looks (grouping, then focus, then word order). Here every
demonstration has one focus and one movement, and one objective weighs all that was seen: how alike two drawings are in
the frames of their foci, how alike two signs are at each place of the utterance, where drawings lie. All word orders
are compared by the best explanation that each allows.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import softmax

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.grouping import canonical_labels
from signimit.inference import WordOrder
from signimit.learners.base import Belief, Learner, Understanding
from signimit.learners.joint.distance_model import DRAWINGS, SIGNS, DistanceModel
from signimit.learners.joint.distances import Distances, extend_distances, measure_distances
from signimit.learners.joint.search import (
    MOVEMENT_PRICE,
    Explanation,
    PairEvidence,
    conditional_scores,
    first_guesses,
    improve_explanation,
    merge_groups,
    pairs_of_equals,
)
from signimit.learners.joint.sign_distance import VocabularyReader, sign_features
from signimit.learners.joint.split_movements import split_movements
from signimit.validation import finite_array

_INITIAL_SCALES = (-1.4, -1.2, -1.0)  # typical log distances of equal drawings to start from
_MAX_ITERATIONS = 2
_TEMPERATURE = 3.0  # pairs are not independent: their summed evidence is this much too sure


class JointEvidence(NamedTuple):
    """What the learner measured.

    Attributes:
        distances: Distances of drawings in all pairs of frames, shape (N, N, O, O).
        sign_distances: Distances of signs at each place of the utterance, shape (W, N, N).
        place_evidence: Evidence of each drawing's place for each object, shape (N, O), nats.
        scale: Typical log distances of equal drawings and signs in this session, shape (2,).
    """

    distances: NDArray[np.float64]
    sign_distances: NDArray[np.float64]
    place_evidence: NDArray[np.float64]
    scale: NDArray[np.float64]


class Scale(NamedTuple):
    """Typical log distances of equals in this session."""

    drawings: float
    signs: float


class Hypothesis(NamedTuple):
    """A complete answer: an explanation under a word order, with the scales it goes with."""

    order: WordOrder
    explanation: Explanation
    scale: Scale
    score: float


@dataclass(frozen=True)
class JointLearner(Learner):
    """Explains all demonstrations at once; needs no prototypes.

    Attributes:
        drawings: What a distance of drawings says.
        signs: What a distance of signs says.
    """

    drawings: DistanceModel = DRAWINGS
    signs: DistanceModel = SIGNS

    def infer(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, rng: np.random.Generator
    ) -> Understanding:
        """Compare all word orders and return the best explanation; nothing is random."""
        return _best_hypothesis(EvidenceCache(measure_distances(demonstrations), self.drawings, self.signs))

    def extend(self, demonstrations: DemonstrationSet, understanding: Understanding) -> Understanding:
        """Take one more demonstration, the last, into account.

        Only its distances are measured. The search, which costs less, starts anew: early mistakes are not kept.

        Raises:
            InvalidInputError: If the understanding keeps no distances.
        """
        evidence = understanding.evidence
        if not isinstance(evidence, JointEvidence):
            raise InvalidInputError("diagnostics", "distances, which the joint learner measures", "none")
        known = Distances(evidence.distances, evidence.sign_distances, evidence.place_evidence)
        return _best_hypothesis(EvidenceCache(extend_distances(demonstrations, known), self.drawings, self.signs))

    def reader(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, understanding: Understanding
    ) -> VocabularyReader:
        """Make a reader that compares signs with all signs of each meaning."""
        features = [sign_features([d.signs[w] for d in demonstrations]) for w in range(len(demonstrations[0].signs))]
        return VocabularyReader(tuple(features), understanding, demonstrations.objects.shape[1])

    def restore_evidence(
        self, demonstrations: DemonstrationSet, arrays: Mapping[str, NDArray[Any]]
    ) -> JointEvidence | None:
        """Make the evidence again from the arrays of a model file; None where some are missing."""
        count, frames, words = len(demonstrations), demonstrations.objects.shape[1], len(demonstrations[0].signs)
        shapes = ((count, count, frames, frames), (words, count, count), (count, frames), (2,))
        if not set(JointEvidence._fields) <= arrays.keys():
            return None
        named = zip(JointEvidence._fields, shapes, strict=True)
        return JointEvidence(*(finite_array(arrays[name], name.replace("_", " "), shape) for name, shape in named))


def _best_hypothesis(weighing: EvidenceCache) -> Understanding:
    seen = weighing.seen
    orders = _word_orders(len(seen.signs))
    best = [max(_hypotheses(weighing, order), key=lambda h: h.score) for order in orders]
    chosen = _split_merged(seen, max(best, key=lambda h: h.score))
    return _understanding(weighing, chosen, {h.order: h.score for h in best})


def _split_merged(seen: Distances, chosen: Hypothesis) -> Hypothesis:
    """Take apart what is two movements, though no pair shows it."""
    labels, focus, score = chosen.explanation
    everyone = np.arange(len(labels))
    drawings = seen.drawings[everyone[:, None], everyone, focus[:, None], focus]
    split = split_movements(labels, drawings, seen.signs[chosen.order.movement])
    return chosen._replace(explanation=Explanation(split, focus, score))


def _word_orders(words: int) -> list[WordOrder]:
    if words == 1:
        return [WordOrder(0, 0)]
    return [WordOrder(f, m) for f, m in itertools.permutations(range(words), 2)]


class EvidenceCache:
    """Turns distances into evidence, and remembers it: most hypotheses come to the same scales."""

    def __init__(self, seen: Distances, drawings: DistanceModel, signs: DistanceModel) -> None:
        """Remember nothing yet."""
        self.seen, self.drawings, self.signs = seen, drawings, signs
        self._nobody = np.eye(len(seen.place), dtype=bool)
        self._drawings = lru_cache(len(_INITIAL_SCALES) + 1)(partial(self._ratios, drawings, seen.drawings))
        self._words = [lru_cache(2)(partial(self._ratios, signs, word)) for word in seen.signs]

    def evidence(self, order: WordOrder, scale: Scale) -> PairEvidence:
        """Weigh all distances under a word order and the session's scales."""
        movement, focus = (self.word(w, scale) for w in (order.movement, order.focus))
        return PairEvidence(self._drawings(scale.drawings), movement, focus, self.seen.place)

    def word(self, number: int, scale: Scale) -> NDArray[np.float64]:
        """Weigh the distances of the signs at one place of the utterance, shape (N, N)."""
        return self._words[number](scale.signs)

    def _ratios(self, model: DistanceModel, distances: NDArray[np.float64], typical: float) -> NDArray[np.float64]:
        ratios = model.log_ratios(distances, typical)
        ratios[self._nobody] = 0.0
        return ratios


def _hypotheses(weighing: EvidenceCache, order: WordOrder) -> list[Hypothesis]:
    """Explain the demonstrations under one word order from several starts."""
    found = []
    for typical in _INITIAL_SCALES:
        scale = Scale(typical, weighing.signs.equal_mean)
        for labels, focus in first_guesses(weighing.evidence(order, scale)):
            found.append(_settle(weighing, order, scale, (labels, focus)))
    return found


def _settle(
    weighing: EvidenceCache, order: WordOrder, scale: Scale, guess: tuple[NDArray[np.int64], NDArray[np.int64]]
) -> Hypothesis:
    """Alternate between the explanation and the scales it implies."""
    explanation = improve_explanation(weighing.evidence(order, scale), *guess)
    for _ in range(_MAX_ITERATIONS):
        last, scale = scale, _implied_scale(weighing, order, explanation)
        if scale == last:
            break
        explanation = improve_explanation(weighing.evidence(order, scale), explanation.labels, explanation.focus)
    prior = weighing.drawings.log_prior(scale.drawings) + weighing.signs.log_prior(scale.signs)
    score = explanation.score + prior + _idle_words_score(weighing, order, scale)
    return Hypothesis(order, explanation, scale, score)


def _idle_words_score(weighing: EvidenceCache, order: WordOrder, scale: Scale) -> float:
    """Score the best partition of each word that an order calls meaningless: every order has to explain all words."""
    total = 0.0
    for word in set(range(len(weighing.seen.signs))) - set(order):
        alike = weighing.word(word, scale)
        labels = merge_groups(alike)
        total += alike[labels[:, None] == labels[None]].sum() / 2 - MOVEMENT_PRICE * (labels.max() + 1)
    return float(total)


def _implied_scale(weighing: EvidenceCache, order: WordOrder, explanation: Explanation) -> Scale:
    seen, (labels, focus, _) = weighing.seen, explanation
    t, k = pairs_of_equals(labels)
    drawings = seen.drawings[t, k, focus[t], focus[k]]
    signs = np.concatenate([seen.signs[order.movement][t, k], seen.signs[order.focus][pairs_of_equals(focus)]])
    return Scale(
        weighing.drawings.posterior_mean(drawings, len(labels)), weighing.signs.posterior_mean(signs, len(labels))
    )


def _understanding(weighing: EvidenceCache, chosen: Hypothesis, orders: dict[WordOrder, float]) -> Understanding:
    seen = weighing.seen
    labels = canonical_labels(chosen.explanation.labels)
    focus = chosen.explanation.focus
    scores = conditional_scores(weighing.evidence(chosen.order, chosen.scale), labels, focus) / _TEMPERATURE
    belief = softmax(scores.reshape(len(labels), -1), axis=1).reshape(scores.shape)
    words = len(seen.signs)
    order_evidence = np.full((words, words), -np.inf)
    for order, score in orders.items():
        order_evidence[order] = score
    evidence = JointEvidence(seen.drawings, seen.signs, seen.place, np.array(chosen.scale))
    return Understanding(
        labels, focus, chosen.order, Belief(belief.sum(axis=1), belief.sum(axis=2), order_evidence), evidence
    )
