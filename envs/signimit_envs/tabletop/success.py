"""Success detection: whether the hand has fulfilled the request, checked while an episode runs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from signimit.evaluation import NOTHING, PathJudge, Performance, Template
from signimit.teaching.languages import Request

WINDOW = 600  # control steps of the past that are judged: 12 s
_FIRST_CHECK, _CHECK_PERIOD = 75, 25  # control steps until the first check (1.5 s), and between checks (0.5 s)
_COARSE_GAP = 0.75  # half sizes within which the coarse check takes a point of the drawing as passed
_COARSE_COVERAGE = 0.9  # share of these points below which the coarse check rules the request out
_MIN_MOTION = 1e-3  # m between checks; a slower hand rests, and nothing is checked
_COMPLEX = np.array([1.0, 1.0j])  # (x, y) @ _COMPLEX = x + iy: one distance is one complex modulus
_STRIDE = 4  # the coarse check takes every fourth position of the hand and point of the drawing


class PathRecord:
    """Sliding window over the last `WINDOW` positions of the hand."""

    def __init__(self) -> None:
        """Start empty."""
        self._buffer = np.empty((2 * WINDOW, 2))
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
        return self.latest.view(np.complex128)[:, 0]


class SuccessDetector:
    """Detects the step at which the request of an episode is fulfilled, by `signimit.performed`.

    `signimit.performed` takes milliseconds, a control step a tenth of one. So twice a second a coarse check tells
    whether the hand has been everywhere along the requested drawing; if it has, the path is compared with the requested
    movement about the requested object alone; and only where it counts as that, with all movements about all objects.

    Attributes:
        performance: Performance at the latest check; `NOTHING` where the coarse check ruled the request out.
        success_performance: Performance at the check that found the request fulfilled; `NOTHING` before.
    """

    def __init__(self, templates: Sequence[Sequence[NDArray[np.float64]]]) -> None:
        """Prepare the drawings that show each movement, each (T, 2), m, in the object's frame."""
        self._judge = PathJudge(templates)
        self._expected, self._max_gap = np.zeros(1, dtype=np.complex128), 0.0
        self._path = PathRecord()
        self._objects = np.zeros((0, 2))
        self._request = Request(0, 0)
        self._steps_to_check = _FIRST_CHECK
        self.performance, self.success_performance = NOTHING, NOTHING

    def start(self, request: Request, objects: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin an episode with objects (O, 2) and the hand (2,), m, where it starts."""
        self._request, self._objects = request, objects
        drawing = self.drawing
        self._expected = (drawing.points[::_STRIDE] + objects[request.focus]) @ _COMPLEX
        self._max_gap = _COARSE_GAP * drawing.half_size
        self._path.clear()
        self._path.append(hand)
        self._steps_to_check = _FIRST_CHECK
        self.performance, self.success_performance = NOTHING, NOTHING

    @property
    def drawing(self) -> Template:
        """How the requested movement was drawn, in the object's frame."""
        return self._judge.templates[int(np.argmax(self._judge.movement == self._request.movement))]

    @property
    def done(self) -> bool:
        """Whether the request was fulfilled in this episode."""
        return self.success_performance.movement >= 0

    def watch(self, hand: NDArray[np.float64]) -> bool:
        """Take the next position of the hand, shape (2,), m; return whether just now the request was fulfilled."""
        self._path.append(hand)
        self._steps_to_check -= 1
        if self._steps_to_check:
            return False
        self._steps_to_check = _CHECK_PERIOD
        if np.abs(np.diff(self._path.latest_complex[-_CHECK_PERIOD - 1 :])).sum() < _MIN_MOTION:
            return False
        self.performance = self._check()
        if self.done or (self.performance.movement, self.performance.focus) != self._request:
            return False
        self.success_performance = self.performance
        return True

    def _check(self) -> Performance:
        # Coarse check: share of the requested drawing that the hand has been near.
        gaps = np.abs(self._path.latest_complex[::_STRIDE, None] - self._expected)
        if (gaps.min(axis=0) <= self._max_gap).mean() < _COARSE_COVERAGE:
            return NOTHING
        # The request alone.
        movement, focus = self._request
        asked = self._judge.judge(self._path.latest, self._objects[focus : focus + 1], [movement])
        if asked.movement < 0:
            return asked
        if self.done:
            return asked._replace(focus=focus)
        # All movements about all objects: is the request what was performed best?
        return self._judge.judge(self._path.latest, self._objects)
