"""What a policy does everywhere, in the manner of the paper's figure 7.

Needs matplotlib, which the extra ``scripts`` installs; nothing else in the package imports this module.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from signimit.benchmark.studies.policies import ShownMovement
from signimit.exceptions import MissingDependencyError
from signimit.policies import run_policy
from signimit.policies.base import Array, Policy

try:
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None
if TYPE_CHECKING:
    pass

HALF_VIEW = 0.28  # m
CORNERS = HALF_VIEW * np.array([[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]])
SECONDS = 12.0
ARROWS = 15  # along each side
REPRODUCTION = ("#d7301f", "#08589e", "#6a3d9a", "#b15928")
DEMONSTRATION, FIELD = "#bdbdbd", "#4d4d4d"


def draw_portraits(policies: Sequence[Policy], lessons: Sequence[ShownMovement]) -> Figure:
    """Draw each policy: its vector field, its demonstrations, and reproductions from four corners.

    Args:
        policies: One for each lesson, of one kind.
        lessons: What each learned from.
    """
    columns = min(len(policies), 4)
    rows = -(-len(policies) // columns)
    figure = Figure(figsize=(3.3 * columns, 3.5 * rows), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False)
    for panel in axes.flat[len(policies) :]:
        panel.set_axis_off()
    side = np.linspace(-HALF_VIEW, HALF_VIEW, ARROWS)
    grid: Array = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    for panel, policy, lesson in zip(axes.flat, policies, lessons, strict=False):
        for path in lesson.paths:
            panel.plot(*path.T, color=DEMONSTRATION, linewidth=0.8, zorder=1)
        velocity = policy(grid)
        panel.quiver(*grid.T, *velocity.T, color=FIELD, alpha=0.55, scale=9.0, width=0.003, zorder=2)
        for start, path, colour in zip(
            CORNERS, np.moveaxis(run_policy(policy, CORNERS, SECONDS), 1, 0), REPRODUCTION, strict=True
        ):
            panel.plot(*path.T, color=colour, linewidth=1.0, zorder=3)
            panel.plot(*start, "o", color=colour, markersize=4, zorder=4)
        panel.plot(0.0, 0.0, "+", color="black", markersize=6, zorder=5)
        panel.set(xlim=(-HALF_VIEW, HALF_VIEW), ylim=(-HALF_VIEW, HALF_VIEW), aspect="equal", xticks=[], yticks=[])
        panel.set_title(lesson.label, fontsize=9)
    figure.suptitle(
        f"{policies[0].kind}: demonstrations (grey), velocity (arrows), {SECONDS:.0f} s from four places (dots)",
        fontsize=10,
    )
    return figure
