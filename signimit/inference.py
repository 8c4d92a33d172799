"""What was not seen: each demonstration's focus, and the word order (paper, section II-C)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.similarity import check_distances, policy_similarities
from signimit.validation import finite_array, whole_numbers


class WordOrder(NamedTuple):
    """Which position in the utterance holds which request; the paper's language is ``WordOrder(0, 1)``.

    Attributes:
        focus: Position of the word that names the object.
        movement: Position of the word that names the movement.
    """

    focus: int
    movement: int


def infer_focus(distances: ArrayLike, labels: ArrayLike) -> NDArray[np.int64]:
    """Find the object that each demonstration was about (paper, section II-C).

    "The coordinate system in which a trajectory is the most similar to the other trajectories of the same movement":
    the frame i with the largest mean over k of max_j γ_{t;k;i;j}. A demonstration alone in its group is compared with
    all others, the only evidence there is.

    Args:
        distances: Δ, shape (N, N, O, O), rad².
        labels: Movement of each demonstration, shape (N,).

    Returns:
        Object index of each demonstration, shape (N,).

    Raises:
        InvalidInputError: If the shapes do not fit.
    """
    table = check_distances(distances)
    groups = whole_numbers(labels, "labels", (len(table),))
    return np.asarray(focus_similarities(table, groups).argmax(axis=1), dtype=np.int64)


def focus_similarities(distances: NDArray[np.float64], labels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Compute how similar each demonstration is to its group in the frame of each object, shape (N, O), 1/rad²."""
    best = policy_similarities(distances).max(axis=3)  # (t, k, i)
    same = (labels[:, None] == labels[None]) & ~np.eye(len(labels), dtype=bool)
    alone = ~same.any(axis=1)
    same[alone] = ~np.eye(len(labels), dtype=bool)[alone]
    return np.asarray(np.einsum("tki,tk->ti", best, same) / np.maximum(same.sum(axis=1), 1)[:, None])


def infer_word_order(sign_points: ArrayLike, labels: ArrayLike, focus: ArrayLike, method: str = "ratio") -> WordOrder:
    """Find which word names the object and which the movement.

    The word whose signs differ most within a movement's group designates the object (paper, section II-C).

    Departure: ``method="ratio"`` divides the distance within groups by the distance between groups, and tells the
    words apart by both the groups and the foci; sign classes that lie closer together than others do not mislead it.
    ``method="paper"`` compares the raw distances within the groups.

    Args:
        sign_points: Signs as points, shape (N, W, P).
        labels: Movement of each demonstration, shape (N,).
        focus: Object of each demonstration, shape (N,).
        method: ``"ratio"`` or ``"paper"``.

    Returns:
        The word order. With one word, that word is both.

    Raises:
        InvalidInputError: If the shapes do not fit.
        UnknownNameError: If there is no such method.
    """
    points = finite_array(sign_points, "sign points", (None, None, None))
    by_movement = whole_numbers(labels, "labels", (len(points),))
    by_focus = whole_numbers(focus, "focus", (len(points),))
    if not points.size:
        raise InvalidInputError("sign points", "at least one number", f"shape {points.shape}")
    gaps = np.linalg.norm(points[:, None] - points[None], axis=-1)  # (N, N, W)
    if method == "paper":
        spread = spread_within(gaps, by_movement)
        by_size = np.argsort(-spread, kind="stable")  # a tie is two words all the same, not one word twice
        return WordOrder(int(by_size[0]), int(by_size[-1]))
    if method == "ratio":
        return _order_by_ratio(gaps, by_movement, by_focus)
    raise UnknownNameError("word order method", method, ("ratio", "paper"))


def _order_by_ratio(
    gaps: NDArray[np.float64], by_movement: NDArray[np.int64], by_focus: NDArray[np.int64]
) -> WordOrder:
    """Choose the two positions whose signs agree best within movements and within foci."""
    movement = spread_within(gaps, by_movement) / spread_between(gaps, by_movement)
    focus = spread_within(gaps, by_focus) / spread_between(gaps, by_focus)
    words = len(movement)
    total = focus[:, None] + movement[None, :]
    if words > 1:
        np.fill_diagonal(total, np.inf)
    best = np.unravel_index(int(total.argmin()), total.shape)
    return WordOrder(int(best[0]), int(best[1]))


def spread_within(gaps: NDArray[np.float64], labels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Mean distance of each word's signs, ``gaps`` of shape (N, N, W), over pairs of one group, shape (W,)."""
    same = (labels[:, None] == labels[None]) & ~np.eye(len(labels), dtype=bool)
    return _mean_over(gaps, same)


def spread_between(gaps: NDArray[np.float64], labels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Mean distance of each word's signs over pairs of different groups, shape (W,), never 0."""
    return np.maximum(_mean_over(gaps, labels[:, None] != labels[None]), 1e-12)


def _mean_over(gaps: NDArray[np.float64], pairs: NDArray[np.bool_]) -> NDArray[np.float64]:
    if not pairs.any():  # one group only, or groups of one: the pairs say nothing for or against any word
        return np.ones(gaps.shape[2])
    return np.asarray(gaps[pairs].mean(axis=0))
