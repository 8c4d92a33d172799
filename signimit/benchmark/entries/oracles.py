"""Oracles: the paper's inference given a part of the ground truth, to show what each stage costs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.entries.imitator import Follower, Imitator, certain_reading
from signimit.benchmark.protocol import Kit, Truth
from signimit.demonstrations import DemonstrationSet
from signimit.grouping import canonical_labels, group_movements
from signimit.inference import WordOrder, infer_focus, infer_word_order
from signimit.learners.base import Reading, Understanding
from signimit.learners.paper import PaperEvidence
from signimit.learning import ImitationModel
from signimit.policies import DEFAULT_POLICY
from signimit.signs import SignSpace
from signimit.similarity import policy_distances, policy_similarities

METHOD = "paper"
Labels = NDArray[np.int64]


def oracle_grouping(kit: Kit, truth: Truth) -> Imitator:
    """Make the paper's imitator that is told which demonstrations show one movement."""

    def understand(demonstrations: DemonstrationSet) -> ImitationModel:
        distances = policy_distances(demonstrations.paths, demonstrations.objects)
        labels = canonical_labels(truth.shown.movement)
        return _model(kit, demonstrations, labels, infer_focus(distances, labels))

    return Imitator(understand)


def oracle_focus(kit: Kit, truth: Truth) -> Imitator:
    """Make the paper's imitator that is told which object each demonstration was about."""

    def understand(demonstrations: DemonstrationSet) -> ImitationModel:
        similarities = policy_similarities(policy_distances(demonstrations.paths, demonstrations.objects))
        everyone, focus = np.arange(len(demonstrations)), truth.shown.focus
        seen = similarities[everyone[:, None], everyone[None], focus[:, None], focus[None]]
        return _model(kit, demonstrations, group_movements(seen, method=METHOD, rng=kit.rng).labels, focus)

    return Imitator(understand)


def _model(kit: Kit, demonstrations: DemonstrationSet, labels: Labels, focus: Labels) -> ImitationModel:
    """Go on as the paper does from groups and foci: infer the word order, read by the nearest sign."""
    signs = [sign for shown in demonstrations for sign in shown.signs]
    points = SignSpace(kit.prototypes).embed_all(signs).reshape(len(demonstrations), -1, len(kit.prototypes))
    order = infer_word_order(points, labels, focus, method="paper")
    understanding = Understanding(labels, focus, order, evidence=PaperEvidence(points))
    return ImitationModel(demonstrations, understanding, METHOD, DEFAULT_POLICY, kit.prototypes)


class AllKnowing(Follower):
    """Oracle that is told all of the ground truth, so that only its policy can fail.

    Attributes:
        understanding: The truth.
        reading: The truth.
    """

    understanding: Understanding
    reading: Reading

    def __init__(self, kit: Kit, truth: Truth) -> None:
        """Store the truth."""
        self._truth, self._requests = truth, iter(truth.asked)

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Group the demonstrations as they were meant."""
        shown = self._truth.shown
        language = shown.language
        order = WordOrder(language.focus_word, language.movement_word)
        labels = canonical_labels(shown.movement)
        self._number = {int(meant): int(label) for meant, label in zip(shown.movement, labels, strict=True)}
        self.understanding = Understanding(labels, shown.focus, order)
        self._model = ImitationModel(demonstrations, self.understanding, METHOD, DEFAULT_POLICY)

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Look up what is asked for."""
        asked = next(self._requests)
        movement = self._number[asked.movement]
        self.reading = certain_reading(movement, asked.focus, len(self._number), len(objects))
        self.follow(self._model.policy(movement).at(objects[asked.focus]))
