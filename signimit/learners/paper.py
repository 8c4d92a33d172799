"""The paper's learner (sections II-A to II-D): a pipeline of similarity, grouping, focus, word order, nearest sign."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.grouping import group_movements
from signimit.inference import infer_focus, infer_word_order
from signimit.learners.base import Learner, Reading, Understanding
from signimit.signs import SignSpace
from signimit.similarity import maximum_similarities, policy_distances
from signimit.validation import finite_array


@one_line
class PaperEvidence(NamedTuple):
    """What the paper's steps were made of.

    Attributes:
        sign_points: All signs in the sign space, shape (N, W, P).
        distances: Δ, shape (N, N, O, O), rad².
        history: Memberships after each step of Algorithm 1, shape (steps + 1, N, N).
    """

    sign_points: NDArray[np.float64]
    distances: NDArray[np.float64] | None = None
    history: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class PaperLearner(Learner):
    """The paper's inference, with Algorithm 1 in one of its two readings.

    Attributes:
        grouping: Method of `signimit.grouping.group_movements`.
    """

    grouping: str = "paper"

    def infer(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, rng: np.random.Generator
    ) -> Understanding:
        """Infer step by step; no step hears of a later one."""
        space = _sign_space(prototypes)
        distances = policy_distances(demonstrations.paths, demonstrations.objects)
        grouping = group_movements(maximum_similarities(distances), method=self.grouping, rng=rng)
        focus = infer_focus(distances, grouping.labels)
        points = _sign_points(space, demonstrations)
        order = infer_word_order(points, grouping.labels, focus, method="paper")
        evidence = PaperEvidence(points, distances, grouping.history)
        return Understanding(grouping.labels, focus, order, evidence=evidence)

    def reader(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, understanding: Understanding
    ) -> NearestSignReader:
        """Make a reader that compares signs with those of all demonstrations."""
        space = _sign_space(prototypes)
        shape = (len(demonstrations), len(demonstrations[0].signs), len(space.prototypes))
        evidence = understanding.evidence
        if not isinstance(evidence, PaperEvidence):
            raise InvalidInputError("understanding", "the points of signs, which the paper's learner keeps", "none")
        points = finite_array(evidence.sign_points, "sign points", shape)
        return NearestSignReader(space, points, understanding, demonstrations.objects.shape[1])

    def restore_evidence(self, demonstrations: DemonstrationSet, arrays: Mapping[str, NDArray[Any]]) -> PaperEvidence:
        """Make the evidence again from the arrays of a model file."""
        return PaperEvidence(arrays["sign_points"], arrays.get("distances"), arrays.get("history"))


@one_line
@dataclass(frozen=True, eq=False)
class NearestSignReader:
    """Reads a sign as what the nearest demonstrated sign meant (paper, section II-D).

    Attributes:
        space: Where signs are points.
        points: Demonstrated signs, shape (N, W, P).
        understanding: What they meant.
        objects: Number of objects.
    """

    space: SignSpace
    points: NDArray[np.float64]
    understanding: Understanding
    objects: int

    def read(self, signs: Sequence[ArrayLike]) -> Reading:
        """Read an utterance.

        The probabilities are not the paper's, which only chooses: each meaning weighs as the inverse distance of its
        nearest sign. They are not calibrated.
        """
        heard = self.space.embed_all(signs)
        labels, focus, order = self.understanding[:3]
        movement = self._weigh(heard, order.movement, labels, int(labels.max()) + 1)
        return Reading(movement, self._weigh(heard, order.focus, focus, self.objects))

    def _weigh(
        self, heard: NDArray[np.float64], word: int, meanings: NDArray[np.int64], count: int
    ) -> NDArray[np.float64]:
        gaps = np.linalg.norm(self.points[:, word] - heard[word], axis=1)
        nearest = np.full(count, np.inf)
        np.minimum.at(nearest, meanings, gaps)
        weights = 1.0 / np.maximum(nearest, 1e-9)
        return np.asarray(weights / weights.sum())


def _sign_space(prototypes: Sequence[ArrayLike] | None) -> SignSpace:
    if prototypes is None:
        raise InvalidInputError("prototypes", 'strokes (the paper takes the signs "7", "8" and "9")', "none")
    return SignSpace(prototypes)


def _sign_points(space: SignSpace, demonstrations: DemonstrationSet) -> NDArray[np.float64]:
    """Embed all signs, shape (N, W, P)."""
    signs = [s for d in demonstrations for s in d.signs]
    return space.embed_all(signs).reshape(len(demonstrations), -1, len(space.prototypes))
