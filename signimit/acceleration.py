"""Compiled twins of numpy functions (numba, the extra ``fast``): when they are used, how they are compiled and run.

A twin is a module ``x_numba`` beside ``x``; it gives the answers of the numpy function that it doubles, at N = 200
about ten times as fast (policies 9, drawings 9, signs 14 times, in processor time).
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import ModuleType
from typing import Any

WORTHWHILE = 1.0  # s; numba is imported and the twins are read from disk in about half of it


def find_twin(module: str, seconds: float) -> ModuleType | None:
    """Import a compiled twin, where numba is installed and the task is large enough for that to be worthwhile.

    Args:
        module: Name of the twin, such as ``"signimit.similarity_numba"``.
        seconds: What numpy takes, a rough estimate from the size of the task. Only the size decides, not what was
            called before or how busy the machine is: the same call gives the same bytes.
    """
    if seconds < WORTHWHILE:
        return None
    try:
        return importlib.import_module(module)
    except ImportError:  # no numba, or one that does not fit this numpy
        return None


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a function at its first call, and keep the result on disk where there is a folder to keep it in."""
    import numba

    options: dict[str, Any] = {"nogil": True, "fastmath": True, "error_model": "numpy"}
    try:
        kernel: Callable[..., Any] = numba.njit(cache=True, **options)(function)
    except RuntimeError:  # neither the package's folder nor the user's can be written to
        kernel = numba.njit(**options)(function)
    return kernel


def share_rows(kernel: Callable[..., Any], count: int, *arguments: Any) -> None:
    """Let every processor fill its share of the rows; no two write to one place, so their number changes nothing."""
    workers = min(count, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(lambda first: kernel(first, workers, *arguments), range(workers)))
