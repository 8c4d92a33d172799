"""The boundary: what comes in is turned into finite, read-only float arrays or refused in one sentence."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError

LARGEST = 1e100  # squares and ratios of what is smaller stay finite; no unit makes a stroke larger
FARTHEST = 1e3  # m, between two places; no table is wider
LEAST_MOVE = 1e-9  # m; no hand moves less
_STILL = 1e-9  # share of the largest coordinate below which a movement is rounding noise
LEAST_STEP = 1e-9  # s


def finite_array(
    value: ArrayLike, where: str, shape: tuple[int | None, ...], largest: float = LARGEST
) -> NDArray[np.float64]:
    """Copy ``value`` into a read-only float array of the wanted shape.

    Args:
        value: Anything that numpy can read as numbers.
        where: What it is called in the error's sentence.
        shape: Wanted shape; ``None`` stands for any length.
        largest: Largest absolute value that makes sense.

    Returns:
        A C-ordered copy that cannot be written to.

    Raises:
        InvalidInputError: If it is not numeric, has another shape or is not finite, or beyond ``largest``.
    """
    array = float_array(value, where, shape)
    bad = np.argwhere(~(np.abs(array) <= largest))  # a comparison with NaN is false
    if len(bad):
        at = ", ".join(str(i) for i in bad[0])
        found = array[tuple(bad[0])]
        wanted = f"numbers within {largest:g}" if np.isfinite(found) and largest < LARGEST else "finite numbers"
        raise InvalidInputError(where, wanted, f"{found:g} at index ({at})")
    array.setflags(write=False)
    return array


def float_array(value: ArrayLike, where: str, shape: tuple[int | None, ...]) -> NDArray[np.float64]:
    """Copy ``value`` as `finite_array` does, but let pass what is not finite.

    Raises:
        InvalidInputError: If it is not numeric or has another shape.
    """
    sizes = ", ".join("n" if s is None else str(s) for s in shape)
    wanted = f"numbers of shape ({sizes}{',' * (len(shape) == 1)})"
    array = _as_floats(value, where, wanted)
    if array.ndim != len(shape) or any(
        want is not None and want != have for want, have in zip(shape, array.shape, strict=True)
    ):
        raise InvalidInputError(where, wanted, f"shape {array.shape}")
    return array


def _as_floats(value: ArrayLike, where: str, wanted: str) -> NDArray[np.float64]:
    """Copy integers, booleans or floats; text that looks like numbers and complex numbers are something else."""
    try:
        raw = np.asarray(value)
        if not raw.size:
            return np.zeros(raw.shape)
        if raw.dtype.kind in "biuf":
            with np.errstate(over="ignore", invalid="ignore"):  # longer floats than ours become infinite
                return np.array(raw, dtype=np.float64, order="C")
        found = f"{raw.dtype} values"
    except (TypeError, ValueError, OverflowError):
        found = f"{type(value).__name__} that is not such an array"
    raise InvalidInputError(where, wanted, found)


def moving_points(
    value: ArrayLike, where: str, largest: float = LARGEST, least: float = 1 / LARGEST
) -> NDArray[np.float64]:
    """Copy a path of at least two points, shape (T, 2), that does not stay in one place.

    Args:
        value: Anything that numpy can read as numbers.
        where: What it is called in the error's sentence.
        largest: Largest absolute coordinate that makes sense.
        least: Least extent of a movement; less than 1e-9 of the largest coordinate is rounding noise in any case.

    Raises:
        InvalidInputError: If it is not such a path.
    """
    points = finite_array(value, where, (None, 2), largest)
    if len(points) < 2:
        raise InvalidInputError(where, "at least 2 points", f"{len(points)}")
    if np.ptp(points, axis=0).max() <= max(_STILL * np.abs(points).max(), least):
        raise InvalidInputError(where, "points that move", f"{len(points)} points in one place")
    return points


def increasing_times(value: ArrayLike, where: str, count: int) -> NDArray[np.float64]:
    """Copy time stamps, shape (count,), in seconds, strictly increasing.

    Raises:
        InvalidInputError: If they are not.
    """
    times = finite_array(value, where, (count,))
    still = np.flatnonzero(np.diff(times) < LEAST_STEP)
    if len(still):
        i = int(still[0])
        first, second = told_apart(times[i], times[i + 1])
        raise InvalidInputError(where, "strictly increasing seconds", f"{first} then {second} at index {i}")
    return times


def told_apart(first: float, second: float) -> tuple[str, str]:
    """Write two numbers with as few digits, but at least six, as show that they differ, if they do."""
    pairs = ((f"{first:.{digits}g}", f"{second:.{digits}g}") for digits in range(6, 18))
    return next((pair for pair in pairs if pair[0] != pair[1]), (f"{first:g}", f"{second:g}"))


def plain_text(value: str, where: str) -> str:
    """Return a text that can be written to files and screens.

    Raises:
        InvalidInputError: If it is no text, or has half a character of UTF-16 (a lone surrogate).
    """
    if not isinstance(value, str):
        raise InvalidInputError(where, "text", type(value).__name__)
    try:
        value.encode()
    except UnicodeEncodeError:
        raise InvalidInputError(where, "text in Unicode", f"{value!a:.40}") from None
    return value


def item_list(values: Iterable[Any], where: str) -> list[Any]:
    """Return the items of what should be a list, at least one.

    Raises:
        InvalidInputError: If it is text, a mapping, cannot be gone through, or is empty.
    """
    try:
        items = None if isinstance(values, (str, bytes, Mapping)) else list(values)
    except TypeError:
        items = None
    if items is None:
        raise InvalidInputError(where, "a list", type(values).__name__)
    if not items:
        raise InvalidInputError(where, "at least one", "none")
    return items


def whole_numbers(value: ArrayLike, where: str, shape: tuple[int | None, ...]) -> NDArray[np.int64]:
    """Copy indices or labels into a read-only integer array of the wanted shape.

    Raises:
        InvalidInputError: If they are not such numbers.
    """
    numbers = finite_array(value, where, shape)
    whole = numbers.astype(np.int64) if (np.abs(numbers) < 2**53).all() else np.zeros(numbers.shape, np.int64)
    if (whole != numbers).any():
        raise InvalidInputError(where, "whole numbers", f"{numbers.ravel()[:8].tolist()}")
    whole.setflags(write=False)
    return whole


def make_generator(rng: np.random.Generator | int | None) -> np.random.Generator:
    """Return a generator from a generator or a seed.

    Raises:
        InvalidInputError: If it is neither.
    """
    try:
        return np.random.default_rng(rng)
    except (TypeError, ValueError):
        raise InvalidInputError("rng", "a numpy Generator or a seed, 0 or more", f"{rng!r:.40}") from None
