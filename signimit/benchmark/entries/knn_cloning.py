"""Behaviour cloning by nearest neighbours: in a moment like this one, the hand moved so."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from signimit.benchmark.entries.samples import samples_of, utterance_features
from signimit.benchmark.protocol import Observation
from signimit.demonstrations import DemonstrationSet

NEIGHBOURS = 60
NEAR = 0.1  # m; a hand so far away counts as much as a mean gap of 1 between the points of a sign


class NearestNeighbourCloning:
    """Moves as the hand did in the 60 most similar moments, the more similar the more it counts.

    Moments are alike if the signs are and if the hand is at a like place relative to an object; every moment is
    remembered once for each object, for nobody knows which of them mattered. That is the strongest of the variants
    tried, see docs/benchmark_entries.md.
    """

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Remember every moment."""
        samples = samples_of(demonstrations)
        self._demonstration = samples.demonstration
        self._relative = samples.hand[:, None] - demonstrations.objects[samples.demonstration]  # (M, O, 2)
        self._velocity = np.repeat(samples.velocity, demonstrations.objects.shape[1], axis=0)
        self._signs = np.stack([utterance_features(signs) for signs in demonstrations.signs])

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Put all moments where they would be among these objects, and away from the table by how unlike the signs are.

        Distances in these three dimensions are those in the space of signs and places.
        """
        unlike = np.linalg.norm(self._signs - utterance_features(signs), axis=1)[self._demonstration]
        places = (self._relative + objects).reshape(-1, 2) / NEAR
        self._tree = cKDTree(np.column_stack([places, np.repeat(unlike, len(objects))]))

    def act(self, observation: Observation) -> ArrayLike:
        """Return the mean velocity of the nearest moments, weighted by the inverse squared distance."""
        count = min(NEIGHBOURS, len(self._velocity))
        gaps, nearest = self._tree.query((*(observation.hand / NEAR), 0.0), k=count)
        weights = 1.0 / np.maximum(gaps, 1e-3) ** 2
        return np.asarray(weights @ self._velocity[nearest] / weights.sum())
