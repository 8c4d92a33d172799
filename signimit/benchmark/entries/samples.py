"""What behaviour cloning learns from: every sampled moment of every demonstration, with the velocity of the hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.policies.base import demonstrated_velocities
from signimit.signs import normalised_sign
from signimit.strokes import Stroke

SIGN_SAMPLES = 16  # points of a sign; a digit has no more than a few corners


class Samples(NamedTuple):
    """M moments of N demonstrations.

    Attributes:
        demonstration: Which demonstration each belongs to, shape (M,).
        hand: Where the hand was, shape (M, 2), m, table frame.
        velocity: How it moved, shape (M, 2), m/s.
    """

    demonstration: NDArray[np.int64]
    hand: NDArray[np.float64]
    velocity: NDArray[np.float64]


def samples_of(demonstrations: DemonstrationSet) -> Samples:
    """Gather all moments of all demonstrations."""
    velocity = [demonstrated_velocities(Stroke(shown.hand, shown.times)) for shown in demonstrations]
    numbers = np.repeat(np.arange(len(demonstrations)), [len(v) for v in velocity])
    return Samples(numbers, np.concatenate(demonstrations.paths), np.concatenate(velocity))


def utterance_features(signs: Sequence[ArrayLike]) -> NDArray[np.float64]:
    """Describe an utterance by the raw points of its signs, free of place and size, shape (W * 32,).

    The Euclidean distance of two descriptions is the root of Σ over words of the mean squared gap between points.
    """
    points = [normalised_sign(sign, SIGN_SAMPLES) for sign in signs]
    return np.asarray(np.stack(points).ravel() / np.sqrt(SIGN_SAMPLES))
