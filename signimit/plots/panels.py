"""Panels of figures about a scene: limits that cut no path off, signs, frames, and the colours of objects.

Needs matplotlib, which the extra ``scripts`` installs; nothing else in signimit imports this module.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import MissingDependencyError
from signimit.names import OBJECT_COLOURS
from signimit.paths import box_centre, half_size

try:
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None
if TYPE_CHECKING:
    from matplotlib.axes import Axes

OBJECT_MARKERS = ("o", "s", "^", "D", "P", "h")  # the colour-blind tell the objects apart by their shapes
FRAME = "#e69f00"
_LEAST_REACH = 0.2  # m to each side of the object that a panel shows at least
_MARGIN = 0.03  # m between paths and the edge of their panel
Paths = Sequence[NDArray[np.float64]]
View = tuple[tuple[float, float], tuple[float, float]]


def make_panels(
    rows: int,
    columns: int,
    size: float,
    heights: float | list[float] | None = None,
    layout: Literal["constrained", "compressed"] = "constrained",
) -> tuple[Figure, NDArray[np.object_]]:
    """Make a figure of panels without ticks, ``size`` inches wide each."""
    each = heights if isinstance(heights, list) else [heights or size] * rows
    figure = Figure(figsize=(columns * size + 0.8, sum(each) + 0.9), layout=layout)
    axes = figure.subplots(rows, columns, squeeze=False, gridspec_kw={"height_ratios": each})
    for panel in axes.ravel():
        panel.set(xticks=[], yticks=[])
    return figure, axes


def draw_sign(panel: Axes, sign: NDArray[np.float64]) -> None:
    """Draw a sign, shape (T_s, 2), as large as the panel."""
    panel.plot(*((sign - box_centre(sign)) / half_size(sign)).T, color="#1b1b1b", linewidth=1.3)
    panel.set(xlim=(-1.3, 1.3), ylim=(-1.3, 1.3), aspect="equal")
    for spine in panel.spines.values():
        spine.set_visible(False)


def find_view(paths: Paths) -> View:
    """Return the limits of x and of y, m, within which no path, (T, 2), m, about an object at the origin is cut off."""
    points = np.concatenate([np.concatenate(paths), [[-_LEAST_REACH] * 2, [_LEAST_REACH] * 2]])
    (left, low), (right, high) = points.min(axis=0) - _MARGIN, points.max(axis=0) + _MARGIN
    return (float(left), float(right)), (float(low), float(high))


def find_aspect(view: View) -> float:
    """Return the height of a view in units of its width."""
    return float(np.ptp(view[1]) / np.ptp(view[0]))


def frame_panel(panel: Axes) -> None:
    """Give a panel a thick frame."""
    for spine in panel.spines.values():
        spine.set(color=FRAME, linewidth=2.5)


def object_colour(focus: int) -> str:
    """Return the colour of an object."""
    return OBJECT_COLOURS[focus % len(OBJECT_COLOURS)]
