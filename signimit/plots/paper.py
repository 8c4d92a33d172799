"""The paper's figures 4 to 7, and the memberships as they form. Figures count from 1, as people do.

Needs matplotlib, which the extra ``scripts`` installs; nothing else in signimit imports this module.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import MissingDependencyError
from signimit.names import UNNAMED, Names
from signimit.paths import arc_lengths
from signimit.plots.panels import (
    OBJECT_MARKERS,
    Paths,
    View,
    draw_sign,
    find_aspect,
    find_view,
    frame_panel,
    make_panels,
    object_colour,
)

try:
    from matplotlib import colormaps
    from matplotlib.colors import LogNorm, Normalize
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None
if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

PATH_COLOURS = ("#1b1b1b", "#7b3294", "#0571b0", "#b35806")  # repeated attempts; no colour of an object
PATH_STYLES = ("-", "--", "-.", ":")  # the same attempts on paper without colours
_UNDEFINED = "#c8c8c8"  # of the similarity of a demonstration with itself


def draw_demonstrations(demonstrations: DemonstrationSet, labels: ArrayLike, focus: ArrayLike) -> Figure:
    """Draw all demonstrations seen from each object, the signs above (the paper's figure 4).

    Args:
        demonstrations: What was seen.
        labels: Movement found in each demonstration, shape (N,), -1 for none; columns are sorted by it.
        focus: Object found for each demonstration, shape (N,), -1 for none; its panel is framed.

    Returns:
        One column a demonstration, one row a sign and a row for each object.
    """
    movement, about = np.asarray(labels), np.asarray(focus)
    order = np.lexsort((about, movement, movement < 0))
    words, objects = len(demonstrations[0].signs), demonstrations.objects.shape[1]
    names = Names(demonstrations.object_names or ())
    view = find_view([d.hand - place for d in demonstrations for place in d.objects])
    figure, axes = make_panels(
        words + objects, len(order), 1.3, heights=[0.8] * words + [1.3 * find_aspect(view)] * objects
    )
    for column, t in enumerate(order):
        demonstration = demonstrations[int(t)]
        for word, sign in enumerate(demonstration.signs):
            draw_sign(axes[word, column], sign)
        for i, place in enumerate(demonstration.objects):
            panel = axes[words + i, column]
            _draw_about(panel, [demonstration.hand - place], i, view)
            if i == about[t]:
                frame_panel(panel)
        found = f"movement {movement[t] + 1}" if movement[t] >= 0 else "no movement"
        axes[0, column].set_title(f"{t + 1}\n{found}", fontsize=8)
    for word in range(words):
        axes[word, 0].set_ylabel(f"sign {word + 1}", fontsize=9)
    for i in range(objects):
        axes[words + i, 0].set_ylabel(f"seen from {names.object(i)}", fontsize=9, color=object_colour(i))
    figure.suptitle(
        f"{len(order)} demonstrations, sorted by the movement found; the object found is framed. "
        f"Panels are {np.ptp(view[0]):.1f} m wide, the hand starts at the dot.",
        fontsize=10,
    )
    return figure


def draw_similarities(similarities: NDArray[np.float64], labels: ArrayLike, names: Names = UNNAMED) -> Figure:
    """Draw the similarity of demonstrations in all pairs of frames (the paper's figure 5), on a logarithmic scale.

    Args:
        similarities: γ_{t;k;i;j}, shape (N, N, O, O), 1/rad².
        labels: Movement of each demonstration, shape (N,); demonstrations are sorted by it.
        names: What the objects are called.
    """
    order, cuts = _sorted_by(labels)
    shown = similarities[np.ix_(order, order)].copy()
    shown[np.arange(len(order)), np.arange(len(order))] = 0.0
    objects = shown.shape[2]
    figure, axes = make_panels(objects, objects, 2.6, heights=2.3, layout="compressed")
    least, most = float(shown[shown > 0].min()), float(shown.max())
    for i in range(objects):
        for j in range(objects):
            image = _draw_matrix(axes[i, j], shown[:, :, i, j], order, cuts, LogNorm(least, most))
        axes[i, 0].set_ylabel(f"t seen from {names.object(i)}", color=object_colour(i))
        axes[0, i].set_title(f"k seen from {names.object(i)}", color=object_colour(i), fontsize=10)
    bar = figure.colorbar(image, ax=axes.ravel().tolist(), shrink=0.6, label="similarity γ, 1/rad²")
    round_numbers = np.multiply.outer(10.0 ** np.arange(-4, 5), [1.0, 2.0, 5.0]).ravel()
    ticks = round_numbers[(round_numbers >= least) & (round_numbers <= most)]
    bar.set_ticks(ticks.tolist(), labels=[f"{tick:g}" for tick in ticks])
    bar.ax.minorticks_off()
    figure.suptitle(
        "Similarity of demonstrations t (rows) and k (columns) in each pair of frames.\n"
        "White lines part the movements found; grey: a demonstration with itself, undefined.",
        fontsize=10,
    )
    return figure


def draw_maximum_similarity(similarity: NDArray[np.float64], labels: ArrayLike) -> Figure:
    """Draw the largest similarity of each two demonstrations over all frames (the paper's figure 6).

    Args:
        similarity: γ_{t;k}, shape (N, N), 1/rad².
        labels: Movement of each demonstration, shape (N,); demonstrations are sorted by it.
    """
    order, cuts = _sorted_by(labels)
    figure, axes = make_panels(1, 1, 4.6)
    shown = similarity[np.ix_(order, order)]
    image = _draw_matrix(axes[0, 0], shown, order, cuts, Normalize(0.0, float(shown.max())))
    axes[0, 0].set(xlabel="demonstration k", ylabel="demonstration t")
    axes[0, 0].set_title("Maximum similarity; white lines part the movements found", fontsize=10)
    figure.colorbar(image, ax=axes.ravel().tolist(), shrink=0.8, label="similarity γ, 1/rad²")
    return figure


def draw_reproductions(
    paths: Mapping[tuple[int, int], Paths],
    obeyed: Mapping[tuple[int, int], Sequence[bool | None]],
    movements: Sequence[str],
    unseen: frozenset[tuple[int, int]],
    imitator: str = "",
    names: Names = UNNAMED,
) -> Figure:
    """Draw what the hand did for each pair of signs, seen from the object asked for (the paper's figure 7).

    Args:
        paths: Hand paths in that object's frame, each (T, 2), m, by (movement, focus).
        obeyed: Whether each of these paths did what was asked for, none if nobody judged it; those that did not end
            with a cross.
        movements: Names of the movements.
        unseen: The pairs that were never demonstrated; their panels are framed.
        imitator: Whose reproductions these are, for the title.
        names: What the objects are called.
    """
    objects = 1 + max(focus for _, focus in paths)
    view = find_view([path for attempts in paths.values() for path in attempts])
    figure, axes = make_panels(len(movements), objects, 3.0, heights=3.0 * find_aspect(view) + 0.1, layout="compressed")
    for (movement, focus), attempts in paths.items():
        panel = axes[movement, focus]
        verdicts = obeyed[movement, focus]
        _draw_about(panel, attempts, focus, view, verdicts)
        note = _verdict_note(verdicts)
        if (movement, focus) in unseen:
            frame_panel(panel)
            note = f"never demonstrated, {note}"
        panel.set_title(note, fontsize=9, loc="left", pad=3)
    for row, name in enumerate(movements):
        axes[row, 0].set_ylabel(name, fontsize=11)
    for focus in range(objects):
        axes[-1, focus].set_xlabel(f"about {names.object(focus)}", color=object_colour(focus), fontsize=11)
    most = max(map(len, paths.values()))
    handles = [Line2D([], [], **_path_look(n), label=f"start {n + 1}") for n in range(min(most, 8))]
    marks = (("o", "where the hand starts"), (">", "direction"), ("x", "end of a path that did not obey"))
    handles += [Line2D([], [], color=PATH_COLOURS[0], linestyle="", marker=m, label=text) for m, text in marks]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=9, frameon=False)
    figure.suptitle(
        f"{f'{imitator}: ' if imitator else ''}{sum(map(len, paths.values()))} reproductions by the simulated arm, "
        f"seen from the object asked for. Panels are {np.ptp(view[0]):.1f} m wide.",
        fontsize=11,
    )
    return figure


def _verdict_note(verdicts: Sequence[bool | None]) -> str:
    judged = [right for right in verdicts if right is not None]
    if not judged:
        return "not judged"
    return f"{sum(judged)} of {len(judged)} obeyed" + (", others not judged" if len(judged) < len(verdicts) else "")


def draw_memberships(history: NDArray[np.float64], labels: ArrayLike) -> Figure:
    """Draw how each demonstration's memberships form over the steps of Algorithm 1.

    Args:
        history: M before the first step and after each, shape (S + 1, N, N).
        labels: Movement of each demonstration, shape (N,); the groups are named by the movements they became.
    """
    order, _ = _sorted_by(labels)
    movement = np.asarray(labels)
    columns, last = 4, len(history) - 1
    figure, axes = make_panels(-(-len(order) // columns), columns, 2.2, heights=1.5)
    group = history[-1].argmax(axis=0)
    winners = list(dict.fromkeys(group[order].tolist()))
    for panel, t in zip(axes.ravel(), order, strict=False):
        for m in range(history.shape[1]):
            if m not in winners:
                panel.plot(history[:, m, t], color="#bbbbbb", linewidth=0.7)
        for number, m in enumerate(winners):
            became = " and ".join(str(k + 1) for k in np.unique(movement[group == m]))
            style = PATH_STYLES[number % len(PATH_STYLES)]
            panel.plot(history[:, m, t], style, color=_distinct(number), label=f"movement {became} (group {m + 1})")
        panel.set(ylim=(-0.03, 1.03), xlim=(0, last), xticks=[0, last // 2, last], yticks=[0, 1])
        panel.set_title(f"demonstration {t + 1} (movement {movement[t] + 1})", fontsize=8)
        panel.tick_params(labelsize=7)
    for panel in axes.ravel()[len(order) :]:
        panel.set_axis_off()
    handles = [*axes[0, 0].get_legend_handles_labels()[0], Line2D([], [], color="#bbbbbb", label="the other groups")]
    figure.legend(handles=handles, loc="outside lower center", ncols=min(len(handles), 5), fontsize=8, frameon=False)
    for panel in axes[:, 0]:
        panel.set_ylabel("membership", fontsize=8)
    for panel in axes.ravel()[: len(order)][-columns:]:
        panel.set_xlabel("step", fontsize=8)
    figure.suptitle("Membership of each demonstration in each group, over the steps of Algorithm 1", fontsize=10)
    return figure


def _draw_about(panel: Axes, paths: Paths, focus: int, view: View, obeyed: Sequence[bool | None] | None = None) -> None:
    """Draw paths, each (T, 2), m, about an object at the origin; with arrows and crosses if they are judged."""
    for number, path in enumerate(paths):
        look = _path_look(number)
        panel.plot(*path.T, **look, linewidth=1.0, alpha=0.85)
        panel.plot(*path[0], ".", color=look["color"], markersize=7)
        if obeyed is None:
            continue
        _draw_arrow(panel, path, 0.35 + 0.1 * (number % 5), look["color"])
        if obeyed[number] is False:
            panel.plot(*path[-1], "x", color=look["color"], markersize=7, markeredgewidth=1.6)
    marker = OBJECT_MARKERS[focus % len(OBJECT_MARKERS)]
    panel.plot(
        0,
        0,
        marker,
        color=object_colour(focus),
        markersize=7 if obeyed is None else 9,
        markeredgecolor="white",
        zorder=3,
    )
    panel.set(xlim=view[0], ylim=view[1], aspect="equal")


def _draw_arrow(panel: Axes, path: NDArray[np.float64], share: float, colour: str) -> None:
    """Draw an arrow head along a path, (T, 2), at a share of its length; none on a path that rests."""
    way = arc_lengths(path)
    tip = int(np.searchsorted(way, share * way[-1]))
    tail = int(np.searchsorted(way, way[tip] - 0.01, side="right")) - 1  # m; shorter is no direction
    if tail >= 0:
        style = {"arrowstyle": "-|>", "color": colour, "mutation_scale": 13, "shrinkA": 0, "shrinkB": 0}
        panel.annotate("", path[tip], path[tail], arrowprops=style)


def _path_look(number: int) -> dict[str, Any]:
    """Return the colour and the line style of one of 16 starts, no two of which look alike."""
    turn = number + number // len(PATH_STYLES)
    return {"color": PATH_COLOURS[turn % len(PATH_COLOURS)], "linestyle": PATH_STYLES[number % len(PATH_STYLES)]}


def _draw_matrix(
    panel: Axes, matrix: NDArray[np.float64], order: NDArray[np.intp], cuts: NDArray[np.intp], scale: Normalize
) -> AxesImage:
    image = panel.imshow(matrix, cmap=colormaps["viridis"].with_extremes(bad=_UNDEFINED, under=_UNDEFINED), norm=scale)
    for cut in cuts:
        panel.axhline(cut - 0.5, color="white", linewidth=1.0)
        panel.axvline(cut - 0.5, color="white", linewidth=1.0)
    numbers = [str(t + 1) for t in order]
    panel.set_xticks(range(len(order)), numbers, fontsize=6)
    panel.set_yticks(range(len(order)), numbers, fontsize=6)
    return image


def _sorted_by(labels: ArrayLike) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return demonstrations sorted by movement, those of none last, and where in that order movements change."""
    movement = np.asarray(labels)
    order = np.lexsort((movement, movement < 0))
    return order, np.flatnonzero(np.diff(movement[order])) + 1


def _distinct(number: int) -> str:
    """Return a colour of the Okabe-Ito palette."""
    palette = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
    return palette[number % len(palette)]
