"""What a policy is, and what every kind does first: look at the demonstrations and at the hand.

A policy is a control law (paper, section II-E): hand position in, hand velocity out, in the frame of the object that
the movement is about.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke

FARTHEST = 1e3  # m; nobody's table is wider, and squares of anything below stay finite
CONTROL_PERIOD = 0.02  # s; 50 Hz, the control rate of the environments

Array = NDArray[np.float64]


@runtime_checkable
class Policy(Protocol):
    """Hand position to hand velocity, autonomous and immutable."""

    @property
    def kind(self) -> str:
        """Name under which `make_policy` knows it."""
        ...

    def __call__(self, hand: ArrayLike) -> Array:
        """Return velocities, shape (2,) or (B, 2), m/s, for hands of the same shape, m, object's frame."""
        ...

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy to a file that `load_policy` reads."""
        ...


@runtime_checkable
class StatefulPolicy(Policy, Protocol):
    """A policy that also remembers where in the movement it is: needed where a movement crosses itself.

    States are immutable values; they belong to the caller, so one policy moves any number of hands.
    """

    def start(self) -> Any:
        """Return the state of hands that nothing is known about; it takes their shape at the first step."""
        ...

    def step(self, state: Any, hand: ArrayLike) -> tuple[Any, Array]:
        """Return the next state and the velocities for one control period of `CONTROL_PERIOD` seconds."""
        ...


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
            stroke = Stroke(np.asarray(points), np.asarray(stamps))
            if np.abs(stroke.points).max() > FARTHEST:
                raise InvalidInputError("points", f"positions within {FARTHEST:g} m", "larger ones")
            strokes.append(stroke)
        except InvalidInputError as error:
            raise error.inside(f"demonstration {i}") from None
        except (TypeError, ValueError) as error:
            raise InvalidInputError(f"demonstration {i}", "arrays of numbers", str(error)) from None
    return tuple(strokes)


def check_hand(hand: ArrayLike) -> Array:
    """Return hands as a float array, shape (2,) or (B, 2).

    Raises:
        InvalidInputError: If the shape is another, or a hand is not finite or off every table.
    """
    try:
        numbers = np.asarray(hand)
    except ValueError:
        raise InvalidInputError("hand", "shape (2,) or (B, 2)", f"a ragged {type(hand).__name__}") from None
    if numbers.dtype.kind not in "fiub":
        raise InvalidInputError("hand", "numbers of shape (2,) or (B, 2)", f"{numbers.dtype} values")
    array = numbers.astype(np.float64, copy=False)
    if array.shape == (2,):
        near = -FARTHEST < array[0] < FARTHEST and -FARTHEST < array[1] < FARTHEST
    elif array.ndim == 2 and array.shape[1] == 2:
        near = bool((np.abs(array) < FARTHEST).all())  # a comparison with NaN is false
    else:
        raise InvalidInputError("hand", "shape (2,) or (B, 2)", f"shape {array.shape}")
    if not near:
        raise InvalidInputError("hand", f"finite positions within {FARTHEST:g} m", f"{array.ravel()[:6]}")
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
