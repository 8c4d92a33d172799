"""How alike two drawings are, in every pair of frames: the distance of the default learner.

Where the paper's Δ looks up the direction of motion at the nearest place and counts the reach as much as the drawing,
this distance leaves the reach out, measures in half sizes of the drawing, and asks for the best match in place,
direction and pace together. Real people's circles and rectangles, drawn in the same sense of rotation, differ in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.acceleration import find_twin
from signimit.learners.joint.reach import find_drawing_start
from signimit.paths import arc_lengths, box_centre, half_size, interpolate, unit_tangents

SAMPLES = 64
_TIME_SHARE = 0.6  # samples are spread evenly over this share of time and the rest of way: slow corners count more
_DIRECTION = 1.5  # weight of a unit direction against one half size of place
_PACE = 1.0  # weight of the logarithm of relative speed
_PAUSE = 0.15  # relative speed below which pace is not told apart
_BLOCK = 2**18  # numbers of a block of distances
_SECONDS = 1e-9  # that numpy takes for a pair of samples


class Drawing(NamedTuple):
    """A drawing, ready for comparison.

    Attributes:
        places: Sampled positions, shape (64, 2), m, table frame.
        manner: Weighted direction and pace at each, shape (64, 3), no unit.
        half_size: Half of the drawing's larger extent, m.
        centre: Middle of its bounding box, shape (2,), m, table frame.
    """

    places: NDArray[np.float64]
    manner: NDArray[np.float64]
    half_size: float
    centre: NDArray[np.float64]


def make_drawing(path: NDArray[np.float64], times: NDArray[np.float64]) -> Drawing:
    """Take the drawing out of a demonstrated path, shape (T, 2), m, with its times, shape (T,), s."""
    start = find_drawing_start(path)
    points, stamps = path[start:], times[start:]
    if not np.ptp(points, axis=0).any():
        points, stamps = path, times
    way = arc_lengths(points)
    clock = (1 - _TIME_SHARE) * way / way[-1] + _TIME_SHARE * (stamps - stamps[0]) / (stamps[-1] - stamps[0])
    even = np.linspace(0.0, 1.0, SAMPLES)
    places = interpolate(even, clock, points)
    pace = np.interp(even, clock, _log_pace(points, stamps))
    manner = np.column_stack([_DIRECTION * unit_tangents(places), _PACE * pace])
    return Drawing(places, manner, half_size(points), box_centre(points))


def _log_pace(points: NDArray[np.float64], times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Logarithm of the speed over its mean, lightly smoothed: a hand's jitter is not its pace."""
    if len(points) < 3:
        return np.zeros(len(points))
    speed = np.hypot(*np.gradient(points, times, axis=0).T)
    kernel = np.hanning(7)[1:-1]
    smooth = np.convolve(np.pad(speed, 2, "edge"), kernel / kernel.sum(), "valid")
    return np.asarray(np.log(smooth / smooth.mean() + _PAUSE))


def compare_drawings(traces: Sequence[Drawing], objects: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the distance of all drawings in all pairs of frames.

    Args:
        traces: N drawings.
        objects: Object positions, shape (N, O, 2), m, table frame.

    Returns:
        Mean distance to the best match, both ways averaged, shape (N, N, O, O), no unit;
        ``[t, k, i, j] == [k, t, j, i]``.
    """
    seconds = _SECONDS * (len(traces) * objects.shape[1] * SAMPLES) ** 2
    twin = find_twin("signimit.learners.joint.drawing_distance_numba", seconds)
    if twin is not None:
        return np.asarray(twin.drawing_distances(*_centred(traces, objects)))
    framed = _framed(traces, objects)
    one_way = np.stack([cross_distances(drawing, framed) for drawing in framed])
    return np.asarray((one_way + one_way.transpose(1, 0, 3, 2)) / 2)


def distances_to(
    trace: Drawing, objects: NDArray[np.float64], traces: Sequence[Drawing], places: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Compute the distances of one new drawing to N others, shape (N, O, O), ``[k, i, j]``: i is a frame of the new."""
    new, old = _framed([trace], objects[None]), _framed(traces, places)
    there = cross_distances(new[0], old)
    back = np.stack([cross_distances(other, new)[0] for other in old])
    return np.asarray((there + back.transpose(0, 2, 1)) / 2)


def _framed(traces: Sequence[Drawing], objects: NDArray[np.float64]) -> NDArray[np.float32]:
    """Features of each drawing from each object, shape (N, O, 64, 5)."""
    places = np.stack([t.places for t in traces])
    sizes = np.array([t.half_size for t in traces])
    manner = np.stack([t.manner for t in traces])
    local = (places[:, None] - objects[:, :, None]) / sizes[:, None, None, None]
    spread = np.broadcast_to(manner[:, None], (*local.shape[:3], manner.shape[-1]))
    return np.concatenate([local, spread], axis=-1).astype(np.float32)


def _centred(
    traces: Sequence[Drawing], objects: NDArray[np.float64]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Features of each drawing from its own centre, shape (N, 64, 5), and its centre from each object, (N, O, 2)."""
    centres = np.stack([t.centre for t in traces])
    sizes = np.array([t.half_size for t in traces])[:, None, None]
    offsets = (centres[:, None] - objects) / sizes
    return _framed(traces, centres[:, None])[:, 0], offsets.astype(np.float32)


def cross_distances(query: NDArray[np.float32], targets: NDArray[np.float32]) -> NDArray[np.float64]:
    """Mean distance from each point of a drawing to its best match in others.

    Args:
        query: One drawing in its frames, shape (O, 64, 5).
        targets: N drawings in their frames, shape (N, O', 64, 5).

    Returns:
        Shape (N, O, O').
    """
    frames, samples, features = query.shape
    asked = query.reshape(-1, features)
    asked_squares = (asked * asked).sum(axis=1)
    # |a - b|² = |a|² - 2 ab + |b|², of which one matrix product makes all but |a|². The best match is a minimum over
    # the target's samples, kept off the last axis where numpy would reduce it one short row at a time.
    factors = np.column_stack([-2.0 * asked, np.ones_like(asked_squares)]).T.copy()
    flat = targets.reshape(-1, samples, features)
    out = np.empty((len(flat), frames))
    step = max(1, _BLOCK // (samples * len(asked)))
    for start in range(0, len(flat), step):
        block = flat[start : start + step]
        squares = (block * block).sum(axis=2, keepdims=True)
        gaps = np.concatenate([block, squares], axis=2) @ factors  # small products: none is worth a thread of its own
        best = gaps.min(axis=1) + asked_squares
        best = np.sqrt(np.maximum(best, 0.0))
        out[start : start + step] = best.reshape(len(block), frames, samples).mean(axis=2)
    return np.asarray(out.reshape(targets.shape[0], targets.shape[1], frames).transpose(0, 2, 1))
