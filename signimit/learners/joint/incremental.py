"""One more demonstration: its distances to those seen before are measured, theirs among each other are kept."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.learners.joint.drawing_distance import compare_drawings, distances_to, make_drawing
from signimit.learners.joint.place_evidence import common_place_evidence
from signimit.learners.joint.sign_distance import cross_sign_distances, sign_features
from signimit.validation import finite_array


def extended_distances(
    demonstrations: DemonstrationSet, known: dict[str, NDArray[Any]]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Add the last demonstration to the distances of all before it; N new distances are measured.

    Args:
        demonstrations: N + 1, the new one last.
        known: Diagnostics of the joint learner for the first N.

    Returns:
        Distances of drawings, shape (N+1, N+1, O, O), of signs, shape (W, N+1, N+1), and the evidence of places,
        shape (N+1, O), as for all together.

    Raises:
        InvalidInputError: If the diagnostics are not those of N demonstrations.
    """
    count, frames = len(demonstrations) - 1, demonstrations.objects.shape[1]
    words = len(demonstrations[0].signs)
    for name in ("distances", "sign_distances"):
        if name not in known:
            raise InvalidInputError("diagnostics", f"{name}, which the joint learner measures", "none")
    drawings, signs = np.zeros((count + 1, count + 1, frames, frames)), np.zeros((words, count + 1, count + 1))
    drawings[:-1, :-1] = finite_array(known["distances"], "distances", (count, count, frames, frames))
    signs[:, :-1, :-1] = finite_array(known["sign_distances"], "sign distances", (words, count, count))
    traces, objects = [make_drawing(d.hand, d.times) for d in demonstrations], demonstrations.objects
    gaps = distances_to(traces[-1], objects[-1], traces[:-1], objects[:-1])
    drawings[-1, :-1], drawings[:-1, -1] = gaps, gaps.transpose(0, 2, 1)
    drawings[-1, -1] = compare_drawings(traces[-1:], objects[-1:])[0, 0]
    for word in range(words):
        features = sign_features([d.signs[word] for d in demonstrations])
        signs[word, -1, :-1] = signs[word, :-1, -1] = cross_sign_distances(features[count:], features[:count])[0]
    return drawings, signs, common_place_evidence(np.stack([t.centre for t in traces]), objects)
