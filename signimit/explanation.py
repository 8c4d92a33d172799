"""What a learner understood and why, in words; and what to ask for next, so that the answer teaches most.

The paper's imitator takes what it is shown; asking is among its future work (section IV).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import entr

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.inference import WordOrder
from signimit.learners.base import Belief, Understanding
from signimit.paths import half_size
from signimit.segmentation import find_drawing

DOUBT = 0.1  # an object or a movement that is at least this probable beside the chosen one makes it ambiguous
OBJECT_NAMES = ("red", "green", "blue", "violet", "orange", "teal")
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")
_CLEAR = 1.5  # median half sizes of a drawing; objects this far apart are told from each other by 1 - 1/e


@one_line
class Ambiguity(NamedTuple):
    """A demonstration that could have been about another object.

    Attributes:
        demonstration: Its index.
        objects: The objects it may be about, the most probable first.
        probabilities: How probable each is.
        apart: Distance between the first two objects, m; small where the scene, not the learner, is to blame.
    """

    demonstration: int
    objects: tuple[int, ...]
    probabilities: tuple[float, ...]
    apart: float

    def __str__(self) -> str:
        """Return the sentence; it counts from 1."""
        named = ", ".join(f"{object_name(i)} {p:.0%}" for i, p in zip(self.objects, self.probabilities, strict=True))
        return (
            f"Demonstration {self.demonstration + 1} is ambiguous: {named}; the first two are {self.apart:.2f} m apart."
        )


@one_line
class Reasons(NamedTuple):
    """Why a model understood what it did; printing it says it in words.

    Attributes:
        focus_probability: Of each object in each demonstration, given all other answers, shape (N, O).
        movement_probability: Of each movement found, and last of none of them, shape (N, K + 1).
        ambiguous: Demonstrations whose object is in doubt.
        unsure_movements: Indices of demonstrations whose movement is in doubt.
        word_orders: All word orders, the best first, each with how much less it explains than the best, nats.
        text: The same in words, which count from 1.
    """

    focus_probability: NDArray[np.float64]
    movement_probability: NDArray[np.float64]
    ambiguous: tuple[Ambiguity, ...]
    unsure_movements: tuple[int, ...]
    word_orders: tuple[tuple[WordOrder, float], ...]
    text: str

    def __str__(self) -> str:
        """Return the text."""
        return self.text


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


def object_name(index: int) -> str:
    """Return the colour of an object, or its number, from 1, where colours have run out."""
    return OBJECT_NAMES[index] if index < len(OBJECT_NAMES) else f"number {index + 1}"


def ordinal(position: int) -> str:
    """Return "first" for position 0, and so on."""
    return _ORDINALS[position] if position < len(_ORDINALS) else f"{position + 1}th"


def summarise(understanding: Understanding, objects: int) -> str:
    """Say which demonstrations show which movement about which object, and what each word and sign means.

    Args:
        understanding: What was inferred.
        objects: Number of objects in a scene.

    Returns:
        Lines of text; demonstrations and movements are counted from 1, where their indices count from 0.
    """
    labels, focus, order = understanding[:3]
    count = int(labels.max()) + 1
    shown = "1 demonstration shows" if len(labels) == 1 else f"{len(labels)} demonstrations show"
    lines = [f"{shown} {count} movement{'s' * (count != 1)}."]
    for m in range(count):
        numbers = np.flatnonzero(labels == m).tolist()
        members = ", ".join(f"{t + 1} (about {object_name(int(focus[t]))})" for t in numbers)
        lines.append(f"  Movement {m + 1}: demonstration{'s' * (len(numbers) != 1)} {members}.")
    lines.append(
        f"The {ordinal(order.focus)} word names the object, the {ordinal(order.movement)} word names the movement."
    )
    meanings = [(order.focus, f"the {object_name(i)} object", focus == i) for i in range(objects)]
    meanings += [(order.movement, f"movement {m + 1}", labels == m) for m in range(count)]
    for word, meaning, shows_it in meanings:
        numbers = (np.flatnonzero(shows_it) + 1).tolist()
        named = f"demonstration{'s' * (len(numbers) != 1)} {', '.join(map(str, numbers))}"
        seen = f"  Signs like the {ordinal(word)} of {named} mean {meaning}."
        lines.append(seen if numbers else f"  No sign was seen for {meaning}.")
    return "\n".join(lines)


def explain_understanding(understanding: Understanding, objects: NDArray[np.float64]) -> Reasons:
    """Explain what a learner understood, by its belief.

    Args:
        understanding: With a belief, as the joint learner has.
        objects: Object positions, shape (N, O, 2), m.

    Raises:
        InvalidInputError: If the learner has no probabilities to tell.
    """
    focus, movement, order_evidence = _known_belief(understanding)
    ambiguous = []
    for t in np.flatnonzero((focus >= DOUBT).sum(axis=1) > 1).tolist():
        likely = [int(i) for i in np.argsort(-focus[t], kind="stable") if focus[t, i] >= DOUBT]
        apart = float(np.linalg.norm(objects[t, likely[0]] - objects[t, likely[1]]))
        ambiguous.append(Ambiguity(t, tuple(likely), tuple(float(focus[t, i]) for i in likely), apart))
    unsure = tuple(np.flatnonzero((movement >= DOUBT).sum(axis=1) > 1).tolist())
    best, possible = float(order_evidence.max()), np.argwhere(np.isfinite(order_evidence))
    ranked = sorted((best - float(order_evidence[f, m]), WordOrder(int(f), int(m))) for f, m in possible)
    lines = [summarise(understanding, objects.shape[1])]
    if len(ranked) == 1:
        lines.append("With one word there is only one word order.")
    else:
        loss, second = ranked[1]
        words = f"{ordinal(second.focus)} word the object and {ordinal(second.movement)} the movement"
        lines.append(f"The next best word order, {words}, explains {loss:.1f} nats less.")
    lines += map(str, ambiguous)
    names = [f"movement {m + 1}" for m in range(movement.shape[1] - 1)] + ["a new one"]
    for t in unsure:
        named = [f"{name} {p:.0%}" for name, p in zip(names, movement[t], strict=True) if p >= DOUBT]
        lines.append(f"Demonstration {t + 1} may show {' or '.join(named)}.")
    if not ambiguous and not unsure:
        lines.append(f"No demonstration is in doubt: nothing else is as probable as {DOUBT:.0%}.")
    orders = tuple((order, loss) for loss, order in ranked)
    return Reasons(focus, movement, tuple(ambiguous), unsure, orders, "\n".join(lines))


def choose_query(demonstrations: DemonstrationSet, understanding: Understanding, scenes: NDArray[np.float64]) -> Query:
    """Choose the pair of meanings and the scene with the largest expected gain.

    What a pair can teach is the doubt about each of its two words, in nats, and that the pair is new: 1 where it was
    never seen, less the more often it was. All of it counts as far as the scene tells the object from its neighbours.
    The words are copied from the most doubtful demonstrations, so that what was taken for one and is two comes apart.

    Args:
        demonstrations: What was seen, N.
        understanding: With a belief, as the joint learner has.
        scenes: Object positions of the scenes there are to choose from, shape (S, O, 2), m.

    Raises:
        InvalidInputError: If the learner has no probabilities to tell.
    """
    belief = _known_belief(understanding)
    labels, focus, order = understanding[:3]
    about_movement = entr(belief.movement_probability).sum(axis=1)
    about_focus = entr(belief.focus_probability).sum(axis=1)
    shown = np.zeros((int(labels.max()) + 1, scenes.shape[1]))
    np.add.at(shown, (labels, focus), 1.0)
    to_movement = _most_doubtful(about_movement, labels, shown.shape[0])
    to_focus = _most_doubtful(about_focus, focus, shown.shape[1])
    lesson = 1.0 / (1.0 + shown) + about_movement[to_movement][:, None] + about_focus[to_focus]
    lesson[:, to_focus < 0] = 0.0  # no demonstration has the word for that object
    unit = float(np.median([half_size(d.hand[find_drawing(d.hand, d.times)]) for d in demonstrations]))
    gains = lesson[None] * _clarity(scenes, _CLEAR * unit)[:, None]
    scene, movement, about = (int(i) for i in np.unravel_index(int(gains.argmax()), gains.shape))
    copied = [int(to_focus[about])] * len(demonstrations[0].signs)
    copied[order.movement] = int(to_movement[movement])
    signs = tuple(demonstrations[t].signs[word] for word, t in enumerate(copied))
    return Query(signs, tuple(copied), scene, movement, about, float(gains[scene, movement, about]))


def _known_belief(understanding: Understanding) -> Belief:
    if understanding.belief is None:
        raise InvalidInputError("method", 'probabilities, which "joint" has', "a method without")
    return understanding.belief


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
