"""Success detection: whether the hand has fulfilled the request, checked while an episode runs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from signimit.evaluation import (
    NOTHING,
    TOLERANCE,
    Template,
    movement_error,
    performed,
    prepare_templates,
    settled_part,
)
from signimit.teaching.languages import Request

WINDOW = 600  # control steps of the past that are judged: 12 s
_FIRST_CHECK, _CHECK_PERIOD = 75, 25  # control steps until the first check (1.5 s), and between checks (0.5 s)
_COARSE_MARGIN = 1.3  # the coarse check uses few points: it rules out only what exceeds the tolerance by this factor
_COMPLEX = np.array([1.0, 1.0j])  # (x, y) @ _COMPLEX = x + iy: one distance is one complex modulus
_STRIDE = 4  # the coarse check takes every fourth position of the hand


class PathRecord:
    """Sliding window over the last `WINDOW` positions of the hand."""

    def __init__(self) -> None:
        """Start empty."""
        self._buffer = np.empty((2 * WINDOW, 2))
        self._complex = self._buffer.view(np.complex128)[:, 0]
        self._count = 0

    def clear(self) -> None:
        """Forget all positions."""
        self._count = 0

    def append(self, hand: NDArray[np.float64]) -> None:
        """Add a position, shape (2,), m."""
        if self._count == len(self._buffer):
            self._buffer[:WINDOW] = self._buffer[WINDOW:]
            self._count = WINDOW
        self._buffer[self._count] = hand
        self._count += 1

    @property
    def latest(self) -> NDArray[np.float64]:
        """Up to the last 600 positions, shape (T, 2), m; a view."""
        return self._buffer[max(0, self._count - WINDOW) : self._count]

    @property
    def latest_complex(self) -> NDArray[np.complex128]:
        """The same as x + iy, shape (T,); a view."""
        return self._complex[max(0, self._count - WINDOW) : self._count]


class SuccessDetector:
    """Detects the step at which the request of an episode is fulfilled, by `signimit.performed`.

    `signimit.performed` takes a millisecond, a control step a tenth of one. So twice a second a coarse check tells
    whether the hand passed near the requested drawing; if it did, the misfit to the request alone is computed; and
    only where that is within the tolerance, the path is compared with all movements about all objects.

    Attributes:
        performance: What was performed when the request was fulfilled; movement -1 before.
    """

    def __init__(self, templates: Sequence[Sequence[NDArray[np.float64]]]) -> None:
        """Prepare the drawings that show each movement, each (T, 2), m, in the object's frame."""
        self._templates = templates
        self._prepared = prepare_templates(templates)
        self._expected, self._max_gap = np.zeros(1, dtype=np.complex128), 0.0
        self._path = PathRecord()
        self._objects = np.zeros((0, 2))
        self._request = Request(0, 0)
        self._steps_to_check = _FIRST_CHECK
        self.performance = NOTHING

    def start(self, request: Request, objects: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin an episode with objects (O, 2) and the hand (2,), m, where it starts."""
        self._request, self._objects = request, objects
        drawing = self.drawing
        self._expected = (drawing.points[:: 2 * _STRIDE] + objects[request.focus]) @ _COMPLEX
        self._max_gap = _COARSE_MARGIN * 2 * drawing.half_size * TOLERANCE
        self._path.clear()
        self._path.append(hand)
        self._steps_to_check, self.performance = _FIRST_CHECK, NOTHING

    @property
    def drawing(self) -> Template:
        """How the requested movement was drawn, in the object's frame."""
        return self._prepared[self._request.movement][0]

    @property
    def done(self) -> bool:
        """Whether the request was fulfilled in this episode."""
        return self.performance.movement >= 0

    def watch(self, hand: NDArray[np.float64]) -> bool:
        """Take the next position of the hand, shape (2,), m; return whether just now the request was fulfilled."""
        self._path.append(hand)
        self._steps_to_check -= 1
        if self._steps_to_check or self.done:
            return False
        self._steps_to_check = _CHECK_PERIOD
        # Coarse check: mean distance of the requested drawing from the last two thirds of the path.
        path = self._path.latest_complex
        gaps = np.abs(path[len(path) // 3 :: _STRIDE, None] - self._expected)
        if gaps.min(axis=0).mean() > self._max_gap:
            return False
        # Misfit to the request alone.
        settled = settled_part(self._path.latest)
        if settled is None:
            return False
        movement, focus = self._request
        if movement_error(settled - self._objects[focus], self._prepared[movement]) > TOLERANCE:
            return False
        # All movements about all objects: is the request what was performed best?
        performance = performed(self._path.latest, self._objects, self._templates)
        if (performance.movement, performance.focus) == self._request:
            self.performance = performance
        return self.done
