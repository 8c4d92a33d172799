"""The policy: a control law from where a hand is to how it moves (paper, section II-E).

One abstract class, `Policy`; one file format for all kinds, `StoredPolicy`; the frame of an object put on the table,
`PlacedPolicy`; and what every kind does first, to look at demonstrations and hands.
"""

from __future__ import annotations

import dataclasses
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, ClassVar, Self, get_type_hints

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.strokes import Stroke

CONTROL_PERIOD = 0.02  # s, of every closed loop of this project, simulated arm or not: 50 Hz
FARTHEST = 1e3  # m; no table is wider, and squares of anything below stay finite

Array = NDArray[np.float64]
_FILE_KIND, _FILE_VERSION = "policy", 2
RMS_RADIUS = 0.8  # half sizes; of 13 movements of built-in people 0.74 in the median, of 7 of real people 0.83


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


@dataclasses.dataclass(frozen=True, eq=False)
class StoredPolicy(Policy):
    """A policy whose init fields are its file: those annotated ``float`` or ``int`` are numbers, all others arrays.

    A field with a default may be missing in a file: it was written before the field was there.
    """

    kind: ClassVar[str]

    @classmethod
    def _stored_types(cls) -> dict[str, type]:
        hints = get_type_hints(cls)
        return {field.name: hints[field.name] for field in dataclasses.fields(cls) if field.init}

    def __post_init__(self) -> None:
        """Make the arrays read-only copies and refuse what is not finite.

        Raises:
            InvalidInputError: If a field is or holds something that is not a finite number, or a count is not whole.
        """
        for name, hint in self._stored_types().items():
            value = frozen(getattr(self, name))
            if not np.isfinite(value).all() or not value.size:
                raise InvalidInputError(f"policy: {name}", "finite numbers", "others, or none")
            if hint is int and not (value.ndim == 0 and value >= 1 and value % 1 == 0):
                raise InvalidInputError(f"policy: {name}", "a whole number, 1 or more", f"{getattr(self, name)!r}")
            object.__setattr__(self, name, value if hint not in (float, int) else hint(value))

    def _stored_arrays(self) -> dict[str, Array]:
        return {name: np.asarray(getattr(self, name)) for name in self._stored_types()}

    def __repr__(self) -> str:
        """Name the fields, arrays by their shapes: a policy is printed with every response."""
        default = {field.name: field.default for field in dataclasses.fields(self)}
        values = ((name, v) for name, v in self._stored_arrays().items() if v.ndim or v != default[name])
        shown = (f"{name}=<{'x'.join(map(str, v.shape))}>" if v.ndim else f"{name}={v:.4g}" for name, v in values)
        return f"{type(self).__name__}({', '.join(shown)})"

    def __reduce__(self) -> tuple[type[Self], tuple[Any, ...]]:
        """Pickle the stored fields only; a copy is made and checked anew, its arrays read-only again."""
        return type(self), tuple(getattr(self, name) for name in self._stored_types())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy to a file that `load_policy` reads; whole or not at all."""
        write_archive(path, _FILE_KIND, _FILE_VERSION, self._stored_arrays(), {"policy": self.kind})

    @classmethod
    def from_arrays(cls, arrays: dict[str, Array], where: str) -> Self:
        """Build the policy from what `save` wrote.

        Raises:
            FileFormatError: If a field is missing, of another shape, or not finite.
        """
        types = cls._stored_types()
        needed = {f.name for f in dataclasses.fields(cls) if f.init and f.default is dataclasses.MISSING}
        missing = [name for name in types if name in needed and name not in arrays]
        if missing:
            raise FileFormatError(where, f"arrays {', '.join(types)}", f"no {missing[0]}")
        try:
            there = {name: hint for name, hint in types.items() if name in arrays}
            return cls(
                **{name: arrays[name].item() if t in (float, int) else arrays[name] for name, t in there.items()}
            )
        except (TypeError, ValueError, IndexError) as error:
            raise FileFormatError(where, f"the arrays of a {cls.kind} policy", str(error)) from None


def read_policy_arrays(path: str | os.PathLike[str]) -> tuple[str, dict[str, Array]]:
    """Return the kind of policy that a file holds, and its arrays.

    Version 1 measured gaps in the root mean square radius of the movement, ``scale``. The ``half_size`` made of it is
    that of a typical movement of this radius, so that such a policy tells near from far where it did.

    Raises:
        FileFormatError: If it is not a whole policy file.
    """
    arrays, meta = read_archive(path, _FILE_KIND, _FILE_VERSION)
    if "scale" in arrays:
        arrays["half_size"] = arrays.pop("scale") / RMS_RADIUS
    return str(meta.get("policy", "")), arrays


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
        near = -FARTHEST < array[0] < FARTHEST and -FARTHEST < array[1] < FARTHEST
    elif array.ndim == 2 and array.shape[1] == 2:
        near = bool((np.abs(array) < FARTHEST).all())  # a comparison with NaN is false
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
