"""The default policy: follow the course that the demonstrations share, at their speed, from anywhere.

Control by maneuver regulation (Hauser and Hindman 1995): the phase is observed from the hand, not counted by a clock,
so a hand that is held or pushed is not left behind. Near the course the velocity is that of the demonstrators plus a
pull; far from it the hand goes straight to the nearest place.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError
from signimit.policies.base import CONTROL_PERIOD, Array, StoredPolicy, check_hand, frozen
from signimit.policies.reference_path.reference_path import learn_reference_path
from signimit.policies.reference_path.timing import time_course
from signimit.strokes import Stroke

PULL = 15.0  # 1/s
SURE = 0.05  # half sizes; a hand so close to the expected place is taken to be there
NEAR = 0.12  # half sizes; closer, the phase moves on and the demonstrators' velocity counts
LOST = 0.4  # half sizes; further, the phase is looked for everywhere
LOOK_AROUND = 4  # nodes about the expected one, the phases of a hand that is neither sure nor lost
ENTRY = 0.25  # of a way that ends at a goal: from afar it is entered there, not at the goal
BLOCK = 512  # hands at once: their table of gaps stays in the cache


class PhaseState(NamedTuple):
    """Where hands are in the movement.

    Attributes:
        nodes: Expected node: a number for one hand, shape (B,) for many; None as long as no hand was seen.
    """

    nodes: int | NDArray[np.int64] | None = None


@dataclass(frozen=True, eq=False, repr=False)
class PathFollowingPolicy(StoredPolicy):
    """Follow a course whose nodes are one control period apart.

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
    _rows: tuple[tuple[float, ...], ...] = field(init=False, repr=False)
    _plane: NDArray[np.float32] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the course and prepare its velocities."""
        super().__post_init__()
        if self.course.ndim != 2 or self.course.shape[1] != 2 or len(self.course) < 2:
            raise InvalidInputError("policy: course", "shape (M, 2)", f"shape {self.course.shape}")
        if not (0 < self.scale < np.inf and 0 < self.reach_speed < np.inf):
            raise InvalidInputError("policy: scale, speed", "positive", f"{self.scale}, {self.reach_speed}")
        onward = self._onward(np.arange(len(self.course)))
        ahead = frozen((self.course[onward] - self.course) / CONTROL_PERIOD)
        half_squares = (self.course**2).sum(axis=1) / 2
        object.__setattr__(self, "_ahead", ahead)
        object.__setattr__(self, "_rows", tuple(map(tuple, np.hstack([self.course, ahead]).tolist())))
        object.__setattr__(self, "_plane", np.vstack([-self.course.T, half_squares]).astype(np.float32))

    @classmethod
    def learn(cls, demonstrations: Sequence[Stroke]) -> Self:
        """Find the shared course and lay it out in time."""
        course = learn_reference_path(demonstrations)
        return cls(time_course(course), float(course.closed), course.scale, course.reach_speed)

    def start(self) -> PhaseState:
        """Return the state of hands not seen yet."""
        return PhaseState()

    def step(self, state: PhaseState, hand: ArrayLike) -> tuple[PhaseState, Array]:
        """Return the next state and velocities, shape of ``hand``, m/s, for the next control period."""
        hands, nodes = check_hand(hand), state.nodes
        if nodes is not None and np.shape(nodes) != hands.shape[:-1]:
            raise InvalidInputError("hand", f"hands of the state's shape {np.shape(nodes)}", f"{hands.shape}")
        if hands.ndim == 1:
            x, y = hands.tolist()
            node = int(self._enter(hands[None])[0]) if nodes is None else self._observe_one(int(nodes), x, y)
            onward, velocity = self._velocity_one(node, x, y)
            return PhaseState(onward), velocity
        nodes = self._enter(hands) if nodes is None else self._observe(np.asarray(nodes), hands)
        velocity, near = self._velocity(nodes, hands)
        expected = np.where(near, self._onward(nodes), nodes)
        expected.setflags(write=False)
        return PhaseState(expected), velocity

    def __call__(self, hand: ArrayLike) -> Array:
        """Return velocities, shape of ``hand``, m/s, from the nearest place of the course, whatever was before."""
        hands = check_hand(hand)
        if hands.ndim == 1:
            return self._velocity_one(int(self._nearest(hands[None])[0]), *hands.tolist())[1]
        return self._velocity(self._nearest(hands), hands)[0]

    def _velocity_one(self, node: int, x: float, y: float) -> tuple[int, Array]:
        """Return for one hand the next node and the velocity: `_velocity` in plain numbers, several times faster."""
        px, py, vx, vy = self._rows[node]
        gap_x, gap_y = px - x, py - y
        distance = math.hypot(gap_x, gap_y)
        follow = 1.0 / (1.0 + (distance / (NEAR * self.scale)) ** 4)
        pull = min(PULL, self.reach_speed / max(distance, 1e-9))
        onward = self._onward_one(node) if follow > 0.5 else node
        return onward, np.array([follow * vx + pull * gap_x, follow * vy + pull * gap_y])

    def _observe_one(self, expected: int, x: float, y: float) -> int:
        """Return the node that a hand is at: the expected one, or one near it, or anywhere if the hand is lost."""
        px, py, _, _ = self._rows[expected]
        distance = math.hypot(px - x, py - y)
        if distance <= SURE * self.scale:
            return expected
        if distance > LOST * self.scale:
            return int(self._nearest(np.array([[x, y]]), self._entry if expected < self._entry else None)[0])
        size, rows = len(self._rows), self._rows
        around = [expected + offset for offset in _OFFSETS.tolist()]
        around = [n % size for n in around] if self.closed else [min(max(n, 0), size - 1) for n in around]
        return min(around, key=lambda n: (rows[n][0] - x) ** 2 + (rows[n][1] - y) ** 2)

    def _onward_one(self, node: int) -> int:
        return (node + 1) % len(self._rows) if self.closed else min(node + 1, len(self._rows) - 1)

    def _onward(self, nodes: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the node one control period later."""
        return (nodes + 1) % len(self.course) if self.closed else np.minimum(nodes + 1, len(self.course) - 1)

    def _enter(self, hands: Array) -> NDArray[np.int64]:
        """Return the node where hands begin: the nearest, but a way to a goal is entered in its first part."""
        nodes = self._nearest(hands)
        if not self.closed:
            gap = self.course[nodes] - hands
            away = np.flatnonzero(np.einsum("bd,bd->b", gap, gap) > (LOST * self.scale) ** 2)
            nodes[away] = self._nearest(hands[away], self._entry)
        return nodes

    @property
    def _entry(self) -> int:
        """Number of nodes at which the course may be entered from afar."""
        return len(self._rows) if self.closed else max(int(ENTRY * len(self._rows)), 1)

    def _nearest(self, hands: Array, among: int | None = None) -> NDArray[np.int64]:
        """Return the nearest of the first so many nodes: the least of |p|² / 2 - p · x, by a product and a search."""
        plane = self._plane[:, :among]
        lifted = np.ones((len(hands), 3), dtype=np.float32)
        lifted[:, :2] = hands
        nodes = np.empty(len(hands), dtype=np.int64)
        table = np.empty((min(BLOCK, len(hands)), plane.shape[1]), dtype=np.float32)
        for i in range(0, len(hands), BLOCK):
            part = lifted[i : i + BLOCK]
            np.dot(part, plane, out=table[: len(part)]).argmin(axis=1, out=nodes[i : i + BLOCK])
        return nodes

    def _observe(self, expected: NDArray[np.int64], hands: Array) -> NDArray[np.int64]:
        """Return the node that each hand is at: the expected one, or one near it, or anywhere if the hand is lost."""
        gap = self.course.take(expected, axis=0) - hands
        squares = np.einsum("bd,bd->b", gap, gap)
        lost = np.flatnonzero(squares > (LOST * self.scale) ** 2)
        late = np.flatnonzero((squares > (SURE * self.scale) ** 2) & (squares <= (LOST * self.scale) ** 2))
        nodes = expected.copy()
        if len(lost):
            nodes[lost] = self._find(expected[lost], hands[lost])
        if len(late):
            nodes[late] = self._nearest_around(expected[late], hands[late])
        return nodes

    def _find(self, expected: NDArray[np.int64], hands: Array) -> NDArray[np.int64]:
        """Return the nearest node to lost hands; of those still on their way to a goal's course, in its first part."""
        nodes = self._nearest(hands)
        if not self.closed:
            coming = np.flatnonzero(expected < self._entry)
            nodes[coming] = self._nearest(hands[coming], self._entry)
        return nodes

    def _nearest_around(self, expected: NDArray[np.int64], hands: Array) -> NDArray[np.int64]:
        """Return the nearest node among those about the expected one."""
        around = expected[:, None] + _OFFSETS
        around = around % len(self.course) if self.closed else np.clip(around, 0, len(self.course) - 1)
        gaps = self.course[around] - hands[:, None]
        best = np.einsum("bwd,bwd->bw", gaps, gaps).argmin(axis=1)
        nodes: NDArray[np.int64] = around[np.arange(len(hands)), best]
        return nodes

    def _velocity(self, nodes: NDArray[np.int64], hands: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return velocities, and which hands are near enough for the phase to move on."""
        gap = self.course.take(nodes, axis=0) - hands
        distance = np.sqrt(np.einsum("bd,bd->b", gap, gap))
        follow = 1.0 / (1.0 + np.square(np.square(distance / (NEAR * self.scale))))
        pull = np.minimum(PULL, self.reach_speed / np.maximum(distance, 1e-9))
        velocity = self._ahead.take(nodes, axis=0)
        velocity *= follow[:, None]
        gap *= pull[:, None]
        velocity += gap
        return velocity, follow > 0.5


_OFFSETS = np.arange(-LOOK_AROUND, LOOK_AROUND + 1)
