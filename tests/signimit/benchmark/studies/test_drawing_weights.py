"""Weights of features of drawings are fitted to who drew what, each source counting as much as it should."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.benchmark.studies.drawing_weights import (
    DRAWN,
    STRANGERS_WEIGHT,
    DrawingPairs,
    area_under_curve,
    compare_people,
    fit_drawing_weights,
)
from signimit.exceptions import InvalidInputError
from signimit.learners.joint.drawing_dissimilarity import DRAWINGS, FEATURES, DrawingWeights
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.people import synthetic_library
from signimit.teaching.people.relabelling import renamed

LABELS = ("zigzag", "star", "square")


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


@pytest.fixture(scope="module")
def library() -> StrokeLibrary:
    return synthetic_library(LABELS, writers=2, samples=8, rng=rng())


def noisy_pairs(count: int, seed: int, weight: float = 1.0) -> DrawingPairs:
    """Two features say something about a pair: 2 nats and -1 nat a unit; the offset is 0.5."""
    random = np.random.default_rng(seed)
    features = random.normal(size=(count, len(FEATURES))) * np.linspace(0.5, 3, len(FEATURES))
    unlike = 2 * features[:, 0] - features[:, 5] + 0.5
    return DrawingPairs("planted", features, random.random(count) > 1 / (1 + np.exp(-unlike)), weight)


def test_planted_weights_are_found_whatever_the_units() -> None:
    pairs = noisy_pairs(20_000, 1)
    found = fit_drawing_weights([pairs], penalty=1e-6)
    wanted = np.zeros(len(FEATURES))
    wanted[[0, 5]] = 2, -1
    np.testing.assert_allclose(found.weights, wanted, atol=0.15)
    again = fit_drawing_weights([pairs._replace(features=1000 * pairs.features + 7)], penalty=1e-6)
    np.testing.assert_allclose(1000 * again.weights, found.weights, rtol=1e-3, atol=1e-3)
    assert again.offset + 7 * again.weights.sum() == pytest.approx(found.offset, abs=1e-3)


def slow_loss(pairs: list[DrawingPairs], weights: NDArray[np.float64], offset: float) -> float:
    """Mean over sources of the mean loss of their equal and of their different pairs, each a half."""
    loss = 0.0
    for one in pairs:
        unlike = one.features @ weights + offset
        halves = np.log1p(np.exp(unlike[one.equal])).mean() + np.log1p(np.exp(-unlike[~one.equal])).mean()
        loss += one.weight * halves / 2
    return loss / sum(one.weight for one in pairs)


def test_the_fit_is_where_the_loss_of_sources_by_their_weights_is_least() -> None:
    pairs = [noisy_pairs(300, 2, weight=6.0), noisy_pairs(40, 3)._replace(features=noisy_pairs(40, 4).features)]
    found = fit_drawing_weights(pairs, penalty=0.0)
    least = slow_loss(pairs, found.weights, found.offset)
    for number in range(len(FEATURES)):
        for step in (-0.05, 0.05):
            moved = found.weights + step * np.eye(len(FEATURES))[number]
            assert slow_loss(pairs, moved, found.offset) > least
    assert min(slow_loss(pairs, found.weights, found.offset + step) for step in (-0.05, 0.05)) > least


def test_a_penalty_makes_weights_smaller_and_a_constant_feature_says_nothing() -> None:
    pairs = noisy_pairs(500, 5)
    pairs.features[:, 3] = 4.0
    free, bound = (fit_drawing_weights([pairs], penalty).weights for penalty in (1e-6, 0.2))
    assert np.linalg.norm(bound) < 0.5 * np.linalg.norm(free)
    assert free[3] == bound[3] == 0.0


def test_each_writer_is_compared_alone_and_every_label_counts_six_times(library: StrokeLibrary) -> None:
    people = compare_people(library, rng())
    assert [one.source for one in people] == ["synthetic synthetic 1", "synthetic synthetic 2"]
    drawn = DRAWN * len(LABELS)
    for one in people:
        assert one.weight == 1.0
        assert len(one.equal) == drawn * (drawn - 1) / 2
        assert one.equal.sum() == len(LABELS) * DRAWN * (DRAWN - 1) / 2


def test_circles_and_triangles_are_also_made_the_other_way() -> None:
    """A circle is two things, a triangle four: upside down, and each way round."""
    drawn = synthetic_library(("circle", "triangle up"), samples=2, rng=rng())
    for library in (drawn, renamed(drawn, {"triangle up": "triangle"})):
        (pairs,) = compare_people(library, rng())
        assert pairs.equal.sum() == 5  # circle, circle the other way, triangle up, down, up the other way
    already = synthetic_library(("circle", "circle, other way"), samples=2, rng=rng())
    assert compare_people(already, rng())[0].equal.sum() == 2


def test_strangers_are_compared_together_whichever_way_they_draw() -> None:
    made = synthetic_library(("circle", "star", "zigzag"), writers=4, samples=1, rng=rng())
    writers = tuple(f"player {i}" for i in range(len(made)))
    library = StrokeLibrary(made.strokes, made.labels, writers, "players")
    (pairs,) = compare_people(library, rng())
    assert (pairs.source, pairs.weight, len(pairs.equal)) == ("players strangers", STRANGERS_WEIGHT, 66)
    flipped = [
        Stroke(s.points * [-1, 1], s.times) if label == "circle" else s
        for s, label in zip(made, made.labels, strict=True)
    ]
    (again,) = compare_people(StrokeLibrary(flipped, made.labels, writers, "players"), rng())
    np.testing.assert_allclose(again.features, pairs.features, atol=1e-9)
    (fewer,) = compare_people(library, rng(), without=("star",))
    assert len(fewer.equal) == 28


def test_weights_of_some_people_tell_the_drawings_of_others_apart(library: StrokeLibrary) -> None:
    one, other = compare_people(library, rng())
    assert area_under_curve(other, fit_drawing_weights([one])) > 0.97
    assert area_under_curve(other, DRAWINGS) > 0.97


def test_the_area_under_the_curve_counts_ties_half() -> None:
    features = np.zeros((4, len(FEATURES)))
    features[:, 0] = 0, 1, 1, 2
    pairs = DrawingPairs("by hand", features, np.array([True, True, False, False]))
    model = DrawingWeights(np.eye(len(FEATURES))[0], 3.0)
    assert area_under_curve(pairs, model) == 3.5 / 4
    assert area_under_curve(pairs, model._replace(weights=-model.weights)) == 0.5 / 4


@pytest.mark.parametrize("labels", [("star",), ("star", "zigzag")])
def test_who_drew_too_little_is_told(labels: tuple[str, ...]) -> None:
    drawn = synthetic_library(labels, samples=3 if len(labels) == 1 else 1, rng=rng())
    with pytest.raises(InvalidInputError, match="drawings of synthetic strangers: expected several of one thing, and"):
        compare_people(drawn, rng())
