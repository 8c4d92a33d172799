"""Closure of a reference path that repeats: the jump from one drawn round to the next is replaced.

A drawn round does not close: the stroke runs past its beginning, or stops short of it, and the hand jumps to the next
round. The jump is not meant, but is made at the same place every time, so a mean of rounds has it too: a notch in a
circle, a second tip beside a triangle's. It is known by turning that is undone at once, left and right again; a
corner, however sharp, turns one way only.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from signimit.paths import headings, step_lengths, wrap_angles
from signimit.policies.base import Array

AROUND = 0.8  # half sizes from the first node, which is where the model's drawing ended
LONGEST = 0.8  # half sizes that a jump may take, along the course
LENGTH_COST = 0.875  # rad of needless turning that a half size of replaced course must spare
LEAST_GAIN = 1.0  # rad of needless turning; less is left as drawn
SIDE = 0.12  # half sizes before and after, from which the directions there are taken
CORNER = 0.8  # rad; turning across the seam by so much more than a circle of the movement's size would is a corner
LONGEST_LEG = 2.0  # widths of the gap; sides that meet further out do not meet in a corner


class _Jump(NamedTuple):
    """The part of a course to replace: first and last node (counted round and round), and directions there, rad."""

    begin: int
    end: int
    entering: float
    leaving: float


def close_loop(points: Array, speeds: Array, unit: float) -> tuple[Array, Array]:
    """Replace the jump between two rounds: by a corner where the sides make one, by a smooth piece elsewhere.

    The mended piece is drawn no faster than what lies before and after it.

    Args:
        points: Nodes of a closed course at about equal steps of length, shape (M, 2), m; the seam is near the first.
        speeds: Speed from each node to the next, shape (M,), m/s.
        unit: Half size of the movement, m.

    Returns:
        The same for the mended course; unchanged if there is no jump.
    """
    step = max(float(step_lengths(points).mean()), 1e-6 * unit)
    jump = _find_jump(points, step, unit)
    if jump is None:
        return points, speeds
    nodes = len(points)
    piece = _bridge(points[jump.begin % nodes], points[jump.end % nodes], jump, step, unit)
    pace = _calm(speeds[np.arange(jump.begin, jump.end + 1) % nodes], len(piece))
    rest = np.arange(jump.end + 1, jump.begin + nodes) % nodes
    return np.concatenate([piece, points[rest]]), np.concatenate([pace, speeds[rest]])


def _find_jump(points: Array, step: float, unit: float) -> _Jump | None:
    """Return the part near the seam whose replacement by a straight line spares most turning for its length."""
    nodes = len(points)
    reach = int(min(AROUND * unit / step, nodes // 4))
    side = max(round(min(SIDE * unit / step, nodes // 8)), 1)
    near = points[np.arange(-reach - side, reach + side + 1) % nodes]
    inner = near[side:-side]
    entering, leaving = headings(inner - near[: -2 * side]), headings(near[2 * side :] - inner)
    chords = headings(inner[None] - inner[:, None])  # (i, j)
    needed = _turning(entering[:, None], chords) + _turning(chords, leaving[None])
    steps = headings(np.diff(near, axis=0))
    turned = np.concatenate([[0.0, 0.0], np.cumsum(_turning(steps[:-1], steps[1:]))])
    drawn = turned[None, side + 1 : side + 1 + len(inner)] - turned[side:-side, None]  # at nodes i to j
    length = np.arange(len(inner)) - np.arange(len(inner))[:, None]
    gain = drawn - needed - LENGTH_COST * step / unit * length
    gain[(length < 1) | (length * step > LONGEST * unit)] = -np.inf
    i, j = np.unravel_index(int(gain.argmax()), gain.shape)
    if gain[i, j] < LEAST_GAIN:
        return None
    return _Jump(int(i) - reach, int(j) - reach, float(entering[i]), float(leaving[j]))


def _bridge(a: Array, b: Array, jump: _Jump, step: float, unit: float) -> Array:
    """Return points from a to b: both sides prolonged until they meet, or a smooth piece, or a straight one."""
    u, v = (np.array([np.cos(angle), np.sin(angle)]) for angle in (jump.entering, jump.leaving))
    chord = float(np.hypot(*(b - a)))
    turn = float(_turning(np.array(jump.entering), np.array(jump.leaving)))
    if turn <= CORNER + chord / unit:
        q = np.linspace(0.0, 1.0, max(round(chord / step), 1) + 1)[:, None]
        straight = a + (b - a) * (3 * q**2 - 2 * q**3)
        smooth: Array = straight + chord * ((q**3 - 2 * q**2 + q) * u + (q**3 - q**2) * v)  # cubic Hermite
        return smooth
    legs = np.array([_cross(b - a, v), _cross(u, b - a)]) / max(abs(_cross(u, v)), 1e-9) * np.sign(_cross(u, v))
    if legs.min() < 0 or legs.max() > LONGEST_LEG * chord:
        return np.linspace(a, b, max(round(chord / step), 1) + 1)
    first, second = (max(round(leg / step), 1) for leg in legs)
    corner = a + legs[0] * u
    return np.concatenate([np.linspace(a, corner, first, endpoint=False), np.linspace(corner, b, second + 1)])


def _calm(speeds: Array, count: int) -> Array:
    """Resample speeds, but none above the straight line from the first to the last: a jump is faster than a drawing."""
    shown = np.interp(np.linspace(0.0, 1.0, count), np.linspace(0.0, 1.0, len(speeds)), speeds)
    calm: Array = np.minimum(shown, np.linspace(speeds[0], speeds[-1], count))
    return calm


def _turning(a: Array, b: Array) -> Array:
    """Return the angle between two headings, in [0, π] rad."""
    return np.asarray(np.abs(wrap_angles(b - a)))


def _cross(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])
