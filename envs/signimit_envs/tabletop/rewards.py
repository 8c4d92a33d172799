"""What a step is worth: sparse as the benchmark counts it, or with potential-based shaping besides."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.evaluation import Template

_PASSED = 0.25  # half sizes of the drawing within which a point of it counts as passed, as for the judge's coverage
_ALONG = 0.5  # cosine between the hand's way and the drawing's from which they go the same way
_COVERAGE_SHARE = 0.75  # of the potential; the rest is closeness
_THIN = 2  # one in so many points of the drawing is enough
_STILL = 1e-5  # m; who moves less in a control step goes no way
_COMPLEX = np.array([1.0, 1.0j])  # x and y to one number


class Potential:
    """How far along an episode is, Φ in [0, 1].

    Φ = 3/4 coverage + 1/4 closeness. Coverage is the share of the points of the requested movement, drawn about the
    requested object, that the hand has passed in this episode, within a quarter of the drawing's half size and going
    the drawing's way. Closeness is h / (h + d), where d is the hand's distance from the nearest point of that drawing
    and h its half size.
    """

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> float:
        """Begin an episode.

        Args:
            drawing: How the requested movement is drawn, in the object's frame.
            place: Where the requested object is, shape (2,), m.
            hand: Where the hand starts, shape (2,), m.

        Returns:
            Φ of the start.
        """
        self._points = (drawing.points[::_THIN] + place) @ _COMPLEX
        self._headings = drawing.directions[::_THIN] @ _COMPLEX.conj()  # conjugate: multiplied, it gives the angle
        self._half_size = drawing.half_size
        self._passed = np.zeros(len(self._points), dtype=np.bool_)
        self._hand = complex(*hand.tolist())
        return self._value(np.abs(self._points - self._hand))

    def move(self, hand: NDArray[np.float64]) -> float:
        """Take the next position of the hand, shape (2,), m; return Φ."""
        before, self._hand = self._hand, complex(*hand.tolist())
        gaps = np.abs(self._points - self._hand)
        way = self._hand - before
        if abs(way) > _STILL:
            along = (self._headings * (way / abs(way))).real >= _ALONG
            self._passed |= along & (gaps <= _PASSED * self._half_size)
        return self._value(gaps)

    def _value(self, gaps: NDArray[np.float64]) -> float:
        closeness = self._half_size / (self._half_size + float(gaps.min()))
        return _COVERAGE_SHARE * float(self._passed.mean()) + (1 - _COVERAGE_SHARE) * closeness


class Reward(Protocol):
    """Says what steps are worth."""

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Begin an episode; arguments as of `Potential.start`."""
        ...

    def of_step(self, hand: NDArray[np.float64], fulfilled: bool, over: bool) -> float:
        """Value the step that took the hand, shape (2,), m, where it is.

        Args:
            hand: Where the hand is now.
            fulfilled: Whether the request was seen to be fulfilled just now.
            over: Whether the episode terminated.
        """
        ...


class SparseReward:
    """1 where the request is seen to be fulfilled for the first time, else 0."""

    def __init__(self, discount: float) -> None:
        """Need no discount."""

    def start(self, drawing: Template, place: NDArray[np.float64], hand: NDArray[np.float64]) -> None:
        """Remember nothing."""

    def of_step(self, hand: NDArray[np.float64], fulfilled: bool, over: bool) -> float:
        """Return 1 or 0."""
        return float(fulfilled)


class DenseReward:
    """The sparse reward plus F = γ Φ(s') - Φ(s), which leaves optimal policies as they are.

    Source: A. Ng, D. Harada and S. Russell, ICML 1999. The shaping of an episode of T steps adds up, discounted by γ,
    to γ^T Φ(s_T) - Φ(s_0), whatever was done between. Φ of a terminal state is 0 (M. Grzes, AAMAS 2017); an episode
    that is truncated does not end, so the potential of its last state counts. Φ remembers the path, as the sparse
    reward does: the state is that of the episode, not of the arm alone.
    """

    def __init__(self, discount: float) -> None:
        """Shape with the discount γ that the agent has."""
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
    """Return a reward by its name.

    Raises:
        UnknownNameError: If there is none of that name.
        InvalidInputError: If the discount is not in [0, 1].
    """
    if name not in REWARDS:
        raise UnknownNameError("reward", name, REWARDS)
    if not 0.0 <= discount <= 1.0:  # no comparison holds for NaN
        raise InvalidInputError("discount", "0 to 1", f"{discount!r}")
    return REWARDS[name](discount)
