"""What to ask for next: the utterance and the scene whose answer would teach most.

The paper's imitator takes what it is shown; asking is among its future work (section IV).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import entr

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.learners.base import Understanding
from signimit.learners.joint.drawing_distance import make_drawing

_CLEAR = 1.5  # median half sizes of a drawing; objects this far apart are told from each other by 1 - 1/e


class Query(NamedTuple):
    """An utterance to ask with, made of signs that were seen, and where.

    Attributes:
        signs: The W signs in the order in which to make them, each (T_s, 2): copies of signs that were seen.
        copied: For each sign the demonstration it is copied from.
        scene: Number of the scene to ask in.
        movement: What the learner believes that the signs ask for, an index of ``model.movements``.
        focus: The object that it believes they ask for.
        gain: How much the answer is expected to teach, no unit: comparable among queries to one model only.
    """

    signs: tuple[NDArray[np.float64], ...]
    copied: tuple[int, ...]
    scene: int
    movement: int
    focus: int
    gain: float


def choose_query(demonstrations: DemonstrationSet, understanding: Understanding, scenes: NDArray[np.float64]) -> Query:
    """Choose the pair of meanings and the scene with the largest expected gain.

    What a pair can teach is the doubt about each of its two words, in nats, and that the pair is new: 1 where it was
    never seen, less the more often it was. All of it counts as far as the scene tells the object from its neighbours.
    The words are copied from the most doubtful demonstrations, so that what was taken for one and is two comes apart.

    Args:
        demonstrations: What was seen, N.
        understanding: What the joint learner made of it.
        scenes: Object positions of the scenes there are to choose from, shape (S, O, 2), m.

    Raises:
        InvalidInputError: If the learner has no probabilities to tell.
    """
    known = understanding.diagnostics
    if not {"focus_probability", "movement_probability"} <= set(known):
        raise InvalidInputError("method", 'probabilities, which "joint" has', "a method without")
    labels, focus, order, _ = understanding
    about_movement = entr(known["movement_probability"]).sum(axis=1)
    about_focus = entr(known["focus_probability"]).sum(axis=1)
    shown = np.zeros((int(labels.max()) + 1, scenes.shape[1]))
    np.add.at(shown, (labels, focus), 1.0)
    to_movement = _most_doubtful(about_movement, labels, shown.shape[0])
    to_focus = _most_doubtful(about_focus, focus, shown.shape[1])
    lesson = 1.0 / (1.0 + shown) + about_movement[to_movement][:, None] + about_focus[to_focus]
    lesson[:, to_focus < 0] = 0.0  # nobody has heard the word for that object
    gains = lesson[None] * _clarity(scenes, _CLEAR * _median_half_size(demonstrations))[:, None]
    scene, movement, about = (int(i) for i in np.unravel_index(int(gains.argmax()), gains.shape))
    copied = [int(to_focus[about])] * len(demonstrations[0].signs)
    copied[order.movement] = int(to_movement[movement])
    signs = tuple(demonstrations[t].signs[word] for word, t in enumerate(copied))
    return Query(signs, tuple(copied), scene, movement, about, float(gains[scene, movement, about]))


def _most_doubtful(doubt: NDArray[np.float64], meaning: NDArray[np.int64], count: int) -> NDArray[np.intp]:
    """Return for each meaning its demonstration with most doubt, -1 where it has none, shape (count,)."""
    chosen = np.full(count, -1, dtype=np.intp)
    for t in np.argsort(doubt, kind="stable"):
        chosen[meaning[t]] = t
    return chosen


def _clarity(scenes: NDArray[np.float64], length: float) -> NDArray[np.float64]:
    """How well a drawing about each object can be told from one about its nearest neighbour, within [0, 1], (S, O)."""
    apart = np.linalg.norm(scenes[:, :, None] - scenes[:, None], axis=-1)
    apart[:, np.eye(scenes.shape[1], dtype=bool)] = np.inf
    return np.asarray(-np.expm1(-((apart.min(axis=2) / length) ** 2)))


def _median_half_size(demonstrations: DemonstrationSet) -> float:
    return float(np.median([make_drawing(d.hand, d.times).half_size for d in demonstrations]))
