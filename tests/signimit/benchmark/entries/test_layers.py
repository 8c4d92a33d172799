"""The layers compute what scikit-learn's perceptron does."""

import numpy as np
import pytest

from signimit.benchmark.entries.layers import perceptron_output, rectified, sigmoid_weighted


def test_one_linear_layer_is_an_affine_map() -> None:
    weights, bias = np.array([[1.0, 2.0], [3.0, -1.0]]), np.array([0.5, 0.0])
    assert np.array_equal(perceptron_output([(weights, bias)], np.array([1.0, -2.0]), rectified), [-4.5, 4.0])


def test_between_layers_what_is_negative_is_cut_off() -> None:
    layers = [(np.array([[1.0, -1.0]]), np.zeros(2)), (np.array([[2.0], [5.0]]), np.zeros(1))]
    assert np.array_equal(perceptron_output(layers, np.array([[3.0], [-3.0]]), rectified), [[6.0], [15.0]])


def test_the_sigmoid_weighted_unit_is_finite_everywhere() -> None:
    values = sigmoid_weighted(np.array([-1e6, -1.0, 0.0, 1.0, 1e6]))
    np.testing.assert_allclose(values, [0.0, -0.2689414213699951, 0.0, 0.7310585786300049, 1e6], atol=1e-12)


def test_it_is_what_scikit_learn_computes() -> None:
    networks = pytest.importorskip("sklearn.neural_network", reason="scikit-learn is not installed")
    rng = np.random.default_rng(0)
    inputs = rng.normal(size=(100, 3))
    network = networks.MLPRegressor(hidden_layer_sizes=(8, 8), max_iter=300, random_state=0, tol=1e-2)
    network.fit(inputs, inputs[:, :2] ** 2)
    layers = list(zip(network.coefs_, network.intercepts_, strict=True))
    np.testing.assert_allclose(perceptron_output(layers, inputs, rectified), network.predict(inputs), atol=1e-9)
