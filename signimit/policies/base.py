"""The policy: a control law from where a hand is to how it moves (paper, section II-E).

One abstract class, `Policy`; a policy about a place on the table, `PlacedPolicy`; and what every kind does first, to
check demonstrations and hands.
"""

from __future__ import annotations

import dataclasses
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke
from signimit.validation import FARTHEST, LEAST_MOVE, moving_points

CONTROL_PERIOD = 0.02  # s, of every closed loop of this project, simulated arm or not: 50 Hz

Array = NDArray[np.float64]


class Policy(ABC):
    """Control law: hand position, m, to hand velocity, m/s, in the frame of the object that the movement is about.

    A policy is immutable. What it remembers of a hand, e.g. how far the movement is, is a *state*: a value that belongs
    to the caller, so that one policy moves any number of hands. Policies that remember nothing have the state None, and
    all are driven alike::

        state = policy.start()
        while moving:
            state, velocity = policy.step(state, hand)

    which `signimit.policies.closed_loop.run_policy` does.
    """

    @property
    def kind(self) -> str:
        """Name under which `make_policy` knows it."""
        return type(self).__name__

    def start(self) -> Any:
        """Return the state of hands that were not seen yet; it takes their shape at the first step."""
        return None

    @abstractmethod
    def step(self, state: Any, hand: ArrayLike) -> tuple[Any, Array]:
        """Return the next state and the velocities for one control period of `CONTROL_PERIOD` seconds.

        Args:
            state: What `start` or the last `step` returned.
            hand: Hand positions, shape (2,) or (B, 2), m, object's frame.

        Returns:
            State, and velocities of the shape of ``hand``, m/s.
        """

    def __call__(self, hand: ArrayLike) -> Array:
        """Return the velocities, shape of ``hand``, m/s, of hands of which only the positions are known."""
        velocity: Array = self.step(self.start(), hand)[1]
        return velocity

    def at(self, place: ArrayLike) -> PlacedPolicy:
        """Return this policy about a place on the table, shape (2,), m; its hands are in the table frame."""
        return PlacedPolicy(self, np.asarray(place))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy to a file that `load_policy` reads.

        Raises:
            InvalidInputError: If this policy has no file format: it is not of a kind that `make_policy` makes.
        """
        raise InvalidInputError("policy", "a kind that make_policy makes, which has a file format", self.kind)


@one_line
@dataclasses.dataclass(frozen=True, eq=False)
class PlacedPolicy(Policy):
    """A policy about a place on the table, called with hands in the table frame.

    Attributes:
        policy: The policy in the frame of the object.
        place: Where the object is, shape (2,), or (B, 2) for as many hands, m, table frame.
    """

    policy: Policy
    place: Array

    def __post_init__(self) -> None:
        """Make the place a read-only copy.

        Raises:
            InvalidInputError: If it is not a finite position.
        """
        object.__setattr__(self, "place", frozen(check_hand(self.place, "place")))

    def __reduce__(self) -> tuple[type[Self], tuple[Policy, Array]]:
        """Pickle as the two attributes: the place of a copy is read-only again."""
        return type(self), (self.policy, self.place)

    @property
    def kind(self) -> str:
        """Kind of the policy that is placed."""
        return self.policy.kind

    def start(self) -> Any:
        """Return the state of hands that were not seen yet."""
        return self.policy.start()

    def step(self, state: Any, hand: ArrayLike) -> tuple[Any, Array]:
        """Return the next state and velocities, shape of ``hand``, m/s, for hands in the table frame, m."""
        return self.policy.step(state, check_hand(hand) - self.place)

    def __call__(self, hand: ArrayLike) -> Array:
        """Return the velocities, shape of ``hand``, m/s, of hands in the table frame, m."""
        return self.policy(check_hand(hand) - self.place)

    def at(self, place: ArrayLike) -> PlacedPolicy:
        """Return the same policy about another place on the table, shape (2,), or (B, 2) for as many hands, m."""
        return PlacedPolicy(self.policy, np.asarray(place))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy in the frame of the object; ``load_policy(path).at(place)`` puts it on the table again."""
        self.policy.save(path)


class _CallerPolicy(Policy):
    """A caller's own object as a `Policy`: a function of hands, or anything with ``start`` and ``step``."""

    def __init__(self, moves: Any) -> None:
        self._moves = moves
        self._has_state = hasattr(moves, "start") and hasattr(moves, "step")

    def start(self) -> Any:
        return self._moves.start() if self._has_state else None

    def step(self, state: Any, hand: ArrayLike) -> tuple[Any, Array]:
        state, velocity = self._moves.step(state, hand) if self._has_state else (None, self._moves(hand))
        return state, np.asarray(velocity, dtype=np.float64)


def as_policy(moves: Policy | Callable[[Array], ArrayLike]) -> Policy:
    """Return a `Policy`, wrapping what is none.

    Args:
        moves: A policy; or a function of hand positions, m, that returns velocities, m/s; or an object that has
            ``start() -> state`` and ``step(state, hand) -> (state, velocity)``, which are then used.

    Raises:
        InvalidInputError: If it is none of these.
    """
    if isinstance(moves, Policy):
        return moves
    if not callable(moves) and not hasattr(moves, "step"):
        raise InvalidInputError("policy", "a policy", type(moves).__name__)
    return _CallerPolicy(moves)


def check_demonstrations(paths: Sequence[ArrayLike], times: Sequence[ArrayLike]) -> tuple[Stroke, ...]:
    """Return the demonstrations of one movement as checked, read-only strokes.

    Args:
        paths: Hand positions in the frame of the object, each of shape (T, 2), m.
        times: When the hand was there, each of shape (T,), s.

    Raises:
        InvalidInputError: If there is no demonstration, or one is not a timed path; names it.
    """
    if len(paths) != len(times) or not len(paths):
        expected = "at least one path, and as many times as paths"
        raise InvalidInputError("demonstrations", expected, f"{len(paths)} paths and {len(times)} times")
    strokes = []
    for i, (points, stamps) in enumerate(zip(paths, times, strict=True)):
        try:
            moving_points(points, "stroke points", FARTHEST, LEAST_MOVE)
            strokes.append(Stroke(np.asarray(points), np.asarray(stamps)))
        except InvalidInputError as error:
            raise error.inside(f"demonstration {i}") from None
        except (TypeError, ValueError) as error:
            raise InvalidInputError(f"demonstration {i}", "arrays of numbers", str(error)) from None
    return tuple(strokes)


def check_hand(hand: ArrayLike, where: str = "hand") -> Array:
    """Return positions as a float array, shape (2,) or (B, 2), m; ``where`` is their name in the error's sentence.

    Raises:
        InvalidInputError: If the shape is another, or a hand is not finite or off every table.
    """
    try:
        numbers = np.asarray(hand)
    except ValueError:
        raise InvalidInputError(where, "shape (2,) or (B, 2)", f"a ragged {type(hand).__name__}") from None
    if numbers.dtype.kind not in "fiub":
        raise InvalidInputError(where, "numbers of shape (2,) or (B, 2)", f"{numbers.dtype} values")
    array = numbers.astype(np.float64, copy=False)
    if array.shape == (2,):
        near = -FARTHEST <= array[0] <= FARTHEST and -FARTHEST <= array[1] <= FARTHEST
    elif array.ndim == 2 and array.shape[1] == 2:
        near = bool((np.abs(array) <= FARTHEST).all())  # a comparison with NaN is false
    else:
        raise InvalidInputError(where, "shape (2,) or (B, 2)", f"shape {array.shape}")
    if not near:
        raise InvalidInputError(where, f"finite positions within {FARTHEST:g} m", f"{array.ravel()[:6]}")
    return array


def demonstrated_velocities(stroke: Stroke) -> Array:
    """Return the velocity at each point of a demonstration, shape (T, 2), m/s, by central differences."""
    velocity: Array = np.gradient(stroke.points, stroke.times, axis=0)
    return velocity


def frozen(array: ArrayLike) -> Array:
    """Return a read-only copy, so that a frozen dataclass shares nothing that can change."""
    copy = np.array(array, dtype=np.float64, order="C")
    copy.setflags(write=False)
    return copy
