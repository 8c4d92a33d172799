"""What a learner concludes from demonstrations, and the protocol that every learner keeps to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.inference import WordOrder


@one_line
class Belief(NamedTuple):
    """How sure a learner is of what it concluded.

    Attributes:
        focus_probability: Of each object in each demonstration, given all other conclusions, shape (N, O).
        movement_probability: Of each movement found, and last of none of them, shape (N, K + 1).
        word_order_evidence: How well each word order explains the demonstrations, shape (W, W), nats: focus word, then
            movement word; -inf where an order is impossible.
    """

    focus_probability: NDArray[np.float64]
    movement_probability: NDArray[np.float64]
    word_order_evidence: NDArray[np.float64]


class Evidence(Protocol):
    """What a learner measured and keeps with its conclusions: a NamedTuple of arrays, another for each learner.

    Fields are called as in model files; what was not measured is None.
    """

    def _asdict(self) -> dict[str, Any]: ...


@one_line
class Asked(NamedTuple):
    """What the words of each demonstration ask for, which need not be what was done.

    Attributes:
        movement: Shape (N,), numbers of movements.
        focus: Shape (N,), numbers of objects.
    """

    movement: NDArray[np.int64]
    focus: NDArray[np.int64]


@one_line
class Understanding(NamedTuple):
    """Everything that was inferred.

    Attributes:
        labels: Movement of each demonstration, shape (N,), 0, 1, ... in order of first appearance; -1 where it is none
            that the others show.
        focus: Object each demonstration was about, shape (N,); -1 where it was about none.
        word_order: Which word of the utterance names the object and which the movement.
        belief: Probabilities, where the learner has any.
        evidence: What the learner measured, where it keeps anything.
        asked: What was asked for, where the learner tells that from what was done.
        trust: Probability that a demonstration was meant as it looks, shape (N,), where the learner has any.
    """

    labels: NDArray[np.int64]
    focus: NDArray[np.int64]
    word_order: WordOrder
    belief: Belief | None = None
    evidence: Evidence | None = None
    asked: Asked | None = None
    trust: NDArray[np.float64] | None = None

    @property
    def requests(self) -> Asked:
        """What the words of each demonstration ask for: what was done, unless the learner tells more."""
        return self.asked or Asked(self.labels, self.focus)

    @property
    def diagnostics(self) -> Mapping[str, NDArray[Any]]:
        """All arrays of the evidence and the belief by name, for a reader's eyes; programs take the typed records."""
        records = [record._asdict() for record in (self.evidence, self.belief) if record is not None]
        return MappingProxyType({k: v for record in records for k, v in record.items() if v is not None})


@one_line
class Reading(NamedTuple):
    """What an utterance asks for.

    Attributes:
        movement: Probability of each movement, shape (K,).
        focus: Probability of each object, shape (O,).
        known: Probability that both words are signs that were taught.
    """

    movement: NDArray[np.float64]
    focus: NDArray[np.float64]
    known: float = 1.0


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

    def extend(self, demonstrations: DemonstrationSet, understanding: Understanding) -> Understanding | None:
        """Infer from all demonstrations, given what was understood of all but the last; None if the method cannot."""
        return None

    def reader(
        self, demonstrations: DemonstrationSet, prototypes: Sequence[ArrayLike] | None, understanding: Understanding
    ) -> SignReader:
        """Make the reader of new utterances; it depends on nothing else, so that a saved model can make it again."""
        ...

    def restore_evidence(self, demonstrations: DemonstrationSet, arrays: Mapping[str, NDArray[Any]]) -> Evidence | None:
        """Make the evidence again from the arrays of a model file, by the names of its fields.

        Raises:
            KeyError: If an array is missing that the reader needs.
            InvalidInputError: If one does not fit the demonstrations.
        """
        ...
