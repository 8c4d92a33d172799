"""Demonstrations by built-in people, each seen from the object it was about."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.teaching.composition import compose_loops, compose_path
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]
TABLE = np.array([0.42, 0.38])  # m, half width and depth


class Shown(NamedTuple):
    """Demonstrations of one movement, and the strokes they contain."""

    paths: list[Array]
    times: list[Array]
    loops: list[Array]


def compose(label: str, count: int = 4, seed: int = 0) -> Shown:
    """Let one built-in person demonstrate a movement so often, from random places."""
    rng = np.random.default_rng(seed)
    language = Language(movements=(label,), movement_signs=("4",), unseen=())
    strokes = synthetic_library([label], samples=2 * count, rng=rng)
    drawn = [compose_loops(language, strokes, 0, rng) for _ in range(count)]
    paths = [compose_path(rng.uniform(-TABLE / 2, TABLE / 2), loops) for loops in drawn]
    times: list[Array] = [np.arange(len(path)) / 50 for path in paths]
    return Shown(paths, times, [loop for loops in drawn for loop in loops])


@pytest.fixture(scope="session")
def shown() -> Callable[..., Shown]:
    """Return `compose`."""
    return compose
