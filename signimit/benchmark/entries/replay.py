"""The nearest demonstration, replayed: what can be had without understanding anything."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.entries.following import Follower
from signimit.benchmark.protocol import Observation
from signimit.demonstrations import DemonstrationSet
from signimit.frames import on_table
from signimit.policies import make_policy
from signimit.signs import normalised_sign, pairwise_dtw


class Replay:
    """Draws again, at the same place on the table, what was shown when the most similar utterance was made.

    The likeness of two utterances is the sum of the dynamic time warping distances of their words. The path is replayed
    in the table frame because any other frame would be an object, and to choose one is to know the focus; velocities
    replayed from wherever the hand happens to start would draw at random places. Objects have no part in it.
    """

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Remember everything."""
        self._demonstrations = demonstrations
        words = range(len(demonstrations[0].signs))
        self._signs = [np.stack([normalised_sign(shown.signs[w]) for shown in demonstrations]) for w in words]

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Choose the demonstration with the nearest signs."""
        gaps = [
            pairwise_dtw(normalised_sign(sign)[None], known)[0] for sign, known in zip(signs, self._signs, strict=True)
        ]
        shown = self._demonstrations[int(np.sum(gaps, axis=0).argmin())]
        self._hand = Follower(on_table(make_policy([shown.hand], [shown.times]), np.zeros(2)))

    def act(self, observation: Observation) -> ArrayLike:
        """Follow the demonstrated path."""
        return self._hand.act(observation)
