"""Figures of the study of what the paper's method needs. Needs matplotlib (extra ``scripts``)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from signimit.benchmark.studies.paper_conditions import IdealGamma, LevelScore, Result
from signimit.benchmark.studies.paper_levels import LADDERS
from signimit.exceptions import MissingDependencyError

try:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None

COLUMNS = 4
COLOURS = {"built-in": "#0571b0", "real": "#b35806"}
AGAINST, ONE_SENSE = "++-", "+++"  # senses of triangle up, triangle down and circle
PAPER_GROUPS, PAPER_DRAWN = 50 / 51, 1.0  # the paper's shares: runs of Algorithm 1, reproductions
GREY = "#777777"
OF_POLICY = ("k nearest points", "speed of the hand")  # factors that grouping does not depend on
OF_GROUPS = ("M_1", "which turns the other way")  # and the policy


def draw_groups(scores: Sequence[LevelScore], results: Sequence[Result], map_: Sequence[IdealGamma]) -> Figure:
    """Draw the share of runs in which Algorithm 1 was right: a panel for each factor, two ladders, a map of γ."""
    factors = [f for f in dict.fromkeys(s.factor for s in scores) if f not in (*OF_POLICY, *LADDERS)]
    down = -(-(len(factors) + 1) // COLUMNS)
    figure = Figure(figsize=(3.1 * COLUMNS, 2.6 * (down + 1.5)), layout="constrained")
    grid = figure.add_gridspec(down + 1, COLUMNS, height_ratios=[1.0] * down + [1.25])
    panels = [figure.add_subplot(grid[i // COLUMNS, i % COLUMNS]) for i in range(len(factors))]
    for factor, panel in zip(factors, panels, strict=True):
        _draw_factor(panel, [s for s in scores if s.factor == factor], "right", PAPER_GROUPS)
    for number, ladder in enumerate(LADDERS):
        panel = figure.add_subplot(grid[down, 2 * number : 2 * number + 2])
        _draw_factor(panel, [s for s in scores if s.factor == ladder], "right", PAPER_GROUPS, whole=True)
        panels.append(panel)
    _draw_map(figure, figure.add_subplot(grid[len(factors) // COLUMNS, len(factors) % COLUMNS]), map_, results)
    figure.legend(
        *panels[1].get_legend_handles_labels(), fontsize=8, frameon=False, loc="outside upper center", ncols=4
    )
    figure.supylabel(
        "runs of Algorithm 1 that find the three movements, % (95 % intervals; dotted: the paper)", fontsize=9
    )
    return figure


def draw_policy(scores: Sequence[LevelScore]) -> Figure:
    """Draw the share of commands that nearest points obeyed when movements and objects were known."""
    known = [s for s in scores if np.isfinite(s.obeyed)]
    factors = [f for f in dict.fromkeys(s.factor for s in known) if f not in (*OF_GROUPS, *LADDERS)]
    down = -(-len(factors) // COLUMNS)
    figure = Figure(figsize=(3.1 * COLUMNS, 2.6 * (down + 1.2)), layout="constrained")
    grid = figure.add_gridspec(down + 1, COLUMNS, height_ratios=[1.0] * down + [1.2])
    panels = [figure.add_subplot(grid[i // COLUMNS, i % COLUMNS]) for i in range(len(factors))]
    for factor, panel in zip(factors, panels, strict=True):
        _draw_factor(panel, [s for s in known if s.factor == factor], "obeyed", PAPER_DRAWN)
    for number, ladder in enumerate(LADDERS):
        panel = figure.add_subplot(grid[down, 2 * number : 2 * number + 2])
        _draw_factor(panel, [s for s in known if s.factor == ladder], "obeyed", PAPER_DRAWN, whole=True)
    figure.legend(
        *panels[0].get_legend_handles_labels(), fontsize=8, frameon=False, loc="outside upper center", ncols=4
    )
    figure.supylabel("commands obeyed, movements known, % (95 % intervals; dotted: the paper)", fontsize=9)
    return figure


def _draw_factor(panel: Axes, scores: Sequence[LevelScore], measure: str, paper: float, whole: bool = False) -> None:
    """Draw a measure against the values of one factor: colour by people, dashed where all turn in one sense.

    With ``whole``, all values of one people are one line, whatever the senses.
    """
    values = list(dict.fromkeys(s.value for s in scores))
    senses = [""] if whole or len({s.senses for s in scores}) > 2 else [AGAINST, ONE_SENSE]
    for people, colour in COLOURS.items():
        for sense in senses:
            mine = [s for s in scores if s.people == people and s.senses.startswith(sense)]
            if not mine:
                continue
            x = np.array([values.index(s.value) for s in mine]) + (0.06 if people == "real" else -0.06)
            share, low, high = (
                100 * np.array([[getattr(s, measure + end) for end in ("", "_low", "_high")] for s in mine]).T
            )
            style = "--" if sense == ONE_SENSE else "-"
            label = f"{people} people" + {"": "", AGAINST: ", circle against", ONE_SENSE: ", one sense"}[sense]
            panel.errorbar(
                x, share, (share - low, high - share), fmt="o", ls=style, color=colour, ms=3, lw=1.1, elinewidth=0.8,
                mfc="white" if sense == ONE_SENSE else colour, label=label,
            )  # fmt: skip
    panel.axhline(100 * paper, color=GREY, lw=0.8, ls=":")
    panel.set_xticks(range(len(values)), values, fontsize=7)
    if max(map(len, values)) * len(values) > (90 if whole else 30):
        panel.set_xticks(range(len(values)), values, fontsize=7, rotation=18, ha="right", rotation_mode="anchor")
    panel.set(ylim=(-4, 104), xlim=(-0.4, len(values) - 0.6))
    panel.tick_params(axis="y", labelsize=7)
    panel.set_title(scores[0].factor, fontsize=9, loc="left")
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)


def _draw_map(figure: Figure, panel: Axes, map_: Sequence[IdealGamma], results: Sequence[Result]) -> None:
    """Draw how often made-up γ is grouped right, and where the usual sessions lie on it."""
    contrasts, spreads = (sorted({getattr(g, name) for g in map_}) for name in ("contrast", "spread"))
    share = np.full((len(spreads), len(contrasts)), np.nan)
    for g in map_:
        share[spreads.index(g.spread), contrasts.index(g.contrast)] = 100 * g.right / g.runs
    image = panel.pcolormesh(contrasts, spreads, share, cmap="Greys_r", vmin=0, vmax=100, shading="nearest")
    figure.colorbar(image, ax=panel, pad=0.02).ax.tick_params(labelsize=7)
    for people, colour in COLOURS.items():
        for senses, face in ((AGAINST, colour), (ONE_SENSE, "white")):
            usual = [r for r in results if (r.people, r.senses, r.factor, r.value) == (people, senses, "M_1", "random")]
            x, y = [r.contrast for r in usual], [r.spread for r in usual]
            panel.plot(x, y, "o", color=colour, mfc=face, ms=3.5, mew=0.9)
    panel.set(xscale="log", xlim=(contrasts[0], contrasts[-1]), ylim=(spreads[0], spreads[-1]))
    ticks = [1, 2, 5, 10, 20]
    panel.set_xticks(ticks, map(str, ticks), fontsize=7)
    panel.minorticks_off()
    panel.tick_params(axis="y", labelsize=7)
    panel.set_xlabel("γ within / between movements", fontsize=7, labelpad=1)
    panel.set_ylabel("spread of ln γ within", fontsize=7, labelpad=1)
    panel.set_title("made-up γ: runs right, %", fontsize=9, loc="left")
