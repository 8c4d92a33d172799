"""Gaussian mixtures, many at once: expectation maximisation, evidence and regression.

Every function takes leading batch axes ``...``: one mixture for `GMRPolicy`, one a hand for `ILOGMRPolicy`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from signimit.policies.base import Array

FLOOR = 1e-3  # of each feature's variance, added to it: no component collapses onto a point
TRUSTED = 2.0  # standard deviations from a component's centre, see `regress`


class Mixture(NamedTuple):
    """Gaussian mixtures over D features.

    Attributes:
        weights: Priors, shape (..., K).
        means: Centres, shape (..., K, D).
        covariances: Shape (..., K, D, D).
    """

    weights: Array
    means: Array
    covariances: Array


def maximise(data: Array, responsibilities: Array) -> Mixture:
    """Return the likeliest mixtures given who is responsible for what (M step).

    Args:
        data: Samples, shape (..., n, D).
        responsibilities: Of each component for each sample, shape (..., n, K).
    """
    shares = responsibilities.sum(axis=-2) + 1e-9
    means = np.einsum("...nk,...nd->...kd", responsibilities, data) / shares[..., None]
    away = data[..., None, :, :] - means[..., :, None, :]  # (..., K, n, D)
    weighted = away * np.swapaxes(responsibilities, -1, -2)[..., None]
    covariances = np.swapaxes(weighted, -1, -2) @ away / shares[..., None, None]
    floor = FLOOR * data.var(axis=-2) + 1e-9
    return Mixture(
        shares / shares.sum(axis=-1, keepdims=True),
        means,
        covariances + (np.eye(data.shape[-1]) * floor[..., None, :])[..., None, :, :],
    )


def log_joint(mixture: Mixture, data: Array) -> Array:
    """Return log weight times density of each sample under each component, shape (..., n, K)."""
    features = data.shape[-1]
    precisions = np.linalg.inv(mixture.covariances[..., :features, :features])
    _, logdet = np.linalg.slogdet(mixture.covariances[..., :features, :features])
    away = data[..., None, :, :] - mixture.means[..., :, None, :features]  # (..., K, n, D)
    mahalanobis = ((away @ precisions) * away).sum(axis=-1)
    normaliser = np.log(mixture.weights) - 0.5 * (logdet + features * np.log(2 * np.pi))
    joint: Array = np.swapaxes(normaliser[..., None] - 0.5 * mahalanobis, -1, -2)
    return joint


def softmax(logs: Array) -> Array:
    """Return shares that sum to one over the last axis; the largest is never lost to underflow."""
    shares = np.exp(logs - logs.max(axis=-1, keepdims=True))
    total: Array = shares / shares.sum(axis=-1, keepdims=True)
    return total


def fit_mixture(data: Array, responsibilities: Array, steps: int) -> Mixture:
    """Run so many steps of expectation maximisation from first responsibilities, shape (..., n, K)."""
    mixture = maximise(data, responsibilities)
    for _ in range(steps):
        mixture = maximise(data, softmax(log_joint(mixture, data)))
    return mixture


def bayesian_information(mixture: Mixture, data: Array) -> float:
    """Return the Bayesian information criterion of one mixture, the lower the better (Schwarz 1978)."""
    joint = log_joint(mixture, data)
    peak = joint.max(axis=-1)
    likelihood = float((peak + np.log(np.exp(joint - peak[:, None]).sum(axis=-1))).sum())
    count, features = mixture.means.shape
    parameters = count * (1 + features + features * (features + 1) / 2) - 1
    return float(parameters * np.log(len(data)) - 2.0 * likelihood)


def regress(mixture: Mixture, known: Array) -> Array:
    """Return the mean of the later features given the first ones (Gaussian mixture regression).

    Departure: a component's line is followed no further than `TRUSTED` standard deviations from its centre, and says
    the same beyond; extrapolated without end it drives hands off the table.

    Args:
        mixture: Over D features, of which the first P are known.
        known: Shape (..., n, P).

    Returns:
        Conditional means, shape (..., n, D - P).
    """
    p = known.shape[-1]
    blame = softmax(log_joint(mixture, known))  # (..., n, K)
    gains = np.linalg.solve(mixture.covariances[..., :p, :p], mixture.covariances[..., :p, p:])  # (..., K, P, D - P)
    away = known[..., None, :, :] - mixture.means[..., :, None, :p]
    precisions = np.linalg.inv(mixture.covariances[..., :p, :p])
    deviations = np.sqrt(((away @ precisions) * away).sum(axis=-1, keepdims=True))
    away = away * np.minimum(1.0, TRUSTED / np.maximum(deviations, 1e-12))
    each = mixture.means[..., :, None, p:] + away @ gains  # (..., K, n, D - P)
    mean: Array = np.einsum("...nk,...knd->...nd", blame, each)
    return mean


def within_speed(velocity: Array, limit: float) -> Array:
    """Shorten velocities, shape (..., 2), to the limit: lines fitted near the data say nothing far from it."""
    speed = np.sqrt((velocity**2).sum(axis=-1, keepdims=True))
    shortened: Array = velocity * np.minimum(1.0, limit / np.maximum(speed, 1e-12))
    return shortened
