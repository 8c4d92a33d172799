"""Figure of how unlike people draw one thing, real and built-in. Needs matplotlib (extra ``scripts``)."""

from __future__ import annotations

import numpy as np

from signimit.benchmark.studies.clumsiness import MEASURES, Strangers
from signimit.exceptions import MissingDependencyError

try:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None

EXAMPLES = 8  # drawings of each thing that are shown
_LIMITS = {"dissimilarity": (-12.0, 6.0), "misfit": (0.0, 2.0)}
_UNITS = {"dissimilarity": "dissimilarity, nats", "misfit": "misfit, half sizes"}
_COLOURS = ("#222222", "#999999", "#0571b0")  # real, usual, clumsy


def draw_clumsiness(real: Strangers, usual: Strangers, clumsy: Strangers) -> Figure:
    """Draw what real, usual and clumsy people draw, and below it how unlike two of them draw one thing.

    A curve is the share of pairs below a value, thin for each thing, thick their mean.
    """
    figure = Figure(figsize=(11, 6.8), layout="constrained")
    rows = figure.add_gridspec(2, 1, height_ratios=(0.9, 1.0))
    above, below = figure.add_subfigure(rows[0, 0]), figure.add_subfigure(rows[1, 0])
    columns = above.add_gridspec(1, len(_COLOURS))
    for number, (one, colour) in enumerate(zip((real, usual, clumsy), _COLOURS, strict=True)):
        _draw_examples(above.add_subfigure(columns[0, number]), one, colour)
    for measure, panel in zip(MEASURES, below.subplots(1, 2), strict=True):
        for one, colour in zip((real, usual, clumsy), _COLOURS, strict=True):
            _draw_shares(panel, one, measure, colour)
        panel.set(
            xlim=_LIMITS[measure], ylim=(0, 1), xlabel=f"{_UNITS[measure]}, of two people's drawings of one thing"
        )
        panel.grid(color="#dddddd", lw=0.6)
        for side in ("top", "right"):
            panel.spines[side].set_visible(False)
    panels = below.axes
    panels[0].set_ylabel("share of pairs")
    panels[0].legend(fontsize=8, frameon=False, loc="upper left")
    return figure


def _draw_examples(part: SubFigure, one: Strangers, colour: str) -> None:
    """Draw what the first people drew, a column for each thing; a dot is where a drawing begins."""
    part.suptitle(one.people, fontsize=10, color=colour)
    panels = part.subplots(EXAMPLES // 2, len(one.drawings), squeeze=False)
    for column, drawn in zip(panels.T, one.drawings.values(), strict=True):
        for number, panel in enumerate(column):
            for place, path in enumerate(drawn[2 * number : 2 * number + 2]):
                middle = path - (path.max(axis=0) + path.min(axis=0)) / 2 + (0.25 * place, 0.0)
                panel.plot(*middle.T, color=colour, lw=1.0)
                panel.plot(*middle[0], ".", color=colour, ms=4)
            panel.set(xlim=(-0.12, 0.37), ylim=(-0.12, 0.12), aspect="equal")
            panel.set_axis_off()


def _draw_shares(panel: Axes, one: Strangers, measure: str, colour: str) -> None:
    at = np.linspace(*_LIMITS[measure], 400)
    shares = [np.searchsorted(np.sort(v), at, side="right") / len(v) for v in one.measured(measure).values()]
    for share in shares:
        panel.plot(at, share, color=colour, lw=0.6, alpha=0.5)
    panel.plot(at, np.mean(shares, axis=0), color=colour, lw=2.0, label=one.people)
