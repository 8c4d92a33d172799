"""Finds the compiled kernels of the extra ``fast`` where numba is installed."""

from __future__ import annotations

import importlib
from functools import cache
from types import ModuleType

WORTHWHILE = 1.0  # s; numba is imported and the kernels are read from disk in about half of it


@cache
def find_kernels() -> ModuleType | None:
    """Return `signimit.kernels`, or None without numba or with one that does not fit this numpy."""
    try:
        return importlib.import_module("signimit.kernels")
    except ImportError:
        return None


def kernels_for(seconds: float) -> ModuleType | None:
    """Return the kernels if there are any and numpy would take so long that importing them is worthwhile.

    Args:
        seconds: A rough estimate from the size of the task. Only the size decides, not what was called before or how
            busy the machine is: the same call gives the same bytes.
    """
    return find_kernels() if seconds >= WORTHWHILE else None
