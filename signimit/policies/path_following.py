"""The default policy: follow the course that the demonstrations share, at their speed, from anywhere.

Control by maneuver regulation (Hauser and Hindman 1995): the phase is observed from the hand, not counted by a clock,
so a hand that is held or pushed is not left behind. Near the course the velocity is that of the demonstrators plus a
pull; far from it the hand goes straight to the nearest place of a movement that repeats, and to the beginning of one
that is made once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError
from signimit.policies.base import CONTROL_PERIOD, Array, check_hand, frozen
from signimit.policies.reference_path.reference_path import learn_reference_path, sample_reference_path
from signimit.policies.storage import StoredPolicy, check_movement
from signimit.strokes import Stroke
from signimit.validation import FARTHEST, finite_array

# Chosen on six people of the $1 recogniser's data, four demonstrations a movement (docs/policies.md).
PULL = 15.0  # 1/s
NEAR = 0.096  # half sizes
SURE = 0.04  # half sizes; a hand so close to the expected place is taken to be there
LEAST_NEAR = 1e-9  # half sizes; what is less is no distance of a hand
LOST = 0.32  # half sizes; further, the phase is looked for everywhere
LOOK_AROUND = 4  # nodes about the expected one, the phases of a hand that is neither sure nor lost
ENTRY = 0.25  # of a way that ends at a goal and is not `whole`: from afar it is entered there, not at the goal
_AROUND = np.arange(-LOOK_AROUND, LOOK_AROUND + 1)
BLOCK = 512  # hands at once: their table of gaps stays in the cache

Nodes = NDArray[np.int64]


class _PlainNumbers:
    """Python's functions under numpy's names, for the rules of `PathFollowingPolicy`.

    The rules are arithmetic on coordinates and nodes: arrays of shape (B,) for many hands, and Python's numbers for one
    hand, because numpy takes six times as long for arrays of one.
    """

    sqrt, minimum, maximum, any = math.sqrt, min, max, bool


class PhaseState(NamedTuple):
    """Where hands are in the movement.

    Attributes:
        nodes: Expected node: a number for one hand, shape (B,) for many; None as long as no hand was seen.
    """

    nodes: int | Nodes | None = None


@dataclass(frozen=True, eq=False, repr=False)
class PathFollowingPolicy(StoredPolicy):
    """Follow a course whose nodes are one control period apart.

    Attributes:
        course: Positions at equal steps of time, shape (M, 2), m, object's frame.
        closed: Whether the course goes round (1) or ends at the last node, where the hand rests (0).
        half_size: Half of the larger extent of the movement, m.
        reach_speed: Speed on the way to the course, m/s.
        pull: Speed towards the course for each metre off it, 1/s, up to ``reach_speed``: a stronger pull is back sooner
            after a shove, and swings where an arm follows late.
        near: Distance from the course, in half sizes, at which the demonstrators' velocity counts half and below which
            the phase moves on: more of it rounds corners off, less lets a hand that is held off the course stand still.
        whole: Whether a course that ends is followed from its first node by every hand, which keeps its phase however
            far it is shoved (1), or entered where it is near (0), as policies of version 0.1.0 did.
    """

    kind: ClassVar[str] = "path-following"
    course: Array
    closed: float
    half_size: float
    reach_speed: float
    pull: float = PULL
    near: float = NEAR
    whole: float = 0.0
    _columns: Array = field(init=False, repr=False)  # of each node: x, y, m, and the velocity to the next, m/s
    _rows: tuple[tuple[float, ...], ...] = field(init=False, repr=False)  # the same in Python's numbers
    _plane: NDArray[np.float32] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the course and prepare its velocities."""
        super().__post_init__()
        if len(finite_array(self.course, "policy: course", (None, 2), FARTHEST)) < 2:
            raise InvalidInputError("policy: course", "at least 2 nodes", "1")
        check_movement(self.closed, self.half_size, self.reach_speed)
        if not (0 < self.pull < 1 / CONTROL_PERIOD and LEAST_NEAR < self.near < LOST):
            expected = f"above 0, pull below {1 / CONTROL_PERIOD:g} per second and near below {LOST} half sizes"
            raise InvalidInputError("pull, near", expected, f"{self.pull}, {self.near}")
        onward = self.course[self._clip(np.arange(1, len(self.course) + 1), np)]
        columns = frozen(np.hstack([self.course, (onward - self.course) / CONTROL_PERIOD]).T)
        plane = np.vstack([-self.course.T, (self.course**2).sum(axis=1) / 2]).astype(np.float32)
        plane.setflags(write=False)
        object.__setattr__(self, "_columns", columns)
        object.__setattr__(self, "_rows", tuple(zip(*columns.tolist(), strict=True)))
        object.__setattr__(self, "_plane", plane)

    @classmethod
    def learn(
        cls, demonstrations: Sequence[Stroke], *, repeat: bool | None = None, pull: float = PULL, near: float = NEAR
    ) -> Self:
        """Find the shared course, of a movement that repeats or not as `learn_reference_path` tells, and time it."""
        path = learn_reference_path(demonstrations, repeat)
        course, closed = sample_reference_path(path), float(path.closed)
        return cls(course, closed, path.half_size, path.reach_speed, pull, near, whole=1.0 - closed)

    def start(self) -> PhaseState:
        """Return the state of hands not seen yet."""
        return PhaseState()

    def step(self, state: PhaseState, hand: ArrayLike) -> tuple[PhaseState, Array]:
        """Return the next state and velocities, shape of ``hand``, m/s, for the next control period."""
        hands, expected = check_hand(hand), state.nodes
        if expected is not None and np.shape(expected) != hands.shape[:-1]:
            raise InvalidInputError("hand", f"hands of the state's shape {np.shape(expected)}", f"{hands.shape}")
        x, y, xp = _coordinates(hands)
        if expected is None:
            flat = hands.reshape(-1, 2)
            nodes = _of_hands(hands, np.zeros(len(flat), dtype=np.int64) if self.whole else self._find(flat))
        else:
            nodes = self._observe(expected, hands, x, y, xp)
        velocity, onward = self._follow(nodes, x, y, xp)
        return PhaseState(onward), velocity

    def __call__(self, hand: ArrayLike) -> Array:
        """Return velocities, shape of ``hand``, m/s, from the nearest place of the course, whatever was before."""
        hands = check_hand(hand)
        return self._follow(_of_hands(hands, self._nearest(hands.reshape(-1, 2))), *_coordinates(hands))[0]

    def _at(self, nodes: Any, xp: Any) -> Any:
        """Return x and y of nodes, m, and the velocities there along x and y, m/s."""
        return self._rows[nodes] if xp is _PlainNumbers else self._columns.take(nodes, axis=1)

    def _follow(self, nodes: Any, x: Any, y: Any, xp: Any) -> tuple[Array, Any]:
        """Return the velocities of hands at nodes, and the nodes to expect them at a control period later."""
        node_x, node_y, ahead_x, ahead_y = self._at(nodes, xp)
        gap_x, gap_y = node_x - x, node_y - y
        distance = xp.sqrt(gap_x * gap_x + gap_y * gap_y)
        square = (distance / (self.near * self.half_size)) ** 2
        follow = 1.0 / (1.0 + square * square)
        pull = xp.minimum(self.pull, self.reach_speed / xp.maximum(distance, 1e-9))
        near = follow > 0.5
        follow *= near | (nodes > 0) if self.whole else 1.0  # not past the beginning before having been there
        velocity = np.array([follow * ahead_x + pull * gap_x, follow * ahead_y + pull * gap_y]).T
        onward = self._clip(nodes + near, xp)
        if xp is np:
            onward.setflags(write=False)
        return velocity, onward

    def _observe(self, expected: Any, hands: Array, x: Any, y: Any, xp: Any) -> Any:
        """Return the node that each hand is at: the expected one, or one near it, or anywhere if the hand is lost."""
        node_x, node_y, _, _ = self._at(expected, xp)
        gap_x, gap_y = node_x - x, node_y - y
        squares = gap_x * gap_x + gap_y * gap_y
        astray = squares > (SURE * self.half_size) ** 2
        if not xp.any(astray):
            return expected
        nodes, flat = np.array(expected, ndmin=1), hands.reshape(-1, 2)
        far = squares > (LOST * self.half_size) ** 2
        late, lost = np.flatnonzero(astray & ~far), np.flatnonzero(far)
        if self.whole:  # no node is left out, and none is drawn twice
            late, lost = late[nodes[late] > 0], lost[:0]
        if len(late):
            around = self._clip(nodes[late, None] + _AROUND, np)
            gaps = self.course.take(around, axis=0) - flat[late, None]
            nodes[late] = around[np.arange(len(late)), np.einsum("bwd,bwd->bw", gaps, gaps).argmin(axis=1)]
        if len(lost):
            nodes[lost] = self._find(flat[lost], nodes[lost] < self._entry)
        return _of_hands(hands, nodes)

    def _find(self, hands: Array, coming: NDArray[np.bool_] | None = None) -> Nodes:
        """Return the nearest node to each hand; a way to a goal is entered in its first part by hands that come to it.

        Args:
            hands: Shape (B, 2), m.
            coming: Which hands come to the course, shape (B,); left out, those that are far from it.
        """
        nodes = self._nearest(hands)
        if not self.closed:
            if coming is None:
                gap = self.course[nodes] - hands
                coming = np.einsum("bd,bd->b", gap, gap) > (LOST * self.half_size) ** 2
            nodes[coming] = self._nearest(hands[coming], self._entry)
        return nodes

    @property
    def _entry(self) -> int:
        """Number of nodes at which the course may be entered from afar."""
        return len(self.course) if self.closed else max(int(ENTRY * len(self.course)), 1)

    def _clip(self, nodes: Any, xp: Any) -> Any:
        """Return the nodes of numbers that may lie beyond the ends of the course."""
        count = len(self.course)
        return nodes % count if self.closed else xp.minimum(xp.maximum(nodes, 0), count - 1)

    def _nearest(self, hands: Array, among: int | None = None) -> Nodes:
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


def _coordinates(hands: Array) -> tuple[Any, Any, Any]:
    """Return x and y of hands, m, and what computes with them: numpy, or `_PlainNumbers` for one hand."""
    return (*hands.tolist(), _PlainNumbers) if hands.ndim == 1 else (hands[:, 0], hands[:, 1], np)


def _of_hands(hands: Array, nodes: Nodes) -> int | Nodes:
    """Return the nodes of hands, shape (B,), as `PhaseState` keeps them: that of one hand as a number."""
    return nodes.item() if hands.ndim == 1 else nodes
