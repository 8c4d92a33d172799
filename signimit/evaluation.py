"""What a performed path was, about which object, and how well (paper, section III). For evaluators, not learners."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.paths import (
    half_size,
    headings,
    nearest_distances,
    nearest_points,
    resample_path,
    step_lengths,
    unit_tangents,
)
from signimit.validation import finite_array, item_list, moving_points

TOLERANCE = 0.35  # misfit up to which a path counts as a movement, in half sizes of what was shown
SETTLED = 2 / 3  # the last share of a path that is judged: by then the reach is over
LEAST_WAY = 0.2  # m; a hand that moved less has performed nothing
_DIRECTION_WEIGHT = 0.25
_PATH_SAMPLES, _TEMPLATE_SAMPLES = 200, 120
_COVERED = 0.25  # half sizes within which a point of the template counts as visited


class Performance(NamedTuple):
    """What was performed.

    Attributes:
        movement: Number of the movement, -1 for none of them.
        focus: Number of the object, -1 for none.
        misfit: Misfit of the best candidate, in half sizes of the shown drawing: half of the mean gaps there and
            back, plus a quarter of the mean of 1 - cos of the angle between directions. Infinite if the hand rested.
        coverage: Share of the shown drawing, in [0, 1], that the path came near to.
        turns: Signed revolutions of the whole path about the candidate object, counter-clockwise positive.
    """

    movement: int
    focus: int
    misfit: float
    coverage: float
    turns: float

    @property
    def path_error(self) -> float:
        """The misfit, by the name that it had in version 0.1.0."""
        return self.misfit


NOTHING = Performance(-1, -1, float("inf"), 0.0, 0.0)


class Template(NamedTuple):
    """A shown drawing, ready for comparison: resampled points, unit directions and half size."""

    points: NDArray[np.float64]
    directions: NDArray[np.float64]
    half_size: float


def make_template(loop: ArrayLike) -> Template:
    """Prepare one shown drawing, shape (T, 2), m, in the object's frame."""
    points = moving_points(loop, "template")
    resampled = resample_path(points, _TEMPLATE_SAMPLES)
    return Template(resampled, unit_tangents(resampled), half_size(points))


def performed(path: ArrayLike, objects: ArrayLike, templates: Sequence[Sequence[ArrayLike]]) -> Performance:
    """Say which movement a path performed about which object (paper, section III).

    The last two thirds of the path are compared with every drawing of every movement about every object; a
    movement's error is the mean of its two best drawings, the smallest error wins.

    Args:
        path: Hand positions, shape (T, 2), m, table frame.
        objects: Object positions, shape (O, 2), m, table frame.
        templates: For each movement the drawings that show it, each of shape (T, 2), m, in the object's frame.

    Returns:
        The best candidate; movement and focus are -1 if its error is above 0.35.

    Raises:
        InvalidInputError: If an array is not finite or has another shape, or a movement has no drawing.
    """
    hand, places = finite_array(path, "path", (None, 2)), finite_array(objects, "objects", (None, 2))
    prepared = prepare_templates(templates)
    tail = settled_part(hand)
    if tail is None or not len(places):
        return NOTHING
    scored = [
        (movement_error(tail - place, drawings), m, f)
        for m, drawings in enumerate(prepared)
        for f, place in enumerate(places)
    ]
    error, m, f = min(scored)
    coverage = max(_coverage(tail - places[f], drawing) for drawing in prepared[m])
    turns = count_turns(hand, places[f])
    return Performance(*((m, f) if error <= TOLERANCE else (-1, -1)), error, coverage, turns)


def prepare_templates(templates: Sequence[Sequence[ArrayLike]]) -> list[list[Template]]:
    """Prepare the drawings of every movement.

    Raises:
        InvalidInputError: If there is no movement, or one has no drawing.
    """
    return [
        [make_template(loop) for loop in item_list(drawings, f"templates of movement {m}")]
        for m, drawings in enumerate(item_list(templates, "templates"))
    ]


def settled_part(path: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the part of a path that is judged, resampled to (200, 2), or None if the hand rested in it."""
    tail = path[int(len(path) * (1 - SETTLED) + 1e-9) :]
    if len(tail) < 2 or step_lengths(tail).sum() < LEAST_WAY:
        return None
    return resample_path(tail, _PATH_SAMPLES)


def movement_error(tail: NDArray[np.float64], drawings: Sequence[Template]) -> float:
    """Return the misfit of a settled path, in the object's frame, to a movement: mean of its two best drawings."""
    return float(np.mean(sorted(_misfit(tail, drawing) for drawing in drawings)[:2]))


def _misfit(tail: NDArray[np.float64], drawing: Template) -> float:
    there = nearest_points(tail, drawing.points)
    gap_there = np.hypot(*(tail - drawing.points[there]).T).mean()
    gap_back = nearest_distances(drawing.points, tail).mean()
    cosines = (unit_tangents(tail) * drawing.directions[there]).sum(axis=1)
    gaps = (gap_there + gap_back) / (2 * drawing.half_size)
    return float(gaps + _DIRECTION_WEIGHT * (1 - cosines).mean())


def _coverage(tail: NDArray[np.float64], drawing: Template) -> float:
    return float((nearest_distances(drawing.points, tail) <= _COVERED * drawing.half_size).mean())


def count_turns(path: ArrayLike, centre: ArrayLike) -> float:
    """Count the signed revolutions of a path, shape (T, 2), about a point, counter-clockwise positive."""
    seen = finite_array(path, "path", (None, 2)) - finite_array(centre, "centre", (2,))
    return float(np.diff(np.unwrap(headings(seen))).sum() / (2 * np.pi)) if len(seen) else 0.0
