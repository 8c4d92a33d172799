"""Has the hand done what was asked? A judge that is cheap enough to sit beside a running episode."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from signimit.evaluation import (
    NOTHING,
    TOLERANCE,
    movement_error,
    performed,
    prepare_templates,
    settled_part,
)
from signimit.languages import Request

WINDOW = 600  # samples of the past that count: 12 s
_FIRST, _CLOSE, _FAR = 75, 10, 25  # control steps until the first look, and between looks when close to done and not


class PathRecord:
    """The latest positions of the hand."""

    def __init__(self) -> None:
        """Start empty."""
        self._buffer = np.empty((2 * WINDOW, 2))
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


class Judge:
    """Watches one episode at a time and says when the request is fulfilled.

    Looking costs half a millisecond, a control step a tenth of one. So the judge looks only at what was asked for,
    five times a second when the hand is close to it and else twice, and tells everything once, when it is done.
    """

    def __init__(self, templates: Sequence[Sequence[NDArray[np.float64]]]) -> None:
        """Take the drawings that show each movement, in the object's frame, m."""
        self._templates = templates
        self._prepared = prepare_templates(templates)
        self._path = PathRecord()
        self._objects = np.zeros((0, 2))
        self._request = Request(0, 0)
        self._next = _FIRST
        self.performance = NOTHING

    def start(self, request: Request, objects: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin a new episode."""
        self._request, self._objects = request, objects
        self._path.clear()
        self._path.append(hand)
        self._next, self.performance = _FIRST, NOTHING

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
        error = self._requested_error()
        self._next = _CLOSE if error < 2 * TOLERANCE else _FAR
        if error > TOLERANCE:
            return False
        performance = performed(self._path.latest, self._objects, self._templates)
        if (performance.movement, performance.focus) == self._request:
            self.performance = performance
        return self.done

    def _requested_error(self) -> float:
        """Misfit of the path so far to what was asked for, infinite where a glance is enough to rule it out."""
        tail = settled_part(self._path.latest)
        if tail is None:
            return np.inf
        tail = tail - self._objects[self._request.focus]
        drawings = self._prepared[self._request.movement]
        # No point of a drawing lies outside a square twice its half size wide: a lower bound of the misfit.
        size = max(drawing.half_size for drawing in drawings)
        outside = np.abs(tail).max(axis=1) - size
        if outside.clip(0.0).mean() > 2 * size * TOLERANCE:
            return np.inf
        return movement_error(tail, drawings)
