"""The figure of the benchmark: commands obeyed, a panel for each split. Needs matplotlib (extra ``scripts``)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from signimit.benchmark.results import Summary
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.tables import ranked
from signimit.exceptions import MissingDependencyError

try:
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None

COLUMNS = 4
_LEARNER, _ORACLE = "#1f5fa8", "#b0722a"


def draw_results(summaries: Sequence[Summary]) -> Figure:
    """Draw the share of commands obeyed with its 95 % interval, entries from top to bottom, oracles in brown."""
    rows = ranked(summaries)
    names = [name for name in SPLITS if any(name in s["splits"] for s in rows)]
    down = -(-len(names) // COLUMNS)
    figure = Figure(figsize=(11, 0.5 + down * (0.8 + 0.17 * len(rows))), layout="constrained")
    panels = figure.subplots(down, COLUMNS, sharex=True, sharey=True, squeeze=False)
    for name, panel in zip(names, panels.flat, strict=False):
        _draw_split(panel, name, rows)
    for panel in panels.flat[len(names) :]:
        panel.remove()
    figure.supxlabel("commands obeyed, with 95 % intervals", fontsize=9)
    return figure


def _draw_split(panel: Any, name: str, rows: Sequence[Summary]) -> None:
    panel.set_title(name, fontsize=9, loc="left")
    for place, summary in enumerate(rows):
        if name in summary["splits"]:
            found = summary["splits"][name]["stages"]["obeyed"]
            colour = _ORACLE if summary["oracle"] else _LEARNER
            panel.plot([found["low"], found["high"]], [place, place], color=colour, lw=1.2)
            panel.plot(found["mean"], place, "o", color=colour, ms=3.5)
    panel.set_yticks(range(len(rows)), [s["entry"] for s in rows], fontsize=7)
    panel.set_ylim(len(rows) - 0.5, -0.5)
    panel.set_xlim(-0.02, 1.02)
    panel.tick_params(axis="x", labelsize=7)
    panel.grid(axis="x", color="#dddddd", lw=0.6)
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)
