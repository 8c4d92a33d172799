"""The seam between learners and the model: what is concluded from demonstrations, and how signs are read afterwards."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.inference import WordOrder


class Understanding(NamedTuple):
    """Everything that was inferred.

    Attributes:
        labels: Movement of each demonstration, shape (N,), 0, 1, ... in order of first appearance.
        focus: Object each demonstration was about, shape (N,).
        word_order: Which word of the utterance names the object and which the movement.
        diagnostics: Arrays that show why, by name.
    """

    labels: NDArray[np.int64]
    focus: NDArray[np.int64]
    word_order: WordOrder
    diagnostics: dict[str, NDArray[Any]]


class Reading(NamedTuple):
    """What an utterance asks for.

    Attributes:
        movement: Probability of each movement, shape (K,).
        focus: Probability of each object, shape (O,).
    """

    movement: NDArray[np.float64]
    focus: NDArray[np.float64]


class SignReader(Protocol):
    """Turns an utterance into a `Reading`."""

    def read(self, signs: Sequence[ArrayLike]) -> Reading:
        """Read W signs, each of shape (T_s, 2)."""
        ...


class Learner(Protocol):
    """A method of understanding demonstrations; ``signimit.learners`` has one module for each."""

    def infer(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, rng: np.random.Generator
    ) -> Understanding:
        """Infer movements, foci and word order."""
        ...

    def reader(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, understanding: Understanding
    ) -> SignReader:
        """Make the reader of new utterances; it depends on nothing else, so that a saved model can make it again."""
        ...


@runtime_checkable
class IncrementalLearner(Protocol):
    """A learner that takes one demonstration after another."""

    def extend(self, demonstrations: DemonstrationSet, understanding: Understanding) -> Understanding:
        """Infer from all demonstrations, given what was understood of all but the last."""
        ...
