"""What people draw: digits, movements about an object, and reaches, as virtual targets and arcs.

Unit: half the height of the drawing; x right, y up, origin at the centre (for reaches: at the object).

Senses of rotation: polygons run counter-clockwise from the top or top left, as nearly everybody draws them in public
recordings. The circle runs clockwise. Most people draw it counter-clockwise too, but the only mistake that the paper
reports is to take its two triangles, and never its circle, for one movement (section III), which fits a circle drawn
against them; one drawn in their sense is much harder to tell from a triangle by directions of motion. That circle is
here as well, as "circle, other way".
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Glyph(NamedTuple):
    """A drawing as it is meant, before anybody's hand makes it.

    Attributes:
        targets: Virtual targets, shape (K + 1, 2).
        arcs: Angle each stroke turns through, shape (K,), rad, counter-clockwise positive.
    """

    targets: NDArray[np.float64]
    arcs: NDArray[np.float64]


def _glyph(start: tuple[float, float], *strokes: tuple[float, float, float]) -> Glyph:
    """Build a glyph from its start and strokes (x, y, arc in degrees)."""
    rows = np.array(strokes, dtype=np.float64)
    targets = np.concatenate([np.array([start], dtype=np.float64), rows[:, :2]])
    arcs = np.radians(rows[:, 2])
    targets.setflags(write=False)
    arcs.setflags(write=False)
    return Glyph(targets, arcs)


def _polygon(*corners: tuple[float, float]) -> Glyph:
    """Build a closed figure of straight strokes."""
    return _glyph(corners[0], *((x, y, 0.0) for x, y in (*corners[1:], corners[0])))


def _round(radii: Sequence[float], turn: float, start: float) -> Glyph:
    """Build an arc about the origin from radii at equal angles ``turn`` (degrees), beginning at angle ``start``."""
    angles = np.radians(start + turn * np.arange(len(radii)))
    points = np.asarray(radii)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    return _glyph((points[0, 0], points[0, 1]), *((x, y, turn) for x, y in points[1:]))


SIGNS: Mapping[str, Glyph] = MappingProxyType(
    {
        "0": _glyph((0.05, 1), (-0.6, 0, 85), (0, -1, 85), (0.6, 0, 85), (0.05, 1, 85)),
        "1": _glyph((-0.45, 0.4), (0.12, 1, -8), (0, -1, 0)),
        "2": _glyph((-0.5, 0.55), (0.02, 1, -80), (0.45, 0.45, -80), (-0.6, -1, -15), (0.65, -0.95, 0)),
        "3": _glyph(
            (-0.45, 0.7), (0.0, 1, -70), (0.42, 0.58, -80), (-0.12, 0.08, -70),
            (0.5, -0.42, -90), (-0.02, -1, -85), (-0.55, -0.72, -50),
        ),
        "4": _glyph((0.1, 1), (-0.6, -0.2, 12), (0.6, -0.15, 0), (0.4, 0.45, 0), (0.22, -1, 0)),
        "5": _glyph(
            (0.55, 1), (-0.3, 0.95, 0), (-0.42, 0.1, 0), (0.08, 0.28, -50),
            (0.5, -0.32, -80), (-0.05, -1, -80), (-0.55, -0.75, -45),
        ),
        "6": _glyph((0.35, 1), (-0.5, -0.4, 40), (0, -1, 80), (0.5, -0.52, 85), (0.02, -0.05, 85), (-0.42, -0.5, 70)),
        "7": _glyph((-0.55, 0.9), (0.55, 0.95, 0), (-0.15, -1, 12)),
        "8": _glyph(
            (0.36, 0.72), (-0.05, 1, 70), (-0.42, 0.58, 90), (0.02, 0.05, 55), (0.45, -0.5, -70),
            (0, -1, -90), (-0.45, -0.5, -90), (0, 0.05, -55), (0.4, 0.7, 55),
        ),
        "9": _glyph((0.4, 0.75), (-0.02, 1, 80), (-0.42, 0.55, 85), (0, 0.15, 85), (0.4, 0.7, 80), (0.12, -1, -8)),
    }
)  # fmt: skip
"""Hand signs."""

MOVEMENTS: Mapping[str, Glyph] = MappingProxyType(
    {
        "circle": _round([1.0] * 5, -90, 90),
        "triangle up": _polygon((0, 0.9), (-1, -0.85), (1, -0.85)),
        "triangle down": _polygon((-1, 0.85), (0, -0.9), (1, 0.85)),
        "square": _polygon((-0.95, 0.95), (-0.95, -0.95), (0.95, -0.95), (0.95, 0.95)),
        "figure eight": _glyph(
            (0, 0), (0.55, 0.5, -25), (1, 0, -100), (0.55, -0.5, -100), (0, 0, -25),
            (-0.55, 0.5, 25), (-1, 0, 100), (-0.55, -0.5, 100), (0, 0, 25),
        ),
        "zigzag": _glyph(
            (-1, -0.8), (-0.6, 0.8, 0), (-0.2, -0.8, 0), (0.2, 0.8, 0), (0.6, -0.8, 0), (1, 0.8, 0)
        ),
        "spiral": _round(np.linspace(0.15, 1.0, 10).tolist(), 90, 0),
        "star": _polygon((-0.62, -0.85), (0, 1), (0.62, -0.85), (-1, 0.3), (1, 0.3)),
        "circle, other way": _round([1.0] * 5, 90, 90),
    }
)  # fmt: skip
"""Movements about an object, which is at the origin."""

GOALS: Mapping[str, Glyph] = MappingProxyType(
    {
        "reach from the left": _glyph((-1, 0), (0, 0, -15)),
        "reach from the right": _glyph((1, 0), (0, 0, 15)),
        "reach from above": _glyph((0, 1), (0, 0, 15)),
        "reach from below": _glyph((0, -1), (0, 0, -15)),
    }
)
"""Reaches: their last target is the object."""

SIGN_LABELS = tuple(SIGNS)
MOVEMENT_LABELS = tuple(MOVEMENTS)
GOAL_LABELS = tuple(GOALS)
GLYPHS: Mapping[str, Glyph] = MappingProxyType({**SIGNS, **MOVEMENTS, **GOALS})
