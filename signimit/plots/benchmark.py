"""Figures of the benchmark and its studies. Needs matplotlib (extra ``scripts``)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from signimit.benchmark.results import Summary
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.studies.scaling import CODES, STEPS, Measurement
from signimit.benchmark.studies.tables import Calibration, LessonRow, MethodScore
from signimit.benchmark.tables import ranked
from signimit.exceptions import MissingDependencyError

try:
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None

COLUMNS = 4
_LEARNER, _ORACLE = "#1f5fa8", "#b0722a"
BLUE, GREY, BROWN = "#0571b0", "#777777", "#b35806"


def draw_results(summaries: Sequence[Summary]) -> Figure:
    """Draw the share of commands obeyed with its 95 % interval, entries from top to bottom, oracles in brown."""
    rows = ranked(summaries)
    names = [name for name in SPLITS if any(name in s["splits"] for s in rows)]
    down = -(-len(names) // COLUMNS)
    figure = Figure(figsize=(11, 0.5 + down * (0.8 + 0.17 * len(rows))), layout="constrained")
    panels = figure.subplots(down, COLUMNS, sharex=True, sharey=True, squeeze=False)
    for name, panel in zip(names, panels.flat, strict=False):
        counts = {s["splits"][name]["stages"]["obeyed"]["count"] for s in rows if name in s["splits"]}
        panel.set_title(f"{name}, n = {' or '.join(map(str, sorted(counts)))}", fontsize=9, loc="left")
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
    for number in range(len(names), panels.size):
        panels.flat[number].remove()
        panels.flat[number - COLUMNS].tick_params(axis="x", labelbottom=True)  # now the lowest of its column
    figure.supxlabel("commands obeyed, with 95 % intervals", fontsize=9)
    return figure


def draw_cells(rows: Sequence[MethodScore]) -> Figure:
    """Draw the share of sessions with every inference right: a row for each cell, a column for each method."""
    cells, methods = (list(dict.fromkeys(getattr(row, name) for row in rows)) for name in ("cell", "method"))
    shares = np.full((len(cells), len(methods)), np.nan)
    for row in rows:
        shares[cells.index(row.cell), methods.index(row.method)] = 100 * row.all_right / row.sessions
    figure = Figure(figsize=(2.6 + 0.62 * len(methods), 1.8 + 0.27 * len(cells)), layout="constrained")
    axes = figure.subplots()
    axes.imshow(shares, cmap="Blues", vmin=0, vmax=130, aspect="auto")
    for (y, x), share in np.ndenumerate(shares):
        axes.text(x, y, f"{share:.0f}", ha="center", va="center", fontsize=7, weight="bold" if x == 0 else "normal")
    axes.set_xticks(range(len(methods)), methods, rotation=40, ha="right", fontsize=8)
    axes.set_yticks(range(len(cells)), cells, fontsize=8)
    counts = sorted({row.sessions for row in rows})
    axes.set_title(f"Sessions with every inference right, % of {' or '.join(map(str, counts))}", fontsize=10)
    return figure


def draw_calibration(calibration: Calibration) -> Figure:
    """Draw the reliability diagram and the risk-coverage curve."""
    figure = Figure(figsize=(9, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    left.plot([0, 1], [0, 1], color=GREY, linewidth=0.8)
    left.scatter(calibration.confidence, calibration.accuracy, 10 + 4 * np.sqrt(calibration.counts), color=BLUE)
    for x, y, n in zip(calibration.confidence, calibration.accuracy, calibration.counts, strict=True):
        below = -6 - np.sqrt(10 + 4 * np.sqrt(n)) / 2  # clear of the dot, whose area it is; points
        left.annotate(f"{n}", (x, y), (0, below), textcoords="offset points", fontsize=7, color=GREY, ha="right")
    left.set(xlabel="confidence", ylabel="share that was right", xlim=(0, 1.03), ylim=(0, 1.03))
    left.set_title(f"expected calibration error {calibration.error:.3f}", fontsize=10)
    right.plot(100 * calibration.coverage, 100 * calibration.risk, color=BLUE)
    right.set(xlabel="commands answered, % (the surest first)", ylabel="wrong among them, %", xlim=(0, 100))
    right.set_ylim(bottom=0)
    right.set_title("declining what is doubtful", fontsize=10)
    return figure


def draw_lessons(rows: Sequence[LessonRow]) -> Figure:
    """Draw how much is understood against the number of demonstrations, by what is asked for, a panel for each cell."""
    cells = list(dict.fromkeys(row.cell for row in rows))
    figure = Figure(figsize=(0.6 + 3.1 * len(cells), 3.4), layout="constrained")
    panels = figure.subplots(1, len(cells), squeeze=False, sharey=True)[0]
    for panel, cell in zip(panels, cells, strict=True):
        names = dict.fromkeys(row.asking for row in rows)
        for asking, colour, style in zip(names, (BLUE, BROWN, GREY), ("-", "--", ":"), strict=False):
            mine = [row for row in rows if (row.cell, row.asking) == (cell, asking)]
            count = [row.demonstrations for row in mine]
            panel.plot(count, [100 * row.understood for row in mine], style, color=colour, label=asking)
            low, high = [100 * row.low for row in mine], [100 * row.high for row in mine]
            panel.fill_between(count, low, high, color=colour, alpha=0.15, linewidth=0)
        panel.set(xlabel="demonstrations", ylim=(50, 101))
        panel.set_title(cell, fontsize=9)
    panels[0].set_ylabel("commands understood, %")
    panels[0].legend(fontsize=8, frameon=False, title="asking", title_fontsize=8, loc="lower right")
    return figure


def draw_growth(measurements: Sequence[Measurement]) -> Figure:
    """Draw time and memory against the number of demonstrations, with the extra ``fast`` and without."""
    figure = Figure(figsize=(9, 4), layout="constrained")
    panels = figure.subplots(1, 2)
    for step, colour in zip(STEPS, (BLUE, GREY, BROWN), strict=True):
        for code, style in zip(CODES, ("o-", "o:"), strict=True):
            mine = [m for m in measurements if (m.step, m.code) == (step, code)]
            count = [m.demonstrations for m in mine]
            panels[0].loglog(count, [m.processor_seconds for m in mine], style, color=colour, label=f"{step}, {code}")
            panels[1].loglog(count, [max(m.megabytes, 0.1) for m in mine], style, color=colour)
    panels[0].set(xlabel="demonstrations", ylabel="processor seconds")
    panels[1].set(xlabel="demonstrations", ylabel="memory above the start, MB")
    panels[0].legend(fontsize=8, frameon=False)
    return figure
