"""Chance: somebody who draws something that was shown about something that lies there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.entries.following import Follower
from signimit.benchmark.entries.imitator import certain_reading
from signimit.benchmark.protocol import Kit
from signimit.demonstrations import DemonstrationSet
from signimit.grouping import canonical_labels
from signimit.inference import WordOrder
from signimit.learners.base import Reading, Understanding
from signimit.learners.joint.drawing_distance import make_drawing
from signimit.policies import make_policy


class Chance(Follower):
    """Guesses everything, and moves well.

    It takes as many movements as objects for granted, for want of a better number. What it draws is a random
    demonstration of the group that it guesses, the middle of the drawing put on the object that it guesses.

    Attributes:
        understanding: Guesses.
        reading: A guess.
    """

    understanding: Understanding
    reading: Reading

    def __init__(self, kit: Kit) -> None:
        """Take the die."""
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
        policy = make_policy([shown.hand - make_drawing(shown.hand, shown.times).centre], [shown.times])
        self.follow(policy.at(objects[focus]))
