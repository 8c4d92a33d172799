"""A figure that shows why: what each demonstration was about and how surely, what signs mean, in which order.

Needs matplotlib, which the extra ``scripts`` installs; nothing else in signimit imports this module.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import MissingDependencyError
from signimit.explanation import DOUBT, Reasons, object_name, ordinal
from signimit.learning import ImitationModel, Movement
from signimit.plots.panels import FRAME, View, draw_sign, find_view, object_colour

try:
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None
if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import SubFigure

_HATCHES = ("", "//", "..", "xx", "\\\\", "++")  # objects are told apart without their colours


def draw_explanation(model: ImitationModel) -> Figure:
    """Draw the reasons of a model: probabilities of foci and movements, the lexicon, evidence for the word order.

    Raises:
        InvalidInputError: If the model's method has no probabilities to tell.
    """
    reasons = model.explain()
    meanings = max(reasons.focus_probability.shape[1], len(model.movements))
    figure = Figure(figsize=(max(9.0, 1.35 * meanings), 9.6), layout="constrained")
    heights = [3.6, 4.4, 1.0 + 0.25 * len(reasons.word_orders)]
    parts = figure.subfigures(3, 1, squeeze=False, height_ratios=heights)[:, 0]
    _draw_beliefs(parts[0], model, reasons)
    _draw_lexicon(parts[1], model)
    _draw_orders(parts[2].subplots(), reasons)
    return figure


def _draw_beliefs(figure: SubFigure, model: ImitationModel, reasons: Reasons) -> None:
    """Draw a bar for each demonstration, sorted by the movement and object found; what is in doubt has a mark."""
    order = np.lexsort((model.focus, model.labels))
    upper, lower = figure.subplots(2, 1, sharex=True)
    at = np.arange(len(order))
    _stack(upper, reasons.focus_probability[order], [object_name(i) for i in range(reasons.focus_probability.shape[1])])
    names = [f"movement {m + 1}" for m in range(len(model.movements))] + ["another"]
    _stack(lower, reasons.movement_probability[order], names, grey=True)
    ambiguous = {doubt.demonstration: doubt for doubt in reasons.ambiguous}
    for x, t in zip(at, order.tolist(), strict=True):
        if t in ambiguous:
            upper.text(x, 1.02, f"?\n{100 * ambiguous[t].apart:.0f} cm", ha="center", va="bottom", fontsize=7)
        if t in reasons.unsure_movements:
            lower.text(x, 1.02, "?", ha="center", va="bottom", fontsize=8)
    upper.set_ylabel("object")
    lower.set_ylabel("movement")
    lower.set_xticks(at, [str(t + 1) for t in order], fontsize=7)
    lower.set_xlabel("demonstration, sorted by what was found")
    figure.suptitle(
        f"How probable each object and movement is. A ? marks doubt: another one has at least {DOUBT:.0%};\n"
        "between objects it says how far the two lie apart.",
        fontsize=10,
    )


def _stack(panel: Axes, shares: NDArray[Any], names: list[str], grey: bool = False) -> None:
    below = np.zeros(len(shares))
    shades = np.linspace(0.25, 0.9, len(names))
    for number, name in enumerate(names):
        colour = str(shades[number]) if grey else object_colour(number)
        panel.bar(
            np.arange(len(shares)), shares[:, number], 0.8, below, color=colour, label=name,
            hatch=_HATCHES[number % len(_HATCHES)], edgecolor="white", linewidth=0,
        )  # fmt: skip
        below += shares[:, number]
    panel.set(ylim=(0, 1.28), yticks=[0, 0.5, 1])
    panel.spines[["top", "right"]].set_visible(False)
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.4), fontsize=8, frameon=False)


def _draw_lexicon(figure: SubFigure, model: ImitationModel) -> None:
    """Draw the signs of each meaning over each other; below the movements themselves, seen from their objects."""
    objects = model.demonstrations.objects.shape[1]
    columns = max(objects, len(model.movements))
    view = find_view([path for movement in model.movements for path in movement.paths])
    axes = figure.subplots(3, columns, squeeze=False)
    for panel in axes.ravel():
        panel.set(xticks=[], yticks=[])
        panel.set_axis_off()
    for i in range(objects):
        members = np.flatnonzero(model.focus == i)
        _draw_word(axes[0, i], model, model.word_order.focus, members)
        axes[0, i].set_title(f"{object_name(i)}, {len(members)} times", fontsize=9, color=object_colour(i))
    for m, movement in enumerate(model.movements):
        _draw_word(axes[1, m], model, model.word_order.movement, np.array(movement.members))
        axes[1, m].set_title(f"movement {m + 1}, {len(movement.members)} times", fontsize=9)
        axes[2, m].set_axis_on()
        _draw_movement(axes[2, m], movement, view)
    figure.suptitle(
        f"The lexicon: {ordinal(model.word_order.focus)} words name objects (above), "
        f"{ordinal(model.word_order.movement)} words movements (below them)",
        fontsize=10,
    )


def _draw_word(panel: Axes, model: ImitationModel, word: int, members: NDArray[Any]) -> None:
    for t in members:
        draw_sign(panel, model.demonstrations[int(t)].signs[word])
    for line in panel.get_lines():
        line.set(alpha=0.6, linewidth=1.0)


def _draw_movement(panel: Axes, movement: Movement, view: View) -> None:
    """Draw all members, each seen from the object it is about, which is the cross."""
    for path in movement.paths:
        panel.plot(*path.T, color="#1b1b1b", linewidth=0.7, alpha=0.6)
    panel.plot(0, 0, "+", color=FRAME, markersize=11, markeredgewidth=2.5)
    panel.set(xlim=view[0], ylim=view[1], aspect="equal")


def _draw_orders(panel: Axes, reasons: Reasons) -> None:
    names = [f"{ordinal(o.focus)} word object, {ordinal(o.movement)} movement" for o, _ in reasons.word_orders]
    losses = [loss for _, loss in reasons.word_orders]
    panel.barh(np.arange(len(names)), losses, color="#777777")
    for y, loss in enumerate(losses):
        panel.text(loss, y, "  chosen" if y == 0 else f"  {loss:.1f}", va="center", fontsize=8)
    panel.set_yticks(range(len(names)), names, fontsize=8)
    panel.invert_yaxis()
    panel.set(xlabel="nats less explained than by the chosen word order", xlim=(0, 1.15 * max(losses) + 1))
    panel.spines[["top", "right"]].set_visible(False)
