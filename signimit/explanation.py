"""Why the learner understood what it understood, in numbers and in words."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.inference import WordOrder
from signimit.learners.base import Understanding
from signimit.summary import object_name, ordinal, summarise

DOUBT = 0.1  # an object or a movement that is at least this probable beside the chosen one makes it ambiguous


class Ambiguity(NamedTuple):
    """A demonstration that could have been about something else.

    Attributes:
        demonstration: Its number.
        objects: The objects it may be about, the most probable first.
        probabilities: How probable each is.
        apart: Distance between the first two objects, m; small where the scene, not the learner, is to blame.
    """

    demonstration: int
    objects: tuple[int, ...]
    probabilities: tuple[float, ...]
    apart: float


class Reasons(NamedTuple):
    """Why; printing it says it in words.

    Attributes:
        focus_probability: Of each object in each demonstration, given all other answers, shape (N, O).
        movement_probability: Of each movement found, and last of none of them, shape (N, K + 1).
        ambiguous: Demonstrations whose object is in doubt.
        unsure_movements: Numbers of demonstrations whose movement is in doubt.
        word_orders: All word orders, the best first, each with how much less it explains than the best, nats.
        text: The same in words.
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


def explain_understanding(understanding: Understanding, objects: NDArray[np.float64]) -> Reasons:
    """Explain what the joint learner understood.

    Args:
        understanding: With the joint learner's diagnostics.
        objects: Object positions, shape (N, O, 2), m.

    Raises:
        InvalidInputError: If another learner made it.
    """
    known = understanding.diagnostics
    if not {"focus_probability", "movement_probability", "word_order_evidence"} <= set(known):
        raise InvalidInputError("method", 'probabilities, which "joint" has', "a method without")
    focus, movement = known["focus_probability"], known["movement_probability"]
    doubtful = [t for t in range(len(focus)) if (focus[t] >= DOUBT).sum() > 1]
    ambiguous = tuple(_ambiguity(t, focus[t], objects[t]) for t in doubtful)
    unsure = tuple(int(t) for t in np.flatnonzero((movement >= DOUBT).sum(axis=1) > 1))
    orders = _ranked_orders(known["word_order_evidence"])
    lines = [summarise(understanding, objects.shape[1])]
    lines += [_order_line(orders), *map(_ambiguity_line, ambiguous)]
    lines += [_movement_line(t, movement[t]) for t in unsure]
    if not ambiguous and not unsure:
        lines.append(f"No demonstration is in doubt: nothing else is as probable as {DOUBT:.0%}.")
    return Reasons(focus, movement, ambiguous, unsure, orders, "\n".join(lines))


def _ambiguity(number: int, probability: NDArray[np.float64], places: NDArray[np.float64]) -> Ambiguity:
    order = [int(i) for i in np.argsort(-probability, kind="stable") if probability[i] >= DOUBT]
    apart = float(np.linalg.norm(places[order[0]] - places[order[1]]))
    return Ambiguity(number, tuple(order), tuple(float(probability[i]) for i in order), apart)


def _ranked_orders(evidence: NDArray[np.float64]) -> tuple[tuple[WordOrder, float], ...]:
    best = float(evidence.max())
    possible = np.argwhere(np.isfinite(evidence))
    ranked = sorted((best - float(evidence[f, m]), WordOrder(int(f), int(m))) for f, m in possible)
    return tuple((order, loss) for loss, order in ranked)


def _order_line(orders: tuple[tuple[WordOrder, float], ...]) -> str:
    if len(orders) == 1:
        return "With one word there is only one word order."
    (_, _), (second, loss) = orders[:2]
    return (
        f"The next best word order, {ordinal(second.focus)} word the object and {ordinal(second.movement)} the "
        f"movement, explains {loss:.1f} nats less."
    )


def _ambiguity_line(doubt: Ambiguity) -> str:
    named = ", ".join(f"{object_name(i)} {p:.0%}" for i, p in zip(doubt.objects, doubt.probabilities, strict=True))
    return f"Demonstration {doubt.demonstration} is ambiguous: {named}; the first two are {doubt.apart:.2f} m apart."


def _movement_line(number: int, probability: NDArray[np.float64]) -> str:
    last = len(probability) - 1
    named = [
        f"{'a new one' if m == last else f'movement {m}'} {p:.0%}" for m, p in enumerate(probability) if p >= DOUBT
    ]
    return f"Demonstration {number} may show {' or '.join(named)}."
