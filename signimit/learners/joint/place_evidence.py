"""Where drawings lie about the object they are about, learned from the session itself.

The paper leaves to future work "situation-specific correlations" such as a hand that stays near the focused object.
This is one: if there is one place, relative to one object of each scene, where all drawings lie, then it tells the
focus. Where there is none, it says nothing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

_ELSEWHERE = 0.02  # share of demonstrations whose drawing does not lie at the common place
_AREA = 0.5 * 0.45  # m²; a drawing that has nothing to do with an object lies anywhere in this area
_FIRST_SPREAD = 0.03  # m
_LEAST_SPREAD = 0.01  # m
_ITERATIONS = 30
_STARTS = 64
CERTAINTY = 6.0  # nats; a place alone never says more for or against an object


def common_place_evidence(centres: NDArray[np.float64], objects: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute how much the place of each drawing speaks for each object.

    A mixture is fitted by expectation maximisation from many starts: relative to the focused object, drawings lie
    about one place with one spread; relative to others, anywhere.

    Args:
        centres: Middle of each drawing, shape (N, 2), m, table frame.
        objects: Object positions, shape (N, O, 2), m, table frame.

    Returns:
        Log-likelihood ratios, shape (N, O), nats, within +-6.
    """
    offsets = centres[:, None] - objects
    candidates = offsets.reshape(-1, 2)
    place = candidates[np.unique(np.linspace(0, len(candidates) - 1, _STARTS).astype(int))]
    variance = np.full(len(place), _FIRST_SPREAD**2)
    for _ in range(_ITERATIONS):
        squares = ((offsets[None] - place[:, None, None]) ** 2).sum(axis=-1)
        at_place, ratios = _log_ratios(squares, variance)
        share = np.exp(at_place - logsumexp(ratios, axis=2, keepdims=True))
        total = share.sum(axis=(1, 2)) + 1e-9
        place = np.einsum("sto,tod->sd", share, offsets) / total[:, None]
        variance = ((share * squares).sum(axis=(1, 2)) / 2 + 2 * _LEAST_SPREAD**2) / (total + 2)
    squares = ((offsets[None] - place[:, None, None]) ** 2).sum(axis=-1)
    _, ratios = _log_ratios(squares, variance)
    best = int(logsumexp(ratios, axis=2).sum(axis=1).argmax())
    return np.asarray(np.clip(ratios[best], -CERTAINTY, CERTAINTY))


def _log_ratios(
    squares: NDArray[np.float64], variance: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Log density at the common place, and of the whole mixture, both over that of anywhere; shape (S, N, O)."""
    spread = variance[:, None, None]
    at_place = np.log((1 - _ELSEWHERE) * _AREA / (2 * np.pi * spread)) - squares / (2 * spread)
    return at_place, np.logaddexp(at_place, np.log(_ELSEWHERE))
