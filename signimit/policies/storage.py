"""Policies as files: each kind is a frozen dataclass of arrays and numbers, and its fields are the file."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, ClassVar, Self, get_type_hints

import numpy as np

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.policies.base import Array, Policy
from signimit.validation import finite_array

_FILE_KIND, _FILE_VERSION = "policy", 2
LARGEST = 1e13  # of any number of a policy, SI units: no hand is faster, as times are at least 1 ns apart
LEAST_SIZE = 1e-12  # m; half of the extent of a part of a movement that a hand can make
RMS_RADIUS = 0.8  # half sizes; of 13 movements of built-in people 0.74 in the median, of 7 of real people 0.83


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
        """Make the arrays read-only copies and refuse what no policy computes with.

        Raises:
            InvalidInputError: If a field is or holds something that is not a finite number or beyond all sense, an
                array is empty, or a count is not whole.
        """
        for name, hint in self._stored_types().items():
            value: Any = getattr(self, name)
            where = f"policy: {name}"
            if hint in (float, int):
                value = float(finite_array(value, where, (), LARGEST))
                if hint is int and (value < 1 or value % 1):
                    raise InvalidInputError(where, "a whole number, 1 or more", f"{value:g}")
                value = hint(value)
            else:
                value = finite_array(value, where, (None,) * np.ndim(value), LARGEST)
                if not value.size:
                    raise InvalidInputError(where, "numbers", "none")
            object.__setattr__(self, name, value)

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
        fields = [field for field in dataclasses.fields(cls) if field.init]
        missing = [f.name for f in fields if f.default is dataclasses.MISSING and f.name not in arrays]
        if missing:
            raise FileFormatError(where, f"arrays {', '.join(f.name for f in fields)}", f"no {missing[0]}")
        try:
            return cls(**{f.name: arrays[f.name] for f in fields if f.name in arrays})
        except InvalidInputError as error:
            raise FileFormatError(f"{where}: {error.where}", error.expected, error.found) from None


def check_movement(closed: float, half_size: float, reach_speed: float) -> None:
    """Refuse what no movement can be.

    Args:
        closed: Whether it goes round (1) or ends (0).
        half_size: Half of its larger extent, m.
        reach_speed: Speed on the way to it, m/s.

    Raises:
        InvalidInputError: Names the number.
    """
    if closed not in (0.0, 1.0):
        raise InvalidInputError("policy: closed", "0 or 1", f"{closed:g}")
    if half_size < LEAST_SIZE:
        raise InvalidInputError("policy: half_size", f"at least {LEAST_SIZE:g} m", f"{half_size:g}")
    if reach_speed <= 0:
        raise InvalidInputError("policy: reach_speed", "a speed above 0", f"{reach_speed:g}")


def read_policy_arrays(path: str | os.PathLike[str]) -> tuple[str, dict[str, Array]]:
    """Return the kind of policy that a file holds, and its arrays.

    Version 1 measured gaps in the root mean square radius of the movement, ``scale``. The ``half_size`` made of it is
    that of a typical movement of this radius, so that such a policy tells near from far where it did.

    Raises:
        FileFormatError: If it is not a whole policy file.
    """
    arrays, meta = read_archive(path, _FILE_KIND, _FILE_VERSION)
    if "scale" in arrays:
        try:
            arrays["half_size"] = finite_array(arrays.pop("scale"), "policy: scale", (), LARGEST) / RMS_RADIUS
        except InvalidInputError as error:
            raise FileFormatError(f"{os.fspath(path)}: {error.where}", error.expected, error.found) from None
    return str(meta.get("policy", "")), arrays
