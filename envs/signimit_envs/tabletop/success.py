"""Has the hand done what was asked? A judge that is cheap enough to sit beside a running episode."""

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

WINDOW = 600  # samples of the past that count: 12 s
_FIRST, _BETWEEN = 75, 25  # control steps until the first look, and between looks
_ROOM = 1.3  # a glance rules out only what exceeds the tolerance by so much: it overlooks a little
_COMPLEX = np.array([1.0, 1.0j])  # x and y to one number
_THIN = 4  # one in so many points is enough for a glance


class PathRecord:
    """The latest positions of the hand."""

    def __init__(self) -> None:
        """Start empty."""
        self._buffer = np.empty((2 * WINDOW, 2))
        self._complex = self._buffer.view(np.complex128)[:, 0]
        self._count = 0

    def clear(self) -> None:
        """Forget everything."""
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
    """Watches one episode at a time and says when the request is fulfilled.

    A look costs a millisecond, a control step a tenth of one. So the judge glances twice a second at whether the hand
    does anything like what was asked for, looks closer if so, and compares with everything else that could have been
    meant only where the request seems fulfilled.
    """

    def __init__(self, templates: Sequence[Sequence[NDArray[np.float64]]]) -> None:
        """Take the drawings that show each movement, in the object's frame, m."""
        self._templates = templates
        self._prepared = prepare_templates(templates)
        self._sought, self._farthest = np.zeros(1, dtype=np.complex128), 0.0
        self._path = PathRecord()
        self._objects = np.zeros((0, 2))
        self._request = Request(0, 0)
        self._next = _FIRST
        self.performance = NOTHING

    def start(self, request: Request, objects: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin a new episode."""
        self._request, self._objects = request, objects
        drawing = self.drawing
        self._sought = (drawing.points[:: 2 * _THIN] + objects[request.focus]) @ _COMPLEX
        self._farthest = _ROOM * 2 * drawing.half_size * TOLERANCE
        self._path.clear()
        self._path.append(hand)
        self._next, self.performance = _FIRST, NOTHING

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
        self._next -= 1
        if self._next or self.performance.movement >= 0:
            return False
        self._next = _BETWEEN
        if self._requested_error() > TOLERANCE:
            return False
        performance = performed(self._path.latest, self._objects, self._templates)
        if (performance.movement, performance.focus) == self._request:
            self.performance = performance
        return self.done

    def _requested_error(self) -> float:
        """Misfit of the path so far to what was asked for, infinite where a glance rules it out."""
        if self._leaves_out_too_much():
            return np.inf
        tail = settled_part(self._path.latest)
        if tail is None:
            return np.inf
        return movement_error(tail - self._objects[self._request.focus], self._prepared[self._request.movement])

    def _leaves_out_too_much(self) -> bool:
        """Whether the hand passed so far from what should have been drawn that nothing else matters."""
        path = self._path.latest_complex
        gaps = np.abs(path[len(path) // 3 :: _THIN, None] - self._sought)
        return bool(gaps.min(axis=0).mean() > self._farthest)
