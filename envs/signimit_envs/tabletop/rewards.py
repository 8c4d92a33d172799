"""Rewards: sparse as the benchmark counts success, or dense with potential-based shaping."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.evaluation import Template

_PASS_RADIUS = 0.25  # half sizes of the drawing; a point this near to the hand is passed
_MIN_COSINE = 0.5  # between the directions of hand and drawing, for the hand to go the drawing's way
_COVERAGE_SHARE = 0.75  # of the potential; the rest is closeness
_MIN_MOTION = 1e-5  # m a control step; a slower hand has no direction
_COMPLEX = np.array([1.0, 1.0j])  # (x, y) @ _COMPLEX = x + iy


class Potential:
    """Potential Φ in [0, 1] of an episode: how much of the requested movement is done.

    Φ = 3/4 coverage + 1/4 closeness. Coverage is the share of the points of the requested movement, drawn about the
    requested object, that the hand has passed in this episode, within a quarter of the drawing's half size and going
    the drawing's way. Closeness is h / (h + d), where d is the hand's distance from the nearest point of that drawing
    and h its half size.
    """

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> float:
        """Begin an episode.

        Args:
            drawing: Drawing of the requested movement, in the object's frame.
            place: Position of the requested object, shape (2,), m, table frame.
            hand: Position of the hand at the start, shape (2,), m.

        Returns:
            Φ of the start.
        """
        self._points = (drawing.points + place) @ _COMPLEX
        self._headings = drawing.directions @ _COMPLEX.conj()  # conjugate: multiplied, it gives the angle
        self._half_size = drawing.half_size
        self._passed = np.zeros(len(self._points), dtype=np.bool_)
        self._hand = complex(*hand.tolist())
        return self._value(np.abs(self._points - self._hand))

    def move(self, hand: NDArray[np.float64]) -> float:
        """Take the next position of the hand, shape (2,), m; return Φ."""
        before, self._hand = self._hand, complex(*hand.tolist())
        gaps = np.abs(self._points - self._hand)
        motion = self._hand - before
        if abs(motion) > _MIN_MOTION:
            along = (self._headings * (motion / abs(motion))).real >= _MIN_COSINE
            self._passed |= along & (gaps <= _PASS_RADIUS * self._half_size)
        return self._value(gaps)

    def _value(self, gaps: NDArray[np.float64]) -> float:
        closeness = self._half_size / (self._half_size + float(gaps.min()))
        return _COVERAGE_SHARE * float(self._passed.mean()) + (1 - _COVERAGE_SHARE) * closeness


class Reward(Protocol):
    """Reward of the steps of an environment."""

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin an episode; arguments as of `Potential.start`."""
        ...

    def of_step(self, hand: NDArray[np.float64], fulfilled: bool, over: bool) -> float:
        """Return the reward of a control step.

        Args:
            hand: Position of the hand after the step, shape (2,), m.
            fulfilled: Whether this step fulfilled the request for the first time.
            over: Whether the episode terminated.
        """
        ...


class SparseReward:
    """1 at the step where the request is first seen to be fulfilled, else 0."""

    def __init__(self, discount: float) -> None:
        """Take no notice of the discount."""

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin an episode; nothing is kept."""

    def of_step(self, hand: NDArray[np.float64], fulfilled: bool, over: bool) -> float:
        """Return 1 or 0."""
        return float(fulfilled)


class DenseReward:
    """The sparse reward plus F = γ Φ(s') - Φ(s), which leaves optimal policies as they are.

    Source: A. Ng, D. Harada and S. Russell, ICML 1999. The shaping of an episode of T steps adds up, discounted by γ,
    to γ^T Φ(s_T) - Φ(s_0) for any actions between. Φ of a terminal state is 0 (M. Grzes, AAMAS 2017); an episode
    that is truncated does not end, so the potential of its last state counts. Φ remembers the path, as the sparse
    reward does: the state is that of the episode, not of the arm alone.
    """

    def __init__(self, discount: float) -> None:
        """Shape with the agent's discount γ, in [0, 1]."""
        self._discount = discount
        self._potential = Potential()
        self._before = 0.0

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin an episode."""
        self._before = self._potential.start(drawing, place, hand)

    def of_step(self, hand: NDArray[np.float64], fulfilled: bool, over: bool) -> float:
        """Return the sparse reward and the shaping."""
        after = 0.0 if over else self._potential.move(hand)
        shaping = self._discount * after - self._before
        self._before = after
        return float(fulfilled) + shaping


REWARDS: Mapping[str, Callable[[float], Reward]] = {"sparse": SparseReward, "dense": DenseReward}


def make_reward(name: str, discount: float) -> Reward:
    """Return a reward by its name in `REWARDS`.

    Raises:
        UnknownNameError: If there is no reward of that name.
        InvalidInputError: If the discount is not in [0, 1].
    """
    if name not in REWARDS:
        raise UnknownNameError("reward", name, REWARDS)
    if not 0.0 <= discount <= 1.0:  # no comparison holds for NaN
        raise InvalidInputError("discount", "0 to 1", f"{discount!r}")
    return REWARDS[name](discount)
