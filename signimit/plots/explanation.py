"""A figure that shows why: what each demonstration was about and how surely, what signs mean, in which order.

Needs matplotlib, which the extra ``scripts`` installs; nothing else in signimit imports this module.
"""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import MissingDependencyError
from signimit.explanation import DOUBT, Reasons, ordinal
from signimit.learning import ImitationModel
from signimit.plots.panels import FRAME, View, draw_sign, find_view, object_colour
from signimit.plots.paper import PATH_STYLES
from signimit.responses import Movement

try:
    from matplotlib.figure import Figure
except ImportError:
    raise MissingDependencyError("matplotlib", "scripts", "Drawing figures") from None
if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import SubFigure

_HATCHES = ("", "//", "..", "xx", "\\\\", "++")  # objects are told apart without their colours
_NAME_WIDTH = 26  # characters in a line of a legend or a title
_NONE = "#e4e4e4"  # of a demonstration that is about no object


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
    order = np.lexsort((model.focus, model.labels, model.labels < 0))
    upper, lower = figure.subplots(2, 1, sharex=True)
    at = np.arange(len(order))
    objects = range(reasons.focus_probability.shape[1])
    about = np.column_stack([reasons.focus_probability, np.zeros(len(order))])
    about[model.focus < 0] = np.eye(len(objects) + 1)[-1]
    with_none = len(objects) + bool((model.focus < 0).any())
    names = [*map(model.names.object, objects), "none"][:with_none]
    _stack(upper, about[order, :with_none], names, [*map(object_colour, objects), _NONE])
    names = [*(_movement_name(model, m) for m in range(len(model.movements))), "none"]
    _stack(lower, reasons.movement_probability[order], names, [str(c) for c in np.linspace(0.25, 0.9, len(names))])
    suspected = [suspicion.demonstration for suspicion in reasons.suspicions]
    ambiguous = {doubt.demonstration: doubt for doubt in reasons.ambiguous}
    for x, t in zip(at, order.tolist(), strict=True):
        if t in ambiguous:
            upper.text(x, 1.02, f"?\n{100 * ambiguous[t].apart:.0f} cm", ha="center", va="bottom", fontsize=7)
        marks = "!" * (t in suspected) + "?" * (t in reasons.unsure_movements)
        if marks:
            lower.text(x, 1.02, marks, ha="center", va="bottom", fontsize=8)
    upper.set_ylabel("object")
    lower.set_ylabel("movement")
    lower.set_xticks(at, [str(t + 1) for t in order], fontsize=7)
    lower.set_xlabel("demonstration, sorted by what was found")
    figure.suptitle(
        f"How probable each object and movement is. A ? marks doubt: another one has at least {DOUBT:.0%};\n"
        "between objects it says how far the two lie apart. A ! marks what was more probably not meant so.",
        fontsize=10,
    )


def _movement_name(model: ImitationModel, movement: int) -> str:
    return textwrap.fill(model.names.movement(movement), _NAME_WIDTH)


def _stack(panel: Axes, shares: NDArray[Any], names: list[str], colours: list[str]) -> None:
    below = np.zeros(len(shares))
    for number, name in enumerate(names):
        panel.bar(
            np.arange(len(shares)), shares[:, number], 0.8, below, color=colours[number], label=name,
            hatch=_HATCHES[number % len(_HATCHES)], edgecolor="white", linewidth=0,
        )  # fmt: skip
        below += shares[:, number]
    panel.set(ylim=(0, 1.28), yticks=[0, 0.5, 1])
    panel.spines[["top", "right"]].set_visible(False)
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.4), fontsize=8, frameon=False)


def _draw_lexicon(figure: SubFigure, model: ImitationModel) -> None:
    """Draw the signs of each meaning over each other; below the movements themselves, seen from their objects.

    Each way of writing a meaning has its own style of line.
    """
    objects = model.demonstrations.objects.shape[1]
    columns = max(objects, len(model.movements))
    view = find_view([path for movement in model.movements for path in movement.paths])
    axes = figure.subplots(3, columns, squeeze=False)
    for panel in axes.ravel():
        panel.set(xticks=[], yticks=[])
        panel.set_axis_off()
    for i in range(objects):
        times = _draw_word(axes[0, i], model, "focus", i)
        axes[0, i].set_title(f"{model.names.object(i)}, {times} times", fontsize=9, color=object_colour(i))
    for m, movement in enumerate(model.movements):
        times = _draw_word(axes[1, m], model, "movement", m)
        axes[1, m].set_title(f"{_movement_name(model, m)}, {times} times", fontsize=9)
        axes[2, m].set_axis_on()
        _draw_movement(axes[2, m], movement, view)
    figure.suptitle(
        f"The lexicon: {ordinal(model.word_order.focus)} words name objects (above), "
        f"{ordinal(model.word_order.movement)} words movements (below them)",
        fontsize=10,
    )


def _draw_word(panel: Axes, model: ImitationModel, role: str, meaning: int) -> str:
    """Draw the signs of a meaning, and return how often each way of writing it was seen, "3 + 2"."""
    word = model.word_order.focus if role == "focus" else model.word_order.movement
    forms = [sign.exemplars for sign in model.lexicon if (sign.role, sign.meaning) == (role, meaning)]
    for number, exemplars in enumerate(forms):
        for t in exemplars:
            draw_sign(panel, model.demonstrations[t].signs[word])
            panel.get_lines()[-1].set(alpha=0.6, linewidth=1.0, linestyle=PATH_STYLES[number % len(PATH_STYLES)])
    return " + ".join(str(len(exemplars)) for exemplars in forms) or "0"


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
