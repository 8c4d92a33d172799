"""Everything that the joint learner measures of demonstrations: once, or extended by one more demonstration."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.learners.joint.drawing_dissimilarity import (
    DRAWINGS,
    Drawing,
    DrawingWeights,
    compare_drawings,
    describe_drawing,
)
from signimit.learners.joint.place_evidence import common_place_evidence
from signimit.learners.joint.sign_distance import cross_sign_distances, sign_distances, sign_features

Array = NDArray[np.float64]


class Measurements(NamedTuple):
    """All that the learner looks at; N demonstrations, C candidate places (here the objects), W words.

    Attributes:
        drawings: How unlike the drawings of two demonstrations are, shape (N, N), nats.
        sign_distances: Distances of signs at each place of the utterance, shape (W, N, N).
        offsets: Middle of each drawing from each candidate place, shape (N, C, 2), half sizes of the drawing.
        place_evidence: Evidence of each drawing's place for each candidate, shape (N, C), nats.
    """

    drawings: Array
    sign_distances: Array
    offsets: Array
    place_evidence: Array


class EarlierMeasurements(NamedTuple):
    """What the joint learner of version 0.1.0 measured; its models are read and shown, and measured anew to go on.

    Attributes:
        distances: Distances of drawings in all pairs of frames, shape (N, N, O, O).
        sign_distances: Distances of signs at each place of the utterance, shape (W, N, N).
        place_evidence: Evidence of each drawing's place for each object, shape (N, O), nats.
        scale: Typical log distances of equal drawings and signs in the session, shape (2,).
    """

    distances: Array
    sign_distances: Array
    place_evidence: Array
    scale: Array


def measure(demonstrations: DemonstrationSet, model: DrawingWeights = DRAWINGS) -> Measurements:
    """Measure a set of demonstrations; ``model`` says how unlike drawings are."""
    drawings = [describe_drawing(d.hand, d.times) for d in demonstrations]
    words = range(len(demonstrations[0].signs))
    signs = [sign_distances(sign_features([d.signs[w] for d in demonstrations])) for w in words]
    return Measurements(
        compare_drawings(drawings, model=model), np.stack(signs), *_places(drawings, demonstrations.objects)
    )


def extend_measurements(
    demonstrations: DemonstrationSet, known: Measurements, model: DrawingWeights = DRAWINGS
) -> Measurements:
    """Add the last demonstration to the measurements of all before it; N new comparisons are made.

    Args:
        demonstrations: N + 1, the new one last.
        known: Measurements of the first N.
        model: Says how unlike drawings are.
    """
    count, words = len(demonstrations) - 1, len(demonstrations[0].signs)
    drawings = [describe_drawing(d.hand, d.times) for d in demonstrations]
    unlike, signs = np.zeros((count + 1, count + 1)), np.zeros((words, count + 1, count + 1))
    unlike[:-1, :-1], signs[:, :-1, :-1] = known.drawings, known.sign_distances
    unlike[-1] = unlike[:, -1] = compare_drawings(drawings[-1:], drawings, model)[0]
    for word in range(words):
        features = sign_features([d.signs[word] for d in demonstrations])
        signs[word, -1, :-1] = signs[word, :-1, -1] = cross_sign_distances(features[count:], features[:count])[0]
    return Measurements(unlike, signs, *_places(drawings, demonstrations.objects))


def _places(drawings: list[Drawing], places: Array) -> tuple[Array, Array]:
    centres = np.stack([d.centre for d in drawings])
    units = np.array([d.half_size for d in drawings])[:, None, None]
    return (centres[:, None] - places) / units, common_place_evidence(centres, places)
