"""The default policy: follow the course that the demonstrations share, at their speed, from anywhere.

Control by maneuver regulation (Hauser and Hindman 1995): the phase is observed from the hand, not counted by a clock, so
a hand that is held or pushed is not left behind. Near the course the velocity is that of the demonstrators plus a pull;
far from it the hand goes straight to the nearest place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError
from signimit.policies.arclength import interpolate
from signimit.policies.course import Course, learn_course
from signimit.policies.protocol import CONTROL_PERIOD, Array, check_hand
from signimit.policies.storage import StoredPolicy
from signimit.strokes import Stroke

STRIDE = 2  # nodes that a hand passes in one control period
PULL = 15.0  # 1/s
NEAR, LOST = 0.2, 0.4  # in half sizes: closer, the phase moves on; further, it is looked for everywhere
LOOK_AROUND = 8  # nodes about the expected phase among which a near hand's phase is sought
LOYALTY = 0.3  # in node steps squared: how much the observed phase is held to the expected one
SLOWEST, FASTEST = (
    0.1,
    2.0,
)  # of the mean speed, m/s: a pause is shortened to the one, a glitch slowed to the other
BLOCK = 1024  # hands at once: their table of gaps stays in the cache


class PhaseState(NamedTuple):
    """Where hands are in the movement.

    Attributes:
        nodes: Expected node of each hand, shape () or (B,); None as long as no hand was seen.
    """

    nodes: NDArray[np.int64] | None = None


@dataclass(frozen=True, eq=False)
class PathFollowingPolicy(StoredPolicy):
    """Follow a course whose nodes are half a control period apart.

    Attributes:
        course: Positions at equal steps of time, shape (M, 2), m, object's frame.
        closed: Whether the course goes round (1) or ends at the last node, a goal (0).
        scale: Half size of the movement, m.
        reach_speed: Speed on the way to the course, m/s.
    """

    kind: ClassVar[str] = "path-following"
    course: Array
    closed: float
    scale: float
    reach_speed: float
    _ahead: Array = field(init=False, repr=False)
    _plane: NDArray[np.float32] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the course and prepare its velocities."""
        super().__post_init__()
        if self.course.ndim != 2 or self.course.shape[1] != 2 or len(self.course) < 2:
            raise InvalidInputError("policy: course", "shape (M, 2)", f"shape {self.course.shape}")
        object.__setattr__(
            self,
            "_ahead",
            (self.course[self._onward(np.arange(len(self.course)))] - self.course) / CONTROL_PERIOD,
        )
        half_squares = (self.course**2).sum(axis=1) / 2
        object.__setattr__(self, "_plane", np.vstack([-self.course.T, half_squares]).astype(np.float32))

    @classmethod
    def learn(cls, demonstrations: Sequence[Stroke]) -> Self:
        """Find the shared course and lay it out in time."""
        course = learn_course(demonstrations)
        return cls(time_course(course), float(course.closed), course.scale, course.reach_speed)

    def start(self) -> PhaseState:
        """Return the state of hands not seen yet."""
        return PhaseState()

    def step(self, state: PhaseState, hand: ArrayLike) -> tuple[PhaseState, Array]:
        """Return the next state and velocities, shape of ``hand``, m/s, for the next control period."""
        hands = check_hand(hand)
        flat = hands.reshape(-1, 2)
        nodes = self._nearest(flat) if state.nodes is None else self._observe(state.nodes, flat)
        velocity, near = self._velocity(nodes, flat)
        onward = np.where(near, self._onward(nodes), nodes)
        return PhaseState(onward.reshape(hands.shape[:-1])), velocity.reshape(hands.shape)

    def __call__(self, hand: ArrayLike) -> Array:
        """Return velocities, shape of ``hand``, m/s, from the nearest place of the course, whatever was before."""
        hands = check_hand(hand)
        flat = hands.reshape(-1, 2)
        return self._velocity(self._nearest(flat), flat)[0].reshape(hands.shape)

    def _onward(self, nodes: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the node one control period later."""
        return (
            (nodes + STRIDE) % len(self.course)
            if self.closed
            else np.minimum(nodes + STRIDE, len(self.course) - 1)
        )

    def _nearest(self, hands: Array) -> NDArray[np.int64]:
        """Return the nearest node of all: the least of |p|² / 2 - p · x, one product and one search."""
        if len(hands) <= BLOCK:
            return (hands.astype(np.float32) @ self._plane[:2] + self._plane[2]).argmin(axis=1)
        return np.concatenate([self._nearest(hands[i : i + BLOCK]) for i in range(0, len(hands), BLOCK)])

    def _observe(self, expected: NDArray[np.int64], hands: Array) -> NDArray[np.int64]:
        """Return the node that each hand is at: near the expected one, or anywhere if it is lost."""
        expected = expected.reshape(-1)
        if len(expected) != len(hands):
            raise InvalidInputError("hand", f"the {len(expected)} hands of the state", f"{len(hands)}")
        around = expected[:, None] + _OFFSETS
        around = around % len(self.course) if self.closed else np.clip(around, 0, len(self.course) - 1)
        gaps = self.course[around] - hands[:, None]
        squares = np.einsum("bwd,bwd->bw", gaps, gaps)
        stride = self.reach_speed * CONTROL_PERIOD / STRIDE
        best = (squares + _HELD * stride**2).argmin(axis=1)
        rows = np.arange(len(hands))
        nodes = around[rows, best]
        lost = squares[rows, best] > (LOST * self.scale) ** 2
        if lost.any():
            nodes[lost] = self._nearest(hands[lost])
        return nodes

    def _velocity(self, nodes: NDArray[np.int64], hands: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return velocities, and which hands are near enough for the phase to move on."""
        gap = self.course[nodes] - hands
        distance = np.sqrt(np.einsum("bd,bd->b", gap, gap))
        follow = 1.0 / (1.0 + (distance / (NEAR * self.scale)) ** 4)
        pull = np.minimum(PULL, self.reach_speed / np.maximum(distance, 1e-9))
        return follow[:, None] * self._ahead[nodes] + pull[:, None] * gap, follow > 0.5


_OFFSETS = np.arange(-LOOK_AROUND, LOOK_AROUND + 1)
_HELD = LOYALTY * _OFFSETS.astype(np.float64) ** 2


def time_course(course: Course) -> Array:
    """Lay a course out in time: positions half a control period apart, at the mean speed shown at each place."""
    line = np.concatenate([course.points, course.points[:1]]) if course.closed else course.points
    steps = np.hypot(*np.diff(line, axis=0).T)
    durations = _smooth(course.durations, course.closed)[: len(steps)]
    mean = steps.sum() / max(durations.sum(), 1e-9)
    durations = np.clip(durations, steps / FASTEST, steps / (SLOWEST * mean))
    clock = np.concatenate([[0.0], np.cumsum(durations)])
    count = max(int(round(clock[-1] * STRIDE / CONTROL_PERIOD)), 2 * STRIDE)
    even = np.linspace(0.0, clock[-1], count + 1)
    return interpolate(even[:-1] if course.closed else even, clock, line)


def _smooth(durations: Array, closed: bool) -> Array:
    """Average over five nodes: less is the grid's noise, more would blur the slowing at corners."""
    padded = np.pad(durations, 2, mode="wrap" if closed else "edge")
    return np.convolve(padded, np.full(5, 0.2), mode="valid")
