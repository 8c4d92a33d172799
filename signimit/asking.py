"""What to ask for next, so that the answer teaches most.

The paper's imitator takes what it is shown; asking is among its future work (section IV).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import entr

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.explanation import SUSPECT, known_belief
from signimit.learners.base import Asked, Understanding
from signimit.paths import half_size
from signimit.segmentation import find_drawing
from signimit.validation import finite_array

_CLEAR = 1.5  # median half sizes of a drawing; objects this far apart are told from each other by 1 - 1/e
_SUSPICION = 3.0  # nats that a pair under suspicion is worth: more than doubts about both words of most other pairs


@one_line
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


def choose_query(demonstrations: DemonstrationSet, understanding: Understanding, scenes: ArrayLike) -> Query:
    """Choose the pair of meanings and the scene with the largest expected gain.

    What a pair can teach is the doubt about each of its two words, in nats; that the pair is new: 1 where it was never
    asked for and shown, less the more often it was; and the suspicion that what was shown last, when it was asked for,
    was not meant. All of it counts as far as the scene tells the object from its neighbours. Words are copied from
    trusted demonstrations, the most doubtful among them, so that what was taken for one and is two comes apart.

    Args:
        demonstrations: What was seen, N.
        understanding: With a belief, as the joint learner has.
        scenes: Object positions of the scenes there are to choose from, shape (S, O, 2), m.

    Raises:
        InvalidInputError: If there is no scene, one has not as many objects as the demonstrations, or the learner has
            no probabilities to tell.
    """
    places = finite_array(scenes, "scenes", (None, demonstrations.objects.shape[1], 2))
    if not len(places):
        raise InvalidInputError("scenes", "at least one", "none")
    belief, order, asked = known_belief(understanding), understanding.word_order, understanding.requests
    trust = np.ones(len(demonstrations)) if understanding.trust is None else understanding.trust
    trusted = trust >= SUSPECT
    if not trusted.any():
        trusted[:] = True  # words must come from somewhere
    about_movement = entr(belief.movement_probability).sum(axis=1)
    about_focus = entr(belief.focus_probability).sum(axis=1)
    shown = np.zeros((int(understanding.labels.max()) + 1, places.shape[1]))
    np.add.at(shown, asked, trust)
    to_movement = _most_doubtful(about_movement, np.where(trusted, asked.movement, -1), shown.shape[0])
    to_focus = _most_doubtful(about_focus, np.where(trusted, asked.focus, -1), shown.shape[1])
    lesson = 1.0 / (1.0 + shown) + about_movement[to_movement][:, None] + about_focus[to_focus]
    lesson += _SUSPICION * _open_suspicion(asked, trust, shown.shape)
    lesson[to_movement < 0], lesson[:, to_focus < 0] = 0.0, 0.0  # no trusted demonstration has that word
    unit = float(np.median([half_size(d.hand[find_drawing(d.hand, d.times)]) for d in demonstrations]))
    gains = lesson[None] * _clarity(places, _CLEAR * unit)[:, None]
    scene, movement, about = (int(i) for i in np.unravel_index(int(gains.argmax()), gains.shape))
    copied = [int(to_focus[about])] * len(demonstrations[0].signs)
    copied[order.movement] = int(to_movement[movement])
    signs = tuple(demonstrations[t].signs[word] for word, t in enumerate(copied))
    return Query(signs, tuple(copied), scene, movement, about, float(gains[scene, movement, about]))


def _open_suspicion(asked: Asked, trust: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return for each pair how probably its latest demonstration was not meant, shape (K, O).

    It is divided by how often in a row the pair was asked for in vain, so that nobody is asked the same for ever, and 0
    for a pair that can be trusted, or was not asked for.
    """
    suspicion, in_vain = np.zeros(shape), np.zeros(shape)
    for movement, focus, meant in zip(*asked, trust, strict=True):
        in_vain[movement, focus] = 0 if meant >= SUSPECT else in_vain[movement, focus] + 1
        suspicion[movement, focus] = (1.0 - meant) / in_vain[movement, focus] if meant < SUSPECT else 0.0
    return suspicion


def _most_doubtful(doubt: NDArray[np.float64], meaning: NDArray[np.int64], count: int) -> NDArray[np.intp]:
    """Return for each meaning its demonstration with most doubt, -1 where it has none, shape (count,).

    Args:
        doubt: About each demonstration, shape (N,), nats.
        meaning: Of its word, shape (N,); -1 where it is not to be copied.
        count: Number of meanings.
    """
    chosen = np.full(count, -1, dtype=np.intp)
    for t in np.argsort(doubt, kind="stable"):
        if meaning[t] >= 0:
            chosen[meaning[t]] = t
    return chosen


def _clarity(scenes: NDArray[np.float64], length: float) -> NDArray[np.float64]:
    """How well a drawing about each object can be told from one about its nearest neighbour, within [0, 1], (S, O)."""
    apart = np.linalg.norm(scenes[:, :, None] - scenes[:, None], axis=-1)
    apart[:, np.eye(scenes.shape[1], dtype=bool)] = np.inf
    return np.asarray(-np.expm1(-((apart.min(axis=2) / length) ** 2)))
