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
_FIRST, _BETWEEN = 75, 25  # control steps until the first look, and between looks
_NEAR = 1.3  # tolerances: beyond, with room for what a glance overlooks, no exact look is needed
_COMPLEX = np.array([1.0, 1.0j])  # x and y to one number
_THIN = 4  # one in so many points is enough for a glance


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

    A look costs a millisecond, a control step a tenth of one. So the judge glances twice a second at whether the hand
    does anything like what was asked for; if so it looks five times a second; and it compares with everything else that
    could have been meant once, when the request seems fulfilled.
    """

    def __init__(self, templates: Sequence[Sequence[NDArray[np.float64]]]) -> None:
        """Take the drawings that show each movement, in the object's frame, m."""
        self._templates = templates
        self._prepared = prepare_templates(templates)
        self._thinned = [(d[0].points[::_THIN] @ _COMPLEX, d[0].half_size) for d in self._prepared]
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
        self._next = _BETWEEN
        if self._requested_error() > TOLERANCE:
            return False
        performance = performed(self._path.latest, self._objects, self._templates)
        if (performance.movement, performance.focus) == self._request:
            self.performance = performance
        return self.done

    def _requested_error(self) -> float:
        """Misfit of the path so far to what was asked for, infinite where a glance rules it out."""
        tail = settled_part(self._path.latest)
        if tail is None:
            return np.inf
        tail = tail - self._objects[self._request.focus]
        if _least_error(tail, self._thinned[self._request.movement]) > _NEAR * TOLERANCE:
            return np.inf
        return movement_error(tail, self._prepared[self._request.movement])


def _least_error(tail: NDArray[np.float64], drawing: tuple[NDArray[np.complex128], float]) -> float:
    """Mean gaps there and back between one in so many points, in half sizes: the misfit without directions."""
    points, half_size = drawing
    gaps = np.abs((tail[::_THIN] @ _COMPLEX)[:, None] - points)
    return float(gaps.min(axis=1).mean() + gaps.min(axis=0).mean()) / (2 * half_size)
