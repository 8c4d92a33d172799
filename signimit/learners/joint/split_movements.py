"""Takes movements apart that are two: akin ones, asked for by akin signs, whose pairs all look like equals.

The objective of `signimit.learners.joint.search` looks at one pair at a time, against what is typical of the whole
session. A
circle and a rectangle by somebody who draws both alike are then equal, pair by pair, and only the pattern tells: pairs
within each half are closer than pairs across, in the drawings and in the words.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

from signimit.learners.joint.distance_model import DRAWINGS, SIGNS
from signimit.learners.joint.search import division_price

_LEAST = 2  # members of each half; a single odd demonstration is no movement
_WORD = 0.35  # weight of the words' contrast against the drawings'
_MOST_WORD = 0.6  # that counts of it: many write one sign in two ways
_EVEN_ODDS = 0.6  # contrast at which one movement and two are equally likely
_SLOPE = 5.0  # nats for each unit of contrast and member of the smaller half: of many it is less likely by chance
_PRICE = 0.5  # of the objective's prices, which are made for sums over pairs as if these were independent
_MOST_FOR_BALANCE = 1.0  # nats that more equal sizes may speak for a split; they alone are no reason
_COPY = np.log(0.01)  # nobody draws or signs as closely twice: a demonstration that was recorded or passed twice
_MOST = 10.0  # nats that a contrast may be worth; more would be sure of what was never measured


def split_movements(
    labels: NDArray[np.int64], drawings: NDArray[np.float64], words: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Split, again and again, the movement whose halves differ most, while that is worth a movement more.

    Args:
        labels: Movement of each demonstration, shape (N,).
        drawings: Distances of the drawings, seen from their foci, shape (N, N).
        words: Distances of the movement words, shape (N, N).

    Returns:
        Labels, shape (N,); the new movement of a split has the highest number.
    """
    logs = [np.log(np.maximum(distances, 1e-9)) for distances in (drawings, words)]
    while True:
        found = [_best_split(labels, m, *logs) for m in range(int(labels.max()) + 1)]
        gain, half = max(found, key=lambda split: split[0])
        if gain <= 0.0:
            return labels
        labels = labels.copy()
        labels[half] = labels.max() + 1


def _best_split(
    labels: NDArray[np.int64], movement: int, drawings: NDArray[np.float64], words: NDArray[np.float64]
) -> tuple[float, NDArray[np.intp]]:
    """Return what it is worth to split a movement in two, nats, and one half of it."""
    members = np.flatnonzero(labels == movement)
    if len(members) < 2 * _LEAST:
        return -np.inf, members
    drawn, said = (logs[np.ix_(members, members)] for logs in (drawings, words))
    second = _halves(drawn / DRAWINGS.equal_spread + said / SIGNS.equal_spread)
    smaller = min(int(second.sum()), int((~second).sum()))
    if smaller < _LEAST:
        return -np.inf, members
    contrast = _contrast(drawn, second) + _WORD * min(_contrast(said, second), _MOST_WORD)
    evidence = min(_SLOPE * smaller * (contrast - _EVEN_ODDS), _MOST)
    price = _PRICE * _price_of_split(labels, members[second])
    return evidence - max(price, -_MOST_FOR_BALANCE), members[second]


def _halves(distances: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Cut the tree of average distances, shape (n, n), in two; True for one half."""
    condensed = squareform(distances, checks=False)
    tree = linkage(condensed - condensed.min(), "average")
    return np.asarray(fcluster(tree, 2, "maxclust") == 2)


def _contrast(logs: NDArray[np.float64], second: NDArray[np.bool_]) -> float:
    """How much farther apart pairs across are than pairs within, in the mean of log distances, shape (n, n).

    Copies say nothing about how alike a person draws, and are left out.
    """
    pairs = np.triu(logs > _COPY, 1)
    across = second[:, None] != second[None]
    if not (pairs & across).any() or not (pairs & ~across).any():
        return 0.0
    return float(logs[pairs & across].mean() - logs[pairs & ~across].mean())


def _price_of_split(labels: NDArray[np.int64], half: NDArray[np.intp]) -> float:
    split = labels.copy()
    split[half] = labels.max() + 1
    return division_price(np.bincount(split)) - division_price(np.bincount(labels))
