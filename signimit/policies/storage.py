"""Policies as files: each kind is a frozen dataclass of arrays and numbers, and its fields are the file."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, ClassVar, Self, get_type_hints

import numpy as np

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.policies.base import Array, Policy, frozen
from signimit.validation import finite_array

_FILE_KIND, _FILE_VERSION = "policy", 2
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
        """Make the arrays read-only copies and refuse what is not finite.

        Raises:
            InvalidInputError: If a field is or holds something that is not a finite number, or a count is not whole.
        """
        for name, hint in self._stored_types().items():
            value: Any = getattr(self, name)
            if hint in (float, int):
                value = float(finite_array(value, f"policy: {name}", ()))
                if hint is int and (value < 1 or value % 1):
                    raise InvalidInputError(f"policy: {name}", "a whole number, 1 or more", f"{value:g}")
                value = hint(value)
            else:
                value = frozen(value)
                if not np.isfinite(value).all() or not value.size:
                    raise InvalidInputError(f"policy: {name}", "finite numbers", "others, or none")
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
