"""What behaviour cloning learns from, and cloning by nearest neighbours."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.benchmark.entries import refer_to
from signimit.benchmark.entries.cloning import (
    NEAR,
    NEIGHBOURS,
    SIGN_SAMPLES,
    collect_moments,
    perceptron_output,
    rectified,
    sigmoid_weighted,
    utterance_features,
)
from signimit.benchmark.protocol import Observation
from signimit.benchmark.running import SessionTask, run_task
from signimit.signs import normalised_sign
from signimit.teaching.sessions import Session


def test_every_moment_of_every_demonstration_is_there(paper_session: Session) -> None:
    demonstrations = paper_session.demonstrations
    samples = collect_moments(demonstrations)
    for number, shown in enumerate(demonstrations):
        own = samples.demonstration == number
        assert np.array_equal(samples.hand[own], shown.hand)
        moved = (samples.velocity[own][:-1] + samples.velocity[own][1:]) / 2 * np.diff(shown.times)[:, None]
        np.testing.assert_allclose(shown.hand[0] + moved.sum(axis=0), shown.hand[-1], atol=0.02)


def test_an_utterance_is_described_free_of_place_and_size(paper_session: Session) -> None:
    signs = paper_session.demonstrations[0].signs
    moved = [3.0 * sign + 7.0 for sign in signs]
    np.testing.assert_allclose(utterance_features(moved), utterance_features(signs), atol=1e-9)


def test_the_distance_of_utterances_is_that_of_their_points(paper_session: Session) -> None:
    a, b = (paper_session.demonstrations[i].signs for i in (0, 1))
    points = [(normalised_sign(x, SIGN_SAMPLES), normalised_sign(y, SIGN_SAMPLES)) for x, y in zip(a, b, strict=True)]
    expected = sum(((x - y) ** 2).sum(axis=1).mean() for x, y in points)
    assert np.isclose(np.linalg.norm(utterance_features(a) - utterance_features(b)) ** 2, expected)


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


def test_the_velocity_is_the_weighted_mean_of_the_most_similar_moments(paper_session: Session, observed: Any) -> None:
    entry, command = observed("clone-knn", paper_session), paper_session.commands[0]
    entry.begin(command.signs, command.objects)
    given = entry.act(Observation(command.hand, np.zeros(2), 0.0))
    np.testing.assert_allclose(given, _by_definition(paper_session, command), atol=1e-9)


def _by_definition(session: Session, command: Any) -> NDArray[np.float64]:
    samples, moments = collect_moments(session.demonstrations), []
    asked = utterance_features(command.signs)
    unlike = [np.linalg.norm(utterance_features(shown.signs) - asked) for shown in session.demonstrations]
    for demonstration, hand, velocity in zip(*samples, strict=True):
        for there, here in zip(session.demonstrations[int(demonstration)].objects, command.objects, strict=True):
            x, y = (hand - there) - (command.hand - here)
            moments.append((math.hypot(unlike[demonstration], x / NEAR, y / NEAR), *velocity))
    nearest = np.array(sorted(moments)[:NEIGHBOURS])
    return np.asarray(np.average(nearest[:, 1:], axis=0, weights=nearest[:, 0] ** -2.0))


def test_pairs_that_were_shown_are_obeyed_more_often_than_by_chance_and_no_other() -> None:
    shown, unseen = (run_task(SessionTask(refer_to("clone-knn"), split, 0)) for split in ("paper", "unseen-pair"))
    assert sum(shown["obeyed"]) > 1  # chance asks one of nine
    assert sum(unseen["obeyed"]) == 0
