"""Search for the movements and foci that explain all pairs of demonstrations best.

The objective is one sum: for pairs in one movement the evidence of their drawings, seen from their foci, and of their
movement words; for pairs with one focus the evidence of their focus words; for each demonstration the evidence of its
place; less a price for each movement and for unequal sizes, since people show everything about equally often. A
demonstration has one focus, the same for all its partners.
"""

from __future__ import annotations

from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

MOVEMENT_PRICE = 3.0  # nats for each movement
IMBALANCE_PRICE = 3.0  # nats for each unit of χ²: one odd demonstration among equals does not make a new movement


class PairEvidence(NamedTuple):
    """Log-likelihood ratios, nats; positive speaks for equal. Diagonals are 0; symmetric in the pair.

    Attributes:
        drawing: Of two drawings being one movement, in each pair of frames, shape (N, N, O, O).
        movement_word: Of two signs asking for one movement, shape (N, N).
        focus_word: Of two signs asking for one object, shape (N, N).
        place: Of each object being the focus, shape (N, O).
    """

    drawing: NDArray[np.float64]
    movement_word: NDArray[np.float64]
    focus_word: NDArray[np.float64]
    place: NDArray[np.float64]


class Explanation(NamedTuple):
    """A hypothesis and its score.

    Attributes:
        labels: Movement of each demonstration, shape (N,).
        focus: Object of each, shape (N,).
        score: Value of the objective, nats.
    """

    labels: NDArray[np.int64]
    focus: NDArray[np.int64]
    score: float


def score_explanation(evidence: PairEvidence, labels: NDArray[np.int64], focus: NDArray[np.int64]) -> float:
    """Compute the objective of a hypothesis, nats. Renaming the movements does not change it."""
    t, k = pairs_of_equals(labels)
    total = (evidence.drawing[t, k, focus[t], focus[k]] + evidence.movement_word[t, k]).sum()
    total += evidence.focus_word[pairs_of_equals(focus)].sum() + evidence.place[np.arange(len(labels)), focus].sum()
    sizes = np.unique(labels, return_counts=True)[1]
    return float(total - division_price(sizes))


def division_price(sizes: NDArray[np.int64]) -> float:
    """Price of a division into movements of these sizes, shape (K,), nats."""
    return float(_price(len(sizes), (sizes**2).sum(), int(sizes.sum())))


def pairs_of_equals(labels: NDArray[np.int64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return t and k > t of all pairs that have one label."""
    t, k = np.nonzero(np.triu(labels[:, None] == labels[None], 1))
    return t, k


def _price(movements: ArrayLike, squares: ArrayLike, count: int) -> NDArray[np.float64]:
    """Price of a division of ``count`` demonstrations, nats, from the number of its movements and Σ of their sizes².

    Besides the price of each movement it is Pearson's χ² against equal sizes, times `IMBALANCE_PRICE`.
    """
    chi_square = np.multiply(movements, squares) / count - count
    return np.asarray(MOVEMENT_PRICE * np.asarray(movements) + IMBALANCE_PRICE * chi_square)


def conditional_scores(
    evidence: PairEvidence, labels: NDArray[np.int64], focus: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Compute, for each demonstration given all others, the objective's part for each movement and object.

    Returns:
        Shape (N, K + 1, O), nats; the last movement is a new one.
    """
    return _priced(_sum_evidence(evidence, labels, focus), evidence.place, labels)


class _Sums(NamedTuple):
    """Evidence summed over all demonstrations where a hypothesis puts them.

    Attributes:
        movement: For t, seen from its object i, being movement m, shape (N, K + 1, O); the last movement is a new one.
        focus: For t being about object i, shape (N, O).
    """

    movement: NDArray[np.float64]
    focus: NDArray[np.float64]

    def add(self, evidence: PairEvidence, member: int, place: tuple[int, int], times: float) -> None:
        """Add, or take away, what one demonstration says as a member of a movement seen from an object."""
        movement, frame = place
        alike = evidence.drawing[member, :, frame] + evidence.movement_word[member, :, None]
        self.movement[:, movement] += times * alike
        self.focus[:, frame] += times * evidence.focus_word[member]

    def keep(self, movements: NDArray[np.int64]) -> _Sums:
        """Keep these movements, and a new one."""
        return _Sums(np.pad(self.movement[:, movements], ((0, 0), (0, 1), (0, 0))), self.focus)


def _sum_evidence(evidence: PairEvidence, labels: NDArray[np.int64], focus: NDArray[np.int64]) -> _Sums:
    others = np.arange(len(labels))
    seen = evidence.drawing[others, :, focus] + evidence.movement_word[:, :, None]  # (k, t, i), which is (t, k, i)
    movement = (_members(labels).T @ seen.reshape(len(seen), -1)).reshape(-1, *evidence.place.shape)
    focused = np.zeros(evidence.place.shape)
    focused[others, focus] = 1.0
    return _Sums(movement.transpose(1, 0, 2), evidence.focus_word @ focused)


def _members(labels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return 1 where t is a member of movement m, else 0, shape (N, K + 1)."""
    return np.asarray(labels[:, None] == np.arange(labels.max() + 2), dtype=np.float64)


def _priced(sums: _Sums, place: NDArray[np.float64], labels: NDArray[np.int64]) -> NDArray[np.float64]:
    """Complete the scores of `conditional_scores`."""
    member = _members(labels)
    prices = _joining_prices(member.sum(axis=0)[None] - member)
    return np.asarray(sums.movement + (sums.focus + place)[:, None, :] - prices[:, :, None])


def _joining_prices(sizes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Price of the division if t joins each movement, over that without t, shape (N, K + 1).

    Args:
        sizes: Members of each movement, t itself left out, shape (N, K + 1).
    """
    count = len(sizes)
    before = (sizes > 0).sum(axis=1)[:, None]
    squares = (sizes**2).sum(axis=1)[:, None]
    return _price(before + (sizes == 0), squares + 2 * sizes + 1, count) - _price(before, squares, count)


def improve_explanation(evidence: PairEvidence, labels: NDArray[np.int64], focus: NDArray[np.int64]) -> Explanation:
    """Move one demonstration after another to where it fits best, the most urgent first, until none wants to move."""
    labels, focus = _compact(labels), focus.copy()
    everyone = np.arange(len(labels))
    sums = _sum_evidence(evidence, labels, focus)
    for _ in range(20 * len(labels)):
        scores = _priced(sums, evidence.place, labels)
        flat = scores.reshape(len(labels), -1)
        gains = flat.max(axis=1) - scores[everyone, labels, focus]
        mover = int(gains.argmax())
        if gains[mover] <= 1e-9:
            break
        sums.add(evidence, mover, (labels[mover], focus[mover]), -1.0)
        labels[mover], focus[mover] = np.unravel_index(int(flat[mover].argmax()), scores.shape[1:])
        sums.add(evidence, mover, (labels[mover], focus[mover]), 1.0)
        sums, labels = sums.keep(np.unique(labels)), _compact(labels)
    return Explanation(labels, focus, score_explanation(evidence, labels, focus))


def merge_groups(affinity: NDArray[np.float64]) -> NDArray[np.int64]:
    """Group by merging, again and again, the two groups whose pairs sum to most, while that pays.

    Args:
        affinity: Evidence for being one movement, shape (N, N), nats, symmetric.

    Returns:
        Labels, shape (N,).
    """
    labels = np.arange(len(affinity))
    gain = affinity.copy()
    np.fill_diagonal(gain, -np.inf)
    partner, most = gain.argmax(axis=1), gain.max(axis=1)  # of each group: whom it gains most with, and how much
    for _ in range(len(affinity) - 1):
        a = int(most.argmax())
        b = partner[a]
        if most[a] <= -MOVEMENT_PRICE:
            break
        gain[a] += gain[b]
        gain[:, a] = gain[a]
        gain[a, a] = gain[b, :] = gain[:, b] = -np.inf
        labels[labels == b] = a
        most[b] = -np.inf
        closer = (gain[a] > most) | ((gain[a] == most) & (a < partner))
        bereft = ((partner == a) | (partner == b)) & (most > -np.inf) & ~closer
        bereft[a] = True
        partner[closer], most[closer] = a, gain[a, closer]
        partner[bereft], most[bereft] = gain[bereft].argmax(axis=1), gain[bereft].max(axis=1)
    return _compact(labels)


def first_guesses(evidence: PairEvidence) -> list[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Return two hypotheses to start from: movements given the foci that places suggest, and foci given movements."""
    everyone = np.arange(len(evidence.place))
    by_place = evidence.place.argmax(axis=1)
    framed = evidence.drawing[everyone[:, None], everyone[None], by_place[:, None], by_place[None]]
    seen = reduce(np.maximum, np.moveaxis(evidence.drawing, 3, 0))  # max(axis=3), where numpy is slow
    by_drawing = merge_groups(reduce(np.maximum, np.moveaxis(seen, 2, 0)) + evidence.movement_word)
    same = (by_drawing[:, None] == by_drawing[None]).astype(np.float64)
    focus = (np.einsum("tki,tk->ti", seen, same) + evidence.place).argmax(axis=1)
    return [(merge_groups(framed + evidence.movement_word), by_place), (by_drawing, focus)]


def _compact(labels: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.unique(labels, return_inverse=True)[1].astype(np.int64)
