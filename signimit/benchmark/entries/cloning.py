"""Behaviour cloning: its training samples, perceptron evaluation, and cloning by nearest neighbours.

A trained perceptron is evaluated without the library that trained it: a single input takes a tenth of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from signimit.benchmark.protocol import Observation
from signimit.demonstrations import DemonstrationSet
from signimit.policies.base import demonstrated_velocities
from signimit.signs import normalised_sign
from signimit.strokes import Stroke

SIGN_SAMPLES = 16  # points of a sign; a digit has no more than a few corners
NEIGHBOURS = 60
NEAR = 0.1  # m; a hand so far away counts as much as a mean gap of 1 between the points of a sign
Layer = tuple[NDArray[np.float64], NDArray[np.float64]]
Activation = Callable[[NDArray[np.float64]], NDArray[np.float64]]


class Moments(NamedTuple):
    """Training samples: M moments of N demonstrations.

    Attributes:
        demonstration: Which demonstration each belongs to, shape (M,).
        hand: Where the hand was, shape (M, 2), m, table frame.
        velocity: How it moved, shape (M, 2), m/s.
    """

    demonstration: NDArray[np.int64]
    hand: NDArray[np.float64]
    velocity: NDArray[np.float64]


def collect_moments(demonstrations: DemonstrationSet) -> Moments:
    """Gather all moments of all demonstrations."""
    velocity = [demonstrated_velocities(Stroke(shown.hand, shown.times)) for shown in demonstrations]
    numbers = np.repeat(np.arange(len(demonstrations)), [len(v) for v in velocity])
    return Moments(numbers, np.concatenate(demonstrations.paths), np.concatenate(velocity))


def utterance_features(signs: Sequence[ArrayLike]) -> NDArray[np.float64]:
    """Describe an utterance by the raw points of its signs, free of place and size, shape (W * 32,).

    The Euclidean distance of two descriptions is the root of Σ over words of the mean squared gap between points.
    """
    points = [normalised_sign(sign, SIGN_SAMPLES) for sign in signs]
    return np.asarray(np.stack(points).ravel() / np.sqrt(SIGN_SAMPLES))


def rectified(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute max(x, 0)."""
    return np.maximum(values, 0.0)


def sigmoid_weighted(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute x / (1 + exp(-x)), the SiLU."""
    return np.asarray(values / (1.0 + np.exp(-np.maximum(values, -500.0))))  # exp(500) is finite


def perceptron_output(
    layers: Sequence[Layer], values: NDArray[np.float64], activation: Activation
) -> NDArray[np.float64]:
    """Pass inputs through layers of which the last is linear.

    Args:
        layers: Weights (n_in, n_out) and biases (n_out,) of each.
        values: Inputs, shape (..., n_in of the first).
        activation: What comes after each layer but the last.

    Returns:
        Outputs, shape (..., n_out of the last).
    """
    for weights, bias in layers[:-1]:
        values = activation(values @ weights + bias)
    weights, bias = layers[-1]
    return np.asarray(values @ weights + bias)


class NearestNeighbourCloning:
    """Behaviour cloning by 60 nearest neighbours, weighted by similarity.

    Moments are alike if the signs are and if the hand is at a like place relative to an object; every moment is
    remembered once for each object, for it is not known which of them mattered. That is the strongest of the variants
    tried, see docs/benchmark_entries.md.
    """

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Store every moment."""
        moments = collect_moments(demonstrations)
        self._demonstration = moments.demonstration
        self._relative = moments.hand[:, None] - demonstrations.objects[moments.demonstration]  # (M, O, 2)
        self._velocity = np.repeat(moments.velocity, demonstrations.objects.shape[1], axis=0)
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
