"""Behaviour cloning by a multilayer perceptron: signs, objects and hand in, velocity out. Needs scikit-learn."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.entries.cloning import (
    collect_moments,
    perceptron_output,
    rectified,
    utterance_features,
)
from signimit.benchmark.protocol import Kit, Observation
from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import MissingDependencyError

try:
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.neural_network import MLPRegressor
except ImportError:
    raise MissingDependencyError("scikit-learn", "study", "The entry clone-mlp") from None

HIDDEN = (128, 128)
EPOCHS = 20
COPIES = 3  # of each moment, two of them disturbed
ASTRAY = 0.03  # m, standard deviation of a disturbance of the hand
PULL = 2.0  # 1/s, how fast a hand that is astray goes back
SIGN_NOISE = 0.1  # of the first principal component's spread
COMPONENTS = 8  # principal components of signs
SPEED = 0.35  # m/s, brings velocities to the order of 1
NEAR = 0.15  # m, brings places to the order of 1


class PerceptronCloning:
    """Perceptron with two hidden layers of 128, from signs and the hand's place among all objects to its velocity.

    Signs come in as principal components; inputs are standardised. Moments are also learned from hands a little astray
    that go back, so that errors do not grow (Laskey et al., DART, CoRL 2017). Neither the last velocity nor the time
    is an input: with them the perceptron continues its own errors and draws nothing, see docs/benchmark_entries.md.
    """

    def __init__(self, kit: Kit) -> None:
        """Store the session's random generator."""
        self._rng = kit.rng

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Train the perceptron."""
        signs = np.stack([utterance_features(words) for words in demonstrations.signs])
        self._mean_sign = signs.mean(axis=0)
        components = np.linalg.svd(signs - self._mean_sign, full_matrices=False)[2][:COMPONENTS].T
        self._components = components / ((signs @ components).std(axis=0).max() or 1.0)
        codes = (signs - self._mean_sign) @ self._components
        moments = collect_moments(demonstrations)
        which, hand, velocity = (np.concatenate([part] * COPIES) for part in moments)
        astray = self._rng.normal(0.0, ASTRAY, hand.shape)
        astray[: len(moments.hand)] = 0.0  # the first copy is undisturbed
        code = codes[which] + self._rng.normal(0.0, SIGN_NOISE, (len(which), codes.shape[1]))
        inputs = _inputs(code, hand + astray, demonstrations.objects[which])
        outputs = (velocity - PULL * astray) / SPEED
        self._mean, self._scale = inputs.mean(axis=0), inputs.std(axis=0) + 1e-9
        seed = int(self._rng.integers(2**31))
        network = MLPRegressor(
            hidden_layer_sizes=HIDDEN, max_iter=EPOCHS, batch_size=256, learning_rate_init=2e-3, random_state=seed
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)  # so many epochs are meant
            network.fit((inputs - self._mean) / self._scale, outputs)
        self._layers = list(zip(network.coefs_, network.intercepts_, strict=True))

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Encode the signs."""
        self._code = (utterance_features(signs) - self._mean_sign)[None] @ self._components
        self._objects = objects[None]

    def act(self, observation: Observation) -> ArrayLike:
        """Evaluate the perceptron."""
        inputs = _inputs(self._code, observation.hand[None], self._objects)[0]
        return SPEED * perceptron_output(self._layers, (inputs - self._mean) / self._scale, rectified)


def _inputs(code: NDArray[np.float64], hand: NDArray[np.float64], objects: NDArray[np.float64]) -> NDArray[np.float64]:
    """Join sign codes (M, C) and the places of M hands among O objects each, shape (M, C + 2 * O)."""
    return np.column_stack([code, ((hand[:, None] - objects) / NEAR).reshape(len(hand), -1)])
