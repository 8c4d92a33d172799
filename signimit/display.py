"""How what holds many numbers prints: on one line, arrays by their shapes, as in a notebook one wants to see."""

from __future__ import annotations

import dataclasses
import reprlib
from collections.abc import Iterable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

LINE = 120  # characters that a representation has at most
_Class = TypeVar("_Class", bound=type)


def one_line(cls: _Class) -> _Class:
    """Class decorator: a dataclass or named tuple prints as `one_line_repr` has it."""
    type.__setattr__(cls, "__repr__", one_line_repr)
    return cls


def one_line_repr(value: Any) -> str:
    """Return ``Name(field=value, ...)`` in at most `LINE` characters, without fields that are None.

    Args:
        value: A dataclass or a named tuple.

    Returns:
        Its representation; not what would make it again. Fields that do not fit stand as ``...``.
    """
    if dataclasses.is_dataclass(value):
        names: Iterable[str] = [field.name for field in dataclasses.fields(value) if field.repr]
    else:
        names = value._fields
    left = [name for name in names if getattr(value, name) is not None]
    text = f"{type(value).__name__}("
    for number, name in enumerate(left):
        shown = f"{', ' * bool(number)}{name}={_FIELDS.repr(getattr(value, name))}"
        if len(text) + len(shown) + len(", ...)") > LINE:
            return f"{text}{', ' * bool(number)}...)"
        text += shown
    return f"{text})"


class _FieldRepr(reprlib.Repr):
    """Representations of fields: arrays of many numbers by their shapes, other objects by their types if long."""

    def __init__(self) -> None:
        super().__init__()
        self.maxtuple = self.maxlist = 3
        self.maxdict = self.maxlevel = 2
        self.maxother = self.maxstring = 40

    def repr_ndarray(self, array: NDArray[Any], level: int) -> str:
        if array.ndim == 1 and 0 < array.size <= self.maxlist and array.dtype.kind in "if":
            return f"[{', '.join(f'{number:.4g}' for number in array)}]"
        return f"<{'x'.join(map(str, array.shape))}>" if array.ndim else f"{array}"

    def repr_float(self, number: float, level: int) -> str:
        return f"{number:.4g}"

    def repr_instance(self, value: object, level: int) -> str:
        if isinstance(value, np.generic):
            return self.repr1(value.item(), level)
        text = repr(value)
        return f"<{type(value).__name__}>" if len(text) > self.maxother or "\n" in text else text


_FIELDS = _FieldRepr()
