"""Finds the compiled kernels of the extra ``fast`` where numba is installed."""

from __future__ import annotations

import importlib
from functools import cache
from types import ModuleType

WORTHWHILE = 10**9  # pairs of points; numpy takes a second for so many, as long as it takes to import numba


@cache
def find_kernels() -> ModuleType | None:
    """Return `signimit.kernels`, or None without numba or with one that does not fit this numpy."""
    try:
        return importlib.import_module("signimit.kernels")
    except ImportError:
        return None


def kernels_for(pairs: int) -> ModuleType | None:
    """Return the kernels if there are any and so many pairs of points are worth importing them.

    Only the size decides, not what was called before: the same call gives the same bytes.
    """
    return find_kernels() if pairs >= WORTHWHILE else None
