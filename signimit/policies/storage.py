"""Policies as files: each kind is a frozen dataclass of arrays, and its fields are the file."""

from __future__ import annotations

import dataclasses
import os
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.policies.base import frozen

KIND, VERSION = "policy", 1


@dataclasses.dataclass(frozen=True, eq=False)
class StoredPolicy:
    """A frozen dataclass whose init fields are arrays and numbers: saved and loaded field by field."""

    kind: ClassVar[str]

    def __post_init__(self) -> None:
        """Make the arrays read-only copies and refuse what is not finite.

        Raises:
            InvalidInputError: If a field holds something that is not a finite number.
        """
        for field in dataclasses.fields(self):
            if field.init and field.type == "Array":
                value = frozen(getattr(self, field.name))
                if not np.isfinite(value).all() or not value.size:
                    raise InvalidInputError(f"policy: {field.name}", "finite numbers", "others, or none")
                object.__setattr__(self, field.name, value)

    def __repr__(self) -> str:
        """Name the fields, arrays by their shapes: a policy is printed with every response."""
        values = (
            (field.name, np.asarray(getattr(self, field.name))) for field in dataclasses.fields(self) if field.init
        )
        shown = (f"{name}=<{'x'.join(map(str, v.shape))}>" if v.ndim else f"{name}={v:.4g}" for name, v in values)
        return f"{type(self).__name__}({', '.join(shown)})"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy to a file that `load_policy` reads; whole or not at all."""
        arrays: dict[str, NDArray[np.float64]] = {
            field.name: np.asarray(getattr(self, field.name)) for field in dataclasses.fields(self) if field.init
        }
        write_archive(path, KIND, VERSION, arrays, {"policy": self.kind})

    @classmethod
    def from_arrays(cls, arrays: dict[str, NDArray[np.float64]], where: str) -> Self:
        """Build the policy from what `save` wrote.

        Raises:
            FileFormatError: If a field is missing, of another shape, or not finite.
        """
        fields = [field for field in dataclasses.fields(cls) if field.init]
        missing = [field.name for field in fields if field.name not in arrays]
        if missing:
            raise FileFormatError(where, f"arrays {', '.join(f.name for f in fields)}", f"no {missing[0]}")
        try:
            values = {f.name: arrays[f.name] if f.type == "Array" else arrays[f.name].item() for f in fields}
            return cls(**values)
        except (TypeError, ValueError, IndexError) as error:
            raise FileFormatError(where, f"the arrays of a {cls.kind} policy", str(error)) from None


def read_policy_arrays(path: str | os.PathLike[str]) -> tuple[str, dict[str, NDArray[np.float64]]]:
    """Return the kind of policy that a file holds, and its arrays.

    Raises:
        FileFormatError: If it is not a whole policy file.
    """
    archive = read_archive(path, KIND, VERSION)
    return str(archive.meta.get("policy", "")), archive.arrays
