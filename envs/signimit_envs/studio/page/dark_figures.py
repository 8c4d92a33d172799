"""Figures for a dark page: greys are turned over, dark colours made lighter; colours keep their hue."""

from __future__ import annotations

import colorsys
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_INK, _CARD = 0.92, 0.13  # lightness of black and of white on a dark page; the page's own ink and cards
_GREY = 0.12  # largest chroma of a grey
_LIGHT = 0.62  # least lightness of a colour on a dark page
_PROPERTIES = ("color", "facecolor", "edgecolor", "markerfacecolor", "markeredgecolor")


def darken_figure(figure: Figure) -> None:
    """Change the colours of everything in a figure but its images, whose scale of colours stands beside them.

    White lines stay white: they part the cells of an image, and its title says so.
    """
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    figure.draw_without_rendering()  # ticks and their labels are made by then
    artists = figure.findobj(lambda artist: not isinstance(artist, (Axes, type(figure))))  # these have patches
    arrows = [arrow for artist in artists if (arrow := getattr(artist, "arrow_patch", None)) is not None]
    for artist in (*artists, *arrows):
        if isinstance(artist, Line2D) and artist.get_color() == "white":
            continue
        known = [name for name in _PROPERTIES if hasattr(artist, f"get_{name}")]
        found = {name: getattr(artist, f"get_{name}")() for name in known}  # all, before one changes
        artist.set(**{name: _darkened(colour) for name, colour in found.items() if _is_colour(colour)})


def _is_colour(value: Any) -> bool:
    return value is not None and not (isinstance(value, str) and value in ("none", "auto"))


def _darkened(colours: Any) -> NDArray[np.float64]:
    """Return a colour, or an array of them, as RGBA for a dark page."""
    from matplotlib.colors import to_rgba_array

    rows = to_rgba_array(colours)
    changed = np.array([[*_on_dark(*row[:3]), row[3]] for row in rows]).reshape(-1, 4)
    return changed[0] if len(rows) == 1 else changed


def _on_dark(red: float, green: float, blue: float) -> tuple[float, float, float]:
    hue, lightness, saturation = colorsys.rgb_to_hls(red, green, blue)
    if max(red, green, blue) - min(red, green, blue) <= _GREY:
        return colorsys.hls_to_rgb(hue, _INK + (_CARD - _INK) * lightness, saturation)
    return colorsys.hls_to_rgb(hue, max(lightness, _LIGHT), saturation)
