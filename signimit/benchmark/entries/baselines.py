"""Baselines without inference: chance, and the replay of the demonstration with the nearest signs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.entries.imitator import Follower, certain_reading
from signimit.benchmark.protocol import Kit
from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.grouping import canonical_labels
from signimit.inference import WordOrder
from signimit.learners.base import Reading, Understanding
from signimit.paths import box_centre
from signimit.policies import make_policy
from signimit.segmentation import find_drawing
from signimit.signs import normalised_sign, pairwise_dtw

Place = NDArray[np.float64]


def _middle(shown: Demonstration) -> Place:
    """Middle of the drawing in a demonstration, shape (2,), m, table frame."""
    return box_centre(shown.hand[find_drawing(shown.hand, shown.times)])


class Chance(Follower):
    """Baseline at chance level: guesses groups, foci, word order and readings, and follows a good policy.

    It takes as many movements as objects for granted, for want of a better number. What it draws is a random
    demonstration of the group that it guesses, the middle of the drawing put on the object that it guesses.

    Attributes:
        understanding: Guesses.
        reading: A guess.
    """

    understanding: Understanding
    reading: Reading

    def __init__(self, kit: Kit) -> None:
        """Store the session's random generator."""
        self._rng = kit.rng

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Guess groups, foci and word order."""
        self._demonstrations = demonstrations
        count, objects, words = len(demonstrations), demonstrations.objects.shape[1], len(demonstrations[0].signs)
        labels = canonical_labels(self._rng.integers(0, objects, count))
        order = np.resize(self._rng.permutation(words), 2)  # one word is both
        focus = self._rng.integers(0, objects, count)
        self.understanding = Understanding(labels, focus, WordOrder(int(order[0]), int(order[1])))

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Guess a movement and an object."""
        labels = self.understanding.labels
        movements = int(labels.max()) + 1
        movement, focus = int(self._rng.integers(movements)), int(self._rng.integers(len(objects)))
        self.reading = certain_reading(movement, focus, movements, len(objects))
        shown = self._demonstrations[int(self._rng.choice(np.flatnonzero(labels == movement)))]
        policy = make_policy([shown.hand - _middle(shown)], [shown.times])
        self.follow(policy.at(objects[focus]))


class Replay(Follower):
    """Baseline that redraws, at the same place on the table, the demonstration with the most similar utterance.

    The likeness of two utterances is the sum of the dynamic time warping distances of their words. The path is replayed
    in the table frame because any other frame would be an object's, and to choose one is to guess the focus; velocities
    replayed from the start of the hand would draw at random places. Objects have no part in it.
    """

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Store the demonstrations and their normalised signs."""
        self._demonstrations = demonstrations
        words = range(len(demonstrations[0].signs))
        self._signs = [np.stack([normalised_sign(shown.signs[w]) for shown in demonstrations]) for w in words]

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Choose the demonstration with the nearest signs."""
        gaps = [
            pairwise_dtw(normalised_sign(sign)[None], known)[0] for sign, known in zip(signs, self._signs, strict=True)
        ]
        shown = self._demonstrations[int(np.sum(gaps, axis=0).argmin())]
        there, here = self._origins(shown, objects)
        self.follow(make_policy([shown.hand - there], [shown.times]).at(here))

    def _origins(self, shown: Demonstration, objects: NDArray[np.float64]) -> tuple[Place, Place]:
        """Return the origin of the path when it was shown, and its origin now, each (2,), m."""
        return np.zeros(2), np.zeros(2)


class ReplayNearby(Replay):
    """Baseline that redraws the demonstration with the most similar utterance about the object it was nearest to.

    It takes nearness for focus, and needs nothing else to obey a pair that was shown. It has no idea of words.
    """

    def _origins(self, shown: Demonstration, objects: NDArray[np.float64]) -> tuple[Place, Place]:
        nearest = int(np.linalg.norm(shown.objects - _middle(shown), axis=1).argmin())
        return shown.objects[nearest], objects[nearest]
