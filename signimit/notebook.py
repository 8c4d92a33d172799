"""What a notebook shows of demonstrations, models and responses: small figures beside their words.

Figures are SVG inside of HTML that needs nothing else. Lines have the colour of the text around them, so that they can
be read on light and dark pages; objects have colours and shapes of their own. All text is escaped.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from signimit.names import OBJECT_COLOURS, Names
from signimit.paths import box_centre, half_size, resample_path
from signimit.policies.closed_loop import run_policy

if TYPE_CHECKING:
    from signimit.demonstrations import Demonstration, DemonstrationSet
    from signimit.learning import ImitationModel
    from signimit.responses import Response

Array = NDArray[np.float64]

_MOST_SHOWN = 12  # demonstrations, paths of a movement, signs of a meaning; of more, the first are shown
_POINTS = 80  # of a path
_SIDE, _SMALL = 120, 40  # px of a panel and of a sign
_DOT = 4.5  # px, half of an object's size
_POLYGONS = ((24, 0.0), (4, 45.0), (3, -90.0), (4, 0.0), (5, -90.0), (6, 0.0))  # corners, degrees of the first one
_SECONDS = 8.0  # that a policy is shown moving
_AWAY = 0.15  # m in x and y from the place, where it begins
_ARROWS = 9  # along each side
_EDGE = 0.07  # of a panel's side that stays free


class _Panel:
    """Square figure of paths and places in any unit, x right, y up."""

    def __init__(self, points: Array, side: int = _SIDE) -> None:
        """Fit to points, shape (n, 2)."""
        self._centre, self._side = box_centre(points), side
        self._unit = side * (0.5 - _EDGE) / max(half_size(points), 1e-12)  # px
        self._parts: list[str] = []

    def line(self, path: Array, width: float = 1.2, opacity: float = 1.0, points: int = _POINTS) -> None:
        """Draw a path, shape (T, 2), resampled to so many points."""
        drawn = " ".join(f"{x:.1f},{y:.1f}" for x, y in self._pixels(resample_path(path, points)).tolist())
        look = f'fill="none" stroke="currentColor" stroke-width="{width:g}" stroke-opacity="{opacity:g}"'
        self._parts.append(f'<polyline points="{drawn}" {look} stroke-linejoin="round"/>')

    def start(self, place: Array) -> None:
        """Draw the dot at which a hand begins, shape (2,)."""
        x, y = self._pixels(place).tolist()
        self._parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.4" fill="currentColor"/>')

    def cross(self, place: Array) -> None:
        """Draw the place that a movement is about, shape (2,), where that can be any object."""
        x, y = self._pixels(place).tolist()
        path = f"M{x - 5:.1f} {y:.1f}h10M{x:.1f} {y - 5:.1f}v10"
        self._parts.append(f'<path d="{path}" stroke="#e69f00" stroke-width="2.2"/>')

    def object(self, place: Array, index: int) -> None:
        """Draw an object at a place, shape (2,)."""
        self._parts.append(_object_mark(self._pixels(place), index))

    def arrows(self, places: Array, velocities: Array) -> None:
        """Draw directions of motion at places, both of shape (n, 2), as needles with a dot where they begin."""
        speeds = np.linalg.norm(velocities, axis=1, keepdims=True)
        ends = self._pixels(places) + velocities / np.maximum(speeds, 1e-12) * np.array([1.0, -1.0]) * 7.0
        needles = [
            f"M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}"
            for (x, y), (u, v), (speed,) in zip(self._pixels(places), ends, speeds, strict=True)
            if speed > 0
        ]
        look = 'stroke="currentColor" stroke-opacity="0.4" stroke-width="1"'
        dots = "".join(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.3" fill="currentColor" fill-opacity="0.4"/>'
            for x, y in self._pixels(places).tolist()
        )
        self._parts.append(f'<path d="{"".join(needles)}" fill="none" {look}/>{dots}')

    def svg(self, label: str) -> str:
        """Return the figure; the label is read to those who do not see it."""
        size = f'width="{self._side}" height="{self._side}" viewBox="0 0 {self._side} {self._side}"'
        return f'<svg {size} role="img" aria-label="{escape(label)}">{"".join(self._parts)}</svg>'

    def _pixels(self, points: Array) -> Array:
        return np.asarray(self._side / 2 + (points - self._centre) * np.array([1.0, -1.0]) * self._unit)


def demonstrations_html(demonstrations: DemonstrationSet) -> str:
    """Return the signs and the scene of each demonstration, at most 12, and what the objects are called."""
    names, shown = Names(demonstrations.object_names or ()), demonstrations[:_MOST_SHOWN]
    figures = [_figure(_demonstration_svg(one, t), str(t + 1)) for t, one in enumerate(shown)]
    more = len(demonstrations) - len(figures)
    left_out = [f"<p>and {more} more</p>"] if more else []
    legend = "&emsp;".join(
        f'<svg width="14" height="14" viewBox="0 0 14 14" aria-hidden="true">{_object_mark(np.full(2, 7.0), i)}</svg> '
        f"{escape(names.object(i))}"
        for i in range(len(demonstrations[0].objects))
    )
    return _page(repr(demonstrations), [*figures, *left_out, f"<p>Objects: {legend}. The hand starts at the dot.</p>"])


def model_html(model: ImitationModel) -> str:
    """Return the movements found, the signs of each meaning, and the summary."""
    parts = ["<p>Movements, seen from the object they were about (the cross):</p>"]
    for m, movement in enumerate(model.movements):
        panel = _Panel(np.concatenate([*movement.paths, np.zeros((1, 2))]))
        for path in movement.paths[:_MOST_SHOWN]:
            panel.line(path, 0.9, 0.7)
        panel.cross(np.zeros(2))
        parts.append(
            _figure(panel.svg(model.names.movement(m)), f"{model.names.movement(m)}, {len(movement.members)}×")
        )
    parts.append("<p>Signs, and what they mean:</p>")
    for sign in model.lexicon:
        word = model.word_order.focus if sign.role == "focus" else model.word_order.movement
        number = sign.meaning
        meaning = f"the {model.names.object(number)} object" if sign.role == "focus" else model.names.movement(number)
        drawn = [model.demonstrations[t].signs[word] for t in sign.exemplars[:_MOST_SHOWN]]
        parts.append(_figure(_signs_svg(drawn, f"signs for {meaning}"), f"{meaning}, {len(sign.exemplars)}×"))
    text = f'<pre style="white-space:pre-wrap">{escape(model.summary())}</pre>'
    return _page(repr(model), [*parts, f"<details><summary>In words</summary>{text}</details>"])


def response_html(response: Response) -> str:
    """Return what was asked for, and what the policy does about its place: directions, and 8 s from one start."""
    start = response.place + _AWAY
    path = run_policy(response.policy, start, _SECONDS)
    panel = _Panel(np.vstack([path, response.place]), 2 * _SIDE)
    reach = half_size(np.vstack([path, response.place]))
    ticks = np.linspace(-reach, reach, _ARROWS)
    places = box_centre(np.vstack([path, response.place])) + np.stack(np.meshgrid(ticks, ticks), -1).reshape(-1, 2)
    panel.arrows(places, response.policy(places))
    panel.line(path, 1.6, points=4 * _POINTS)
    panel.start(start)
    panel.object(response.place, response.focus)
    said = f"{response.meaning}, confidence {response.confidence:.0%}"
    figure = _figure(panel.svg(said), f"what the policy does in {_SECONDS:g} s from the dot", 2 * _SIDE)
    return _page(f"Response: {said}", [figure])


def _demonstration_svg(one: Demonstration, number: int) -> str:
    panel = _Panel(np.concatenate([one.hand, one.objects]))
    panel.line(one.hand)
    panel.start(one.hand[0])
    for i, place in enumerate(one.objects):
        panel.object(place, i)
    signs = "".join(_signs_svg([sign], f"sign {word + 1}") for word, sign in enumerate(one.signs))
    return f"<div>{signs}</div>{panel.svg(f'demonstration {number + 1}')}"


def _signs_svg(signs: Sequence[Array], label: str) -> str:
    """Draw signs over each other, all of one size."""
    scaled = [(sign - box_centre(sign)) / half_size(sign) for sign in signs]
    panel = _Panel(np.concatenate(scaled), _SMALL)
    for sign in scaled:
        panel.line(sign, 1.1, 1.0 if len(scaled) == 1 else 0.6)
    return panel.svg(label)


def _object_mark(pixel: Array, index: int) -> str:
    """Return an object's polygon about a pixel, in its colour."""
    corners, first = _POLYGONS[index % len(_POLYGONS)]
    angles = np.radians(first + 360 / corners * np.arange(corners))
    spots = " ".join(f"{pixel[0] + _DOT * np.cos(a):.1f},{pixel[1] + _DOT * np.sin(a):.1f}" for a in angles)
    look = 'stroke="white" stroke-width="0.8"'
    return f'<polygon points="{spots}" fill="{OBJECT_COLOURS[index % len(OBJECT_COLOURS)]}" {look}/>'


def _figure(picture: str, caption: str, width: int = _SIDE) -> str:
    style = f"display:inline-block;vertical-align:top;margin:4px 6px;width:{width}px;text-align:center"
    words = f'<figcaption style="font-size:85%">{escape(caption)}</figcaption>'
    return f'<figure style="{style}">{picture}{words}</figure>'


def _page(title: str, parts: Sequence[str]) -> str:
    return f'<div style="max-width:60em"><p><b>{escape(title)}</b></p>{"".join(parts)}</div>'
