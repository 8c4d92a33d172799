"""How a hand moves: the sigma-lognormal model of the kinematic theory of rapid movements.

A drawing is a sequence of overlapping aimed strokes. Each takes the hand along a circular arc from one virtual
target to the next, and its speed is a lognormal of time: what a long chain of neuromuscular processes does to an
impulse. The velocity of the hand is the vector sum of the strokes that are under way, so the targets are approached,
not hit: corners are rounded the more the strokes overlap, speed drops where the path bends, and no two bends are alike.

Sources: R. Plamondon, Biological Cybernetics 72, 1995 (doi:10.1007/BF00202785), the theory; C. O'Reilly and
R. Plamondon, Pattern Recognition 42, 2009 (doi:10.1016/j.patcog.2008.10.017), sums of strokes in the plane;
D. Berio et al., MOCO 2017 (doi:10.1145/3077981.3078049), strokes described by duration, asymmetry and overlap instead
of t0, μ and σ.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr

REACH = 2.5  # a stroke is taken to last from -2.5 to +2.5 standard deviations of log time: 98.8 % of its way


class MotorPlan(NamedTuple):
    """What the hand intends: K aimed strokes between K + 1 virtual targets.

    Attributes:
        targets: Virtual targets, shape (K + 1, 2), any unit.
        arcs: Angle each stroke turns through, shape (K,), rad, counter-clockwise positive; 0 is straight.
        durations: How long each stroke lasts on its own, shape (K,), s.
        overlaps: Share of stroke k's duration that is over when it takes over from stroke k - 1 is one minus this,
            shape (K,), in [0, 1); the first is not used.
        asymmetry: Skewness of the speed profile, in (0, 1); small is bell-shaped, large starts fast and ends slowly.
    """

    targets: NDArray[np.float64]
    arcs: NDArray[np.float64]
    durations: NDArray[np.float64]
    overlaps: NDArray[np.float64]
    asymmetry: float


def onsets(plan: MotorPlan) -> NDArray[np.float64]:
    """Return when each stroke starts, shape (K,), s; the first at 0."""
    waits = plan.durations[:-1] * (1.0 - plan.overlaps[1:])
    return np.concatenate([[0.0], np.cumsum(waits)])


def progress(plan: MotorPlan, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the share of its way that each stroke has gone, shape (T, K), in [0, 1].

    A lognormal with log-time deviation σ and delay μ covers the time from exp(μ - 2.5σ) to exp(μ + 2.5σ) after its
    impulse; μ follows from the duration, and the impulse precedes the visible onset by exp(μ - 2.5σ).
    """
    sigma = np.sqrt(-np.log1p(-plan.asymmetry))
    mu = np.log(plan.durations / (np.exp(REACH * sigma) - np.exp(-REACH * sigma)))  # (K,)
    since = times[:, None] - onsets(plan) + np.exp(mu - REACH * sigma)  # (T, K)
    log_time = np.log(np.maximum(since, np.finfo(float).tiny))
    return np.asarray(ndtr((log_time - mu) / sigma), dtype=np.float64)


def trajectory(plan: MotorPlan, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where the hand is, shape (T, 2), in the unit of the targets.

    The lognormal is integrated in closed form: after the share w of a stroke with chord d that turns through δ the hand
    has moved by d · sin(δw/2) / sin(δ/2), rotated by δ(w - 1)/2.
    """
    w = progress(plan, times)
    chords = np.diff(plan.targets, axis=0) @ np.array([1.0, 1.0j])  # (K,) complex
    half = plan.arcs / 2.0
    straight = np.abs(half) < 1e-9
    ratio = np.where(straight, w, np.sin(half * w) / np.where(straight, 1.0, np.sin(half)))
    way = (ratio * np.exp(1j * half * (w - 1.0))) @ chords  # (T,)
    points: NDArray[np.float64] = plan.targets[0] + np.column_stack([way.real, way.imag])
    return points


def total_duration(plan: MotorPlan) -> float:
    """Return how long the hand moves, s."""
    return float(np.max(onsets(plan) + plan.durations))
