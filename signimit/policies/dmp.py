"""Dynamic movement primitives: a discrete reach, then a rhythmic primitive; or one discrete primitive to a goal.

Ijspeert, Nakanishi, Hoffmann, Pastor and Schaal 2013, doi:10.1162/NECO_a_00393. The hand is a critically damped spring
to a goal plus a forcing term, learned by least squares, of a phase that the clock drives and the error slows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError
from signimit.policies.base import CONTROL_PERIOD, Array, check_hand, frozen
from signimit.policies.gaussian_mixture import within_speed
from signimit.policies.reference_path.reference_path import learn_reference_path, sample_reference_path
from signimit.policies.storage import StoredPolicy, check_movement
from signimit.strokes import Stroke
from signimit.validation import FARTHEST, finite_array

BASES = 40  # basis functions of the forcing term
FREQUENCY = 10.0  # rad/s
DECAY = 3.0  # of the discrete primitive's gate over its duration
ARRIVED = 0.12  # half sizes from the course at which the reach ends
PATIENCE = 0.24  # half sizes of error that halve the phase's speed (phase stopping)
RIDGE = 1e-6  # added to the diagonal of the bases' Gram matrix: where no node is, a weight is 0


class PrimitiveState(NamedTuple):
    """Where hands are in the primitive; None as long as no hand was seen.

    Attributes:
        phases: In units of the course, shape () or (B,).
        velocity: Of the spring, shape (2,) or (B, 2), m/s.
        drawing: Whether the reach is over, shape () or (B,).
    """

    phases: Array | None = None
    velocity: Array | None = None
    drawing: NDArray[np.bool_] | None = None


@dataclass(frozen=True, eq=False, repr=False)
class DMPPolicy(StoredPolicy):
    """Discrete reach to the course, then the primitive, rhythmic if the movement repeats; both are one spring.

    A movement that repeats is reached at its nearest place, one that is made once at its beginning.

    Attributes:
        weights: Of the basis functions of the forcing term, shape (BASES, 2), m/s².
        course: What the primitive was learned from, one control period a node, shape (M, 2), m.
        closed: Whether it is rhythmic (1) or discrete (0).
        half_size: Half of the larger extent of the movement, m.
        reach_speed: Greatest speed of the reach, m/s.
        frequency: Of the spring, rad/s: an error is forgotten within about 3 / frequency seconds; a stiffer spring asks
            for higher speeds after a shove.
        whole: Whether a discrete primitive waits until the hand has reached its beginning (1), or starts wherever the
            hand is (0), as those of version 0.1.0 did.
    """

    kind: ClassVar[str] = "dmp"
    weights: Array
    course: Array
    closed: float
    half_size: float
    reach_speed: float
    frequency: float = FREQUENCY
    whole: float = 0.0
    _goal: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the shapes and set the goal: the middle of a rhythmic primitive, the end of a discrete one."""
        if not 0 < float(finite_array(self.frequency, "frequency", ())) < 1 / CONTROL_PERIOD:
            expected = f"between 0 and {1 / CONTROL_PERIOD:g} rad/s, what steps of {CONTROL_PERIOD:g} s can follow"
            raise InvalidInputError("frequency", expected, f"{self.frequency}")
        super().__post_init__()
        finite_array(self.weights, "policy: weights", (BASES, 2))
        finite_array(self.course, "policy: course", (None, 2), FARTHEST)
        check_movement(self.closed, self.half_size, self.reach_speed)
        goal = self.course.mean(axis=0) if self.closed else self.course[-1]
        object.__setattr__(self, "_goal", frozen(goal))

    @classmethod
    def learn(
        cls, demonstrations: Sequence[Stroke], *, repeat: bool | None = None, frequency: float = FREQUENCY
    ) -> Self:
        """Find the shared course, repeating or not as `learn_reference_path` tells, and fit the forcing term to it."""
        path = learn_reference_path(demonstrations, repeat)
        nodes = sample_reference_path(path)
        goal = nodes.mean(axis=0) if path.closed else nodes[-1]
        ends = (nodes[-1:], nodes[:1]) if path.closed else (nodes[:1], nodes[-1:])
        line = np.concatenate([ends[0], nodes, ends[1]])
        velocity = np.diff(line, axis=0)[:-1] / CONTROL_PERIOD
        acceleration = np.diff(line, n=2, axis=0) / CONTROL_PERIOD**2
        wanted = acceleration - frequency**2 * (goal - nodes) + 2 * frequency * velocity
        bases = _bases(np.arange(len(nodes)) / len(nodes), path.closed)
        weights = np.linalg.solve(bases.T @ bases + RIDGE * np.eye(BASES), bases.T @ wanted)
        closed = float(path.closed)
        return cls(weights, nodes, closed, path.half_size, path.reach_speed, frequency, whole=1.0 - closed)

    def start(self) -> PrimitiveState:
        """Return the state of hands not seen yet."""
        return PrimitiveState()

    def step(self, state: PrimitiveState, hand: ArrayLike) -> tuple[PrimitiveState, Array]:
        """Return the next state and velocities, shape of ``hand``, m/s, for the next control period."""
        hands = check_hand(hand)
        flat = hands.reshape(-1, 2)
        phases, velocity, drawing = self._unpacked(state, hands)
        here = self._place(phases)
        gap = here - flat
        distance = np.sqrt((gap**2).sum(axis=1))
        drawing = drawing | (distance < ARRIVED * self.half_size)
        force = _bases(phases, bool(self.closed)) @ self.weights
        target = np.where(drawing[:, None], self._goal - flat, gap)
        pushed = self.frequency**2 * target - 2 * self.frequency * velocity + force * drawing[:, None]
        velocity = velocity + CONTROL_PERIOD * pushed
        velocity = np.where(drawing[:, None], velocity, within_speed(velocity, self.reach_speed))
        pace = drawing / (1.0 + (distance / (PATIENCE * self.half_size)) ** 2) / len(self.course)
        onward = (phases + pace) % 1.0 if self.closed else np.minimum(phases + drawing / len(self.course), 1.0)
        shape, answer = hands.shape[:-1], velocity.reshape(hands.shape)
        begun = drawing.reshape(shape)
        begun.setflags(write=False)
        return PrimitiveState(frozen(onward.reshape(shape)), frozen(answer), begun), answer

    def __call__(self, hand: ArrayLike) -> Array:
        """Return velocities, shape of ``hand``, m/s, from the nearest place of the course, whatever was before."""
        hands = check_hand(hand)
        flat = hands.reshape(-1, 2)
        phases = self._nearest(flat)
        onward = (
            (phases + 1.0 / len(self.course)) % 1.0 if self.closed else np.minimum(phases + 1.0 / len(self.course), 1.0)
        )
        ahead = (self._place(onward) - self._place(phases)) / CONTROL_PERIOD
        velocity: Array = ahead + within_speed(self.frequency * (self._place(phases) - flat), self.reach_speed)
        return velocity.reshape(hands.shape)

    def _unpacked(self, state: PrimitiveState, hands: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
        """Return phases (B,), velocities (B, 2) and whether drawing (B,); of new hands at the nearest place."""
        if state.phases is None or state.velocity is None or state.drawing is None:
            count = hands.size // 2
            new = self._nearest(hands.reshape(-1, 2)) if self.closed else np.zeros(count)
            return new, np.zeros((count, 2)), np.full(count, not self.closed and not self.whole)
        if state.velocity.shape != hands.shape:
            raise InvalidInputError("hand", f"hands of the state's shape {state.velocity.shape}", f"{hands.shape}")
        return state.phases.reshape(-1), state.velocity.reshape(-1, 2), state.drawing.reshape(-1)

    def _nearest(self, hands: Array) -> Array:
        squares = (self.course**2).sum(axis=1) / 2 - hands @ self.course.T
        phases: Array = squares.argmin(axis=1) / len(self.course)
        return phases

    def _place(self, phases: Array) -> Array:
        nodes = np.rint(phases * len(self.course)).astype(np.int64)
        return self.course[nodes % len(self.course) if self.closed else np.minimum(nodes, len(self.course) - 1)]


def _bases(phases: Array, closed: bool) -> Array:
    """Return normalised basis functions, shape (B, BASES): von Mises on a circle, or Gaussian behind a closing gate."""
    if closed:
        angles = 2 * np.pi * (phases[:, None] - np.arange(BASES) / BASES)
        raw = np.exp(BASES**2 / 20 * (np.cos(angles) - 1.0))
        gate = np.ones(len(phases))
    else:
        raw = np.exp(-0.5 * ((phases[:, None] - np.linspace(0, 1, BASES)) * BASES) ** 2)
        gate = np.where(phases < 1.0, np.exp(-DECAY * phases), 0.0)
    bases: Array = gate[:, None] * raw / raw.sum(axis=1, keepdims=True)
    return bases
