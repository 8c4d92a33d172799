"""Which demonstrations show the same movement: the paper's grouping algorithm (section II-C, Algorithm 1)."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.display import one_line
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.validation import finite_array, make_generator

STEPS = 50
_RESCUE = 1e-4  # what every membership gets back after each step, as printed
_EXPONENT = 0.25  # strength of the preference for few movements, as printed

Push = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]


@one_line
class Grouping(NamedTuple):
    """What the grouping algorithm found.

    Attributes:
        labels: Movement of each demonstration, shape (N,), 0, 1, ... in order of first appearance.
        memberships: M after the last step, ``memberships[m, t]``, shape (N, N); columns sum to 1.
        history: M before the first step and after each, shape (S + 1, N, N).
    """

    labels: NDArray[np.int64]
    memberships: NDArray[np.float64]
    history: NDArray[np.float64]


def group_movements(
    similarity: ArrayLike,
    method: str = "paper",
    steps: int = STEPS,
    rng: np.random.Generator | int | None = 0,
) -> Grouping:
    """Group demonstrations by movement with Algorithm 1 (paper, section II-C).

    Departure: as printed, m <- m_k ξ + (1 - m_k) m does not break the symmetry between groups and every membership
    stays near 1/N. The update that does what the text says ("a positive push increases") is multiplicative,
    m <- m_k ξ m + (1 - m_k) m; it is ``method="paper"``. The printed one is ``method="paper-literal"``.
    Departure: M_1 is not given in the paper; here it is uniform random with columns that sum to 1.

    Args:
        similarity: γ_{t;k}, shape (N, N), symmetric, positive off the diagonal; the diagonal is not used.
        method: ``"paper"`` or ``"paper-literal"``.
        steps: S, the number of steps.
        rng: Generator or seed of M_1.

    Returns:
        Labels, memberships and their history.

    Raises:
        InvalidInputError: If the similarity is not such a matrix or ``steps`` is negative.
        UnknownNameError: If there is no such method.
    """
    if method not in tuple(_PUSHES):
        raise UnknownNameError("grouping method", method, _PUSHES)
    gamma = _checked_similarity(similarity)
    if not isinstance(steps, (int, np.integer)) or steps < 0:
        raise InvalidInputError("steps", "a whole number, 0 or more", f"{steps!r:.40}")
    memberships = make_generator(rng).random(gamma.shape)
    memberships /= memberships.sum(axis=0)
    history = [memberships]
    for _ in range(steps):
        history.append(step_memberships(history[-1], gamma, _PUSHES[method]))
    return Grouping(canonical_labels(history[-1].argmax(axis=0)), history[-1], np.stack(history))


def _checked_similarity(similarity: ArrayLike) -> NDArray[np.float64]:
    gamma = finite_array(similarity, "similarity", (None, None)).copy()
    if gamma.shape[0] != gamma.shape[1] or not len(gamma):
        raise InvalidInputError("similarity", "a square matrix", f"shape {gamma.shape}")
    np.fill_diagonal(gamma, 0.0)
    if (gamma < 0).any():
        raise InvalidInputError("similarity", "no negative numbers", f"{gamma.min():g}")
    if not np.allclose(gamma, gamma.T):
        t, k = np.unravel_index(np.abs(gamma - gamma.T).argmax(), gamma.shape)
        found = f"{gamma[t, k]:g} at [{t}, {k}] and {gamma[k, t]:g} at [{k}, {t}]"
        raise InvalidInputError("similarity", "a symmetric matrix", found)
    return gamma


def canonical_labels(labels: ArrayLike) -> NDArray[np.int64]:
    """Rename labels, shape (N,), to 0, 1, ... in order of first appearance."""
    _, first, inverse = np.unique(np.asarray(labels), return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse].astype(np.int64)


def joint_memberships(memberships: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute ω_{t;k} = max_m(m_{m;t} m_{m;k}) / Σ_τ max_m(m_{m;t} m_{m;τ}), shape (N, N)."""
    joint = np.zeros((memberships.shape[1],) * 2)
    for row in memberships:
        np.maximum(joint, row[:, None] * row, out=joint)
    return np.asarray(joint / joint.sum(axis=1, keepdims=True))


def push_strengths(memberships: NDArray[np.float64], gamma: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute ξ_{t;k} = exp(γ_{t;k} / ϖ_t - 1), with ϖ_t = Σ_k ω_{t;k} γ_{t;k}, shape (N, N).

    ``[t, k]`` is normalised by ϖ of t, the trajectory that is pushed; k pushes.
    """
    mean = (joint_memberships(memberships) * gamma).sum(axis=1, keepdims=True)
    # Two demonstrations that agree to the last bit outweigh all others by 1e6; exp must not overflow.
    return np.asarray(np.exp(np.clip(gamma / np.maximum(mean, 1e-300) - 1.0, None, 50.0)))


def step_memberships(memberships: NDArray[np.float64], gamma: NDArray[np.float64], push: Push) -> NDArray[np.float64]:
    """Take one of the S steps of Algorithm 1.

    Departure: "1 < m < N" is read to include both ends; "rescale" makes the memberships of each trajectory sum to 1.
    """
    moved = _rescaled(push(memberships, push_strengths(memberships, gamma)))
    preferred = _rescaled(moved * moved.sum(axis=1, keepdims=True) ** _EXPONENT)
    return _rescaled(preferred + _RESCUE)


def _rescaled(memberships: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(memberships / memberships.sum(axis=0))


def push_multiplicative(old: NDArray[np.float64], xi: NDArray[np.float64]) -> NDArray[np.float64]:
    """Apply m_{m;t} <- m_{m;k} ξ m_{m;t} + (1 - m_{m;k}) m_{m;t} for all k other than t.

    The result is up to a factor for each trajectory, which the rescaling that follows cancels: the largest membership
    is held at 1, so that no product overflows.
    """
    gain = xi - 1.0
    np.fill_diagonal(gain, 0.0)
    new = old.copy()
    for k, pusher in enumerate(old.T):
        new *= 1.0 + pusher[:, None] * gain[:, k]
        new /= new.max(axis=0)
    return new


def push_as_printed(old: NDArray[np.float64], xi: NDArray[np.float64]) -> NDArray[np.float64]:
    """Apply m_{m;t} <- m_{m;k} ξ + (1 - m_{m;k}) m_{m;t} for all k other than t, as printed."""
    new = old.copy()
    for k, pusher in enumerate(old.T):
        kept = new[:, k].copy()
        new *= 1.0 - pusher[:, None]
        new += pusher[:, None] * xi[:, k]
        new[:, k] = kept
    return new


_PUSHES: dict[str, Push] = {"paper": push_multiplicative, "paper-literal": push_as_printed}
