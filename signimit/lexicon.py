"""The lexicon: which signs there are, what each means, and where it was seen (paper, section II-D).

One meaning may have several signs: those who taught may have two ways of writing "red".
"""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.hierarchy import linkage, to_tree
from scipy.spatial.distance import squareform

from signimit.learners.base import Understanding

_LEAST = 2  # signs of each form; a single odd one is no other way of writing
_APART = 0.55  # mean distance across, at which halves are no farther apart than one person's signs of one form may be
_CLOSE = 0.15  # distance below which signs are no more alike: those of demonstrations that were passed twice are at 0
_CONTRAST = 0.75  # least difference of mean log distances, across and within, plus log of distance across over `_APART`


class Sign(NamedTuple):
    """A sign that was found.

    Attributes:
        role: What it asks for.
        meaning: Number of the object or of the movement.
        exemplars: Numbers of the demonstrations in whose utterances it was seen.
    """

    role: Literal["focus", "movement"]
    meaning: int
    exemplars: tuple[int, ...]


def find_lexicon(understanding: Understanding) -> tuple[Sign, ...]:
    """Find the signs of each meaning, those of objects first; one sign a meaning where no distances were measured."""
    distances = understanding.diagnostics.get("sign_distances")
    order, asked = understanding.word_order, understanding.requests
    roles: tuple[tuple[Literal["focus", "movement"], int, NDArray[np.int64]], ...] = (
        ("focus", order.focus, asked.focus),
        ("movement", order.movement, asked.movement),
    )
    found = []
    for role, word, meanings in roles:
        for meaning in np.unique(meanings):
            members = np.flatnonzero(meanings == meaning)
            forms = np.zeros(len(members), dtype=np.int64)
            if distances is not None:
                forms = find_forms(distances[word][np.ix_(members, members)])
            for form in range(int(forms.max()) + 1):
                found.append(Sign(role, int(meaning), tuple(members[forms == form].tolist())))
    return tuple(found)


def find_forms(distances: NDArray[np.float64]) -> NDArray[np.int64]:
    """Divide signs of one meaning into ways of writing it.

    Of the halves that a tree of average distances offers, those that differ most are parted, again and again, while
    pairs across are much farther apart than pairs within.

    Args:
        distances: Of all pairs, shape (n, n).

    Returns:
        Form of each sign, shape (n,), numbered in order of first appearance.
    """
    forms = np.zeros(len(distances), dtype=np.int64)
    waiting = [np.arange(len(distances))]
    while waiting:
        members = waiting.pop()
        contrast, half = _best_half(distances[np.ix_(members, members)])
        if contrast > _CONTRAST:
            forms[members[half]] = forms.max() + 1
            waiting += [members[half], members[~half]]
    _, first, inverse = np.unique(forms, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse].astype(np.int64)


def _best_half(distances: NDArray[np.float64]) -> tuple[float, NDArray[np.bool_]]:
    """Return how much the most different halves of signs differ, and which signs are in one of them, shape (n,)."""
    count = len(distances)
    best, chosen = -np.inf, np.zeros(count, dtype=bool)
    if count < 2 * _LEAST:
        return best, chosen
    gaps = np.maximum(distances, _CLOSE)
    logs, pairs = np.log(gaps), np.triu(np.ones((count, count), dtype=bool), 1)
    for node in to_tree(linkage(squareform(distances, checks=False), "average"), rd=True)[1]:
        half = np.isin(np.arange(count), node.pre_order())
        if min(half.sum(), (~half).sum()) < _LEAST:
            continue
        across = half[:, None] != half
        contrast = logs[pairs & across].mean() - logs[pairs & ~across].mean()
        contrast += np.log(gaps[pairs & across].mean() / _APART)
        if contrast > best:
            best, chosen = float(contrast), half
    return best, chosen
