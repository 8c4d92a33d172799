"""Names of movements from their shapes: "like a triangle, clockwise", where the drawings leave no doubt.

The guess is for people's eyes: nothing is learned from it. One round of each drawing is stretched to equal extents, and
its directions, one complex number a sample, are compared with those of a few shapes by circular correlation: place,
size, angle, proportions and where the round began do not matter.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.paths import arc_lengths, half_size, resample_path, unit_tangents
from signimit.segmentation import find_drawing

Array = NDArray[np.float64]

SHAPES = ("circle", "triangle", "square", "five-pointed star", "figure of eight")
_TRIANGLE, _FIGURE_EIGHT = SHAPES.index("triangle"), SHAPES.index("figure of eight")
_LONG_NAMES = {"circle": "an ellipse", "square": "a four-sided figure"}
_TIMES = {1: "", 2: ", twice", 3: ", three times", 4: ", four times"}

_MOST = 8  # drawings of a movement that are looked at
_SAMPLES = 64  # of a round
_SMOOTHED = 2  # samples to each side over which a direction is averaged: corners that are drawn by hand are round
_LIKE = 0.95  # least mean correlation with the most alike shape; circle and triangle have 0.9
_CLEARER = 0.015  # by which that of every other shape is less; circle and square are 0.05 apart
_AGREE = 0.75  # share of the drawings that have to agree
_STEPS = 120  # into which a drawing is cut to find its rounds
_SHORTEST = 12  # steps of a round
_AROUND = 5  # steps before and after, among which a gap between rounds is the least
_AGAIN, _CLOSED = 0.3, 0.45  # half sizes: mean gap between rounds of a drawing, and gap between the ends of one
_AS_NEAR = 0.1  # half sizes by which rounds may lie further apart than the nearest: half a star is no round
_STRAIGHT = 0.97  # least share of a line's length that lies between its ends
_FLAT = 0.1  # ratio of extents below which a drawing that comes back is a line, which has no name
_LONG = 0.7  # ratio of extents below which there are other names
_LIKE_TURNED, _TURNED = 0.8, 0.7  # triangles point the same way, and that way within 15 degrees: cos(3 * 15 degrees)
_COUNTED = 0.3  # rounds by which drawings may differ from a whole number of rounds
_REPEATED = 1.5  # rounds of a drawing that surely goes on; less may be a reach that was taken for a part of it


class _Look(NamedTuple):
    """What one drawing looks like.

    Attributes:
        correlation: With each shape, drawn counter-clockwise and clockwise, complex, shape (S, 2): how much alike, and
            how far turned.
        extent: Smaller extent of a round in units of the larger; 0 if there is no round.
        rounds: How many rounds it has; 0 if it does not come back to where it began.
        straight: Share of its length that lies between its ends.
    """

    correlation: NDArray[np.complex128]
    extent: float
    rounds: float
    straight: float


def guess_shape(paths: Sequence[Array], stamps: Sequence[Array]) -> str:
    """Say what the drawings of a movement look like, if that is beyond doubt.

    Circles, triangles, squares, five-pointed stars, figures of eight and straight lines are known. Three of four
    drawings have to be most like the same shape, and all of them together clearly more like it than any other.

    Args:
        paths: Hand paths in the frame of the object, reach and way home included, each of shape (T, 2), m; at least
            one.
        stamps: Their times, each of shape (T,), s.

    Returns:
        What they are like, seen from above; empty where that is in doubt.

    Example:
        >>> import numpy as np
        >>> angles, times = np.linspace(0, 4 * np.pi, 200), np.linspace(0, 4, 200)
        >>> guess_shape([0.1 * np.column_stack([np.cos(angles), np.sin(angles)])], [times])
        'like a circle, counter-clockwise, twice'
    """
    count = min(_MOST, len(paths))
    chosen = [i * len(paths) // count for i in range(count)]
    looks = [_look(paths[i][find_drawing(paths[i], stamps[i])]) for i in chosen]
    extent = float(np.median([look.extent for look in looks]))
    if _most(look.straight > _STRAIGHT for look in looks):
        return "like a straight line"
    if not _most(look.rounds > 0 for look in looks):
        return ""
    found = np.stack([look.correlation for look in looks])  # (n, S, 2)
    alike = np.abs(found)
    shape = int(alike.max(axis=2).mean(axis=0).argmax())
    clockwise = bool(alike[:, shape].mean(axis=0).argmax())
    others, mean = np.delete(alike, shape, axis=1).max(axis=(1, 2)), alike[:, shape, int(clockwise)].mean()
    if mean < _LIKE or mean - others.mean() < _CLEARER or not _most(alike[:, shape].max(axis=1) > others):
        return ""
    times = _times([look.rounds for look in looks])
    if times is None:
        return ""
    name, way = f"a {SHAPES[shape]}", ", clockwise" if clockwise else ", counter-clockwise"
    if extent < _LONG:
        name = _LONG_NAMES.get(SHAPES[shape], name)
    if shape == _TRIANGLE:
        name += _pointing(found[:, shape, int(clockwise)])
    if shape == _FIGURE_EIGHT:
        way = ""  # it goes both ways round
    return f"like {name}{way}{times}"


def _most(votes: Iterable[bool]) -> bool:
    return float(np.mean(list(votes))) >= _AGREE


def _pointing(correlation: NDArray[np.complex128]) -> str:
    """Say where triangles point, if they agree on it.

    The phase of a correlation is how far a triangle that points right has to be turned, up to thirds of a turn.
    """
    seen = correlation[np.abs(correlation) > 0]
    mean = ((seen / np.abs(seen)) ** 3).mean()
    if abs(mean) < _LIKE_TURNED:
        return ""
    ways = {" pointing right": 1, " pointing up": -1j, " pointing left": -1, " pointing down": 1j}
    return next((name for name, way in ways.items() if (mean / abs(mean) * np.conj(way)).real > _TURNED), "")


def _times(rounds: list[float]) -> str | None:
    """Say how often drawings go round, if they agree on it, or that all do so again and again; None if in doubt."""
    whole = round(float(np.median(rounds)))
    if whole in _TIMES and _most(abs(each - whole) <= _COUNTED for each in rounds):
        return _TIMES[whole]
    return ", again and again" if _most(each > _REPEATED for each in rounds) else None


def _look(drawing: Array) -> _Look:
    """Look at a drawing without its reach, shape (T, 2), m."""
    straight = float(np.hypot(*(drawing[-1] - drawing[0])) / arc_lengths(drawing)[-1])
    share, extent = _find_round(drawing), 0.0
    correlation = np.zeros((len(SHAPES), 2), dtype=np.complex128)
    if share:
        fine = 4 * _SAMPLES
        once = resample_path(drawing, fine)[: round(share * fine)]
        least, most = np.linalg.eigvalsh(np.cov(once.T))
        extent = float(np.sqrt(max(least, 0.0) / most))
        if extent >= _FLAT:
            all_shifts = np.fft.ifft(np.fft.fft(_directions(once)) * _spectra())
            best = np.abs(all_shifts).argmax(axis=-1, keepdims=True)
            correlation = np.take_along_axis(all_shifts, best, axis=-1)[..., 0]
    return _Look(correlation, extent, 1 / share if share else 0.0, straight)


def _find_round(drawing: Array) -> float:
    """Return the share of a drawing, shape (T, 2), after which it passes where it has been; 0 if it never does."""
    points, unit = resample_path(drawing, _STEPS + 1), half_size(drawing)
    gaps = np.zeros(_STEPS + 1)
    for lag in range(1, _STEPS + 1):
        gaps[lag] = np.hypot(*(points[lag:] - points[: len(points) - lag]).T).mean() / unit
    dips = [lag for lag in range(_SHORTEST, _STEPS) if gaps[lag] == gaps[lag - _AROUND : lag + _AROUND + 1].min()]
    nearest = min((float(gaps[lag]) for lag in dips), default=np.inf)
    for lag in dips:
        if gaps[lag] <= min(nearest + _AS_NEAR, _AGAIN):
            return lag / _STEPS
    return float(gaps[-1] <= _CLOSED)


def _directions(drawn: Array) -> NDArray[np.complex128]:
    """Return the smoothed directions of one round, shape (T, 2), stretched to equal extents; shape (64,), norm 1."""
    closed = resample_path(np.vstack([drawn, drawn[:1]]), 4 * _SAMPLES + 1)[:-1]
    centred = closed - closed.mean(axis=0)
    variances, axes = np.linalg.eigh(np.cov(centred.T))
    round_ = centred @ (axes / np.sqrt(variances)) @ axes.T
    even = resample_path(np.vstack([round_, round_[:1]]), _SAMPLES + 1)[:-1]
    tangents = unit_tangents(even, closed=True) @ np.array([1.0, 1.0j])
    smooth = np.sum([np.roll(tangents, shift) for shift in range(-_SMOOTHED, _SMOOTHED + 1)], axis=0)
    return np.asarray(smooth / np.linalg.norm(smooth))


@cache
def _spectra() -> NDArray[np.complex128]:
    """Return conjugate spectra of the directions of shapes, counter-clockwise and clockwise, shape (S, 2, 64)."""
    angles = np.linspace(0.0, 2 * np.pi, 4 * _SAMPLES, endpoint=False)
    rings = [np.exp(2j * np.pi * np.arange(k) * step / k) for k, step in ((len(angles), 1), (3, 1), (4, 1), (5, 2))]
    drawn = [np.column_stack([ring.real, ring.imag]) for ring in rings]
    drawn.append(np.column_stack([np.sin(angles), np.sin(2 * angles) / 2]))
    return np.conj(np.fft.fft([[_directions(shape), _directions(shape[::-1])] for shape in drawn]))
