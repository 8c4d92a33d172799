"""All distances that the joint learner looks at: measured at once, or extended by one demonstration."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.learners.joint.drawing_distance import compare_drawings, distances_to, make_drawing
from signimit.learners.joint.place_evidence import common_place_evidence
from signimit.learners.joint.sign_distance import cross_sign_distances, sign_distances, sign_features


class Distances(NamedTuple):
    """All that the learner looks at.

    Attributes:
        drawings: Distances of drawings in all pairs of frames, shape (N, N, O, O).
        signs: Distances of signs at each place of the utterance, shape (W, N, N).
        place: Evidence of each drawing's place for each object, shape (N, O), nats.
    """

    drawings: NDArray[np.float64]
    signs: NDArray[np.float64]
    place: NDArray[np.float64]


def measure_distances(demonstrations: DemonstrationSet) -> Distances:
    """Measure all distances of a set of demonstrations."""
    traces = [make_drawing(d.hand, d.times) for d in demonstrations]
    objects = demonstrations.objects
    words = len(demonstrations[0].signs)
    signs = [sign_distances(sign_features([d.signs[w] for d in demonstrations])) for w in range(words)]
    place = common_place_evidence(np.stack([t.centre for t in traces]), objects)
    return Distances(compare_drawings(traces, objects), np.stack(signs), place)


def extend_distances(demonstrations: DemonstrationSet, known: Distances) -> Distances:
    """Add the last demonstration to the distances of all before it; N new distances are measured.

    Args:
        demonstrations: N + 1, the new one last.
        known: Distances of the first N.

    Returns:
        Distances of all N + 1; the evidence of places is as for all together.
    """
    count, frames = len(demonstrations) - 1, demonstrations.objects.shape[1]
    words = len(demonstrations[0].signs)
    drawings, signs = np.zeros((count + 1, count + 1, frames, frames)), np.zeros((words, count + 1, count + 1))
    drawings[:-1, :-1], signs[:, :-1, :-1] = known.drawings, known.signs
    traces, objects = [make_drawing(d.hand, d.times) for d in demonstrations], demonstrations.objects
    gaps = distances_to(traces[-1], objects[-1], traces[:-1], objects[:-1])
    drawings[-1, :-1], drawings[:-1, -1] = gaps, gaps.transpose(0, 2, 1)
    drawings[-1, -1] = compare_drawings(traces[-1:], objects[-1:])[0, 0]
    for word in range(words):
        features = sign_features([d.signs[word] for d in demonstrations])
        signs[word, -1, :-1] = signs[word, :-1, -1] = cross_sign_distances(features[count:], features[:count])[0]
    return Distances(drawings, signs, common_place_evidence(np.stack([t.centre for t in traces]), objects))
