"""What a learner understood and why, in words.

Among it how many signs there are, the second of the four things that a robot has to learn by the paper's abstract.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.inference import WordOrder
from signimit.learners.base import Belief, Understanding
from signimit.lexicon import Sign, find_lexicon
from signimit.names import UNNAMED, Names

DOUBT = 0.1  # an object or a movement that is at least this probable beside the chosen one makes it ambiguous
SUSPECT = 0.5  # trust below which a demonstration is under suspicion: more probably it was not meant as it looks
ORDER_DOUBT = 3.0  # nats within which another word order may be right as well; odds of 20 to 1
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")
_COUNTS = ("no", "one", "two", "three", "four", "five", "six")


@one_line
class Ambiguity(NamedTuple):
    """A demonstration that could have been about another object.

    Attributes:
        demonstration: Its index.
        objects: The objects it may be about, the most probable first.
        probabilities: How probable each is.
        apart: Distance between the first two objects, m; small where the scene, not the learner, is to blame.
        names: What its sentence calls the objects.
    """

    demonstration: int
    objects: tuple[int, ...]
    probabilities: tuple[float, ...]
    apart: float
    names: Names = UNNAMED

    def __str__(self) -> str:
        """Return the sentence; it counts from 1."""
        likely = zip(self.objects, self.probabilities, strict=True)
        named = ", ".join(f"{self.names.object(i)} {probability:.0%}" for i, probability in likely)
        return (
            f"Demonstration {self.demonstration + 1} is ambiguous: {named}; the first two are {self.apart:.2f} m apart."
        )


@one_line
class Suspicion(NamedTuple):
    """A demonstration that was more probably not meant as it looks.

    Attributes:
        demonstration: Its index.
        trust: Probability that it was meant as it looks.
        asked: Movement and object that its words ask for.
        shown: Movement and object that it shows; None if it shows none of the movements.
        against: Trusted demonstrations that were asked for the same and showed it, which it contradicts.
        names: What its sentence calls objects and movements.
    """

    demonstration: int
    trust: float
    asked: tuple[int, int]
    shown: tuple[int, int] | None
    against: tuple[int, ...]
    names: Names = UNNAMED

    def __str__(self) -> str:
        """Return what it asks for, what it shows and what it would have to be to fit; counts from 1."""
        names, movement, thing = self.names, f"movement {self.asked[0] + 1}", self._thing(self.asked[1])
        asks = f"Demonstration {self.demonstration + 1} asks for {names.movement(self.asked[0])} about {thing}"
        as_others = f", as {_demonstrations(self.against)} do{'es' * (len(self.against) == 1)}" if self.against else ""
        if self.shown is None:
            done = "none of the movements"
            return f"{asks} but shows {done}. It would fit if it showed that movement{as_others}."
        if self.shown == self.asked:
            return f"{asks} and seems to show it, but was meant so with {self.trust:.0%} only."
        done, shown, other = names.movement(self.shown[0]), f"movement {self.shown[0] + 1}", self._thing(self.shown[1])
        if self.shown[1] == self.asked[1]:
            done, fit, instead = f"{done} about it", f"showed {movement}", shown
        elif self.shown[0] == self.asked[0]:
            done, fit, instead = f"it about {other}", f"were about {thing}", other
        else:
            done, fit, instead = f"{done} about {other}", "showed what it asks for", "that"
        return f"{asks} but shows {done}. It would fit if it {fit}{as_others}, or asked for {instead}."

    def _thing(self, focus: int) -> str:
        return f"the {self.names.object(focus)} object"


@one_line
class Reasons(NamedTuple):
    """Why a model understood what it did; printing it says it in words.

    Attributes:
        focus_probability: Of each object in each demonstration, given all other answers, shape (N, O).
        movement_probability: Of each movement found, and last of none of them, shape (N, K + 1).
        ambiguous: Demonstrations whose object is in doubt.
        unsure_movements: Indices of demonstrations whose movement is in doubt.
        suspicions: Demonstrations that were more probably not meant as they look.
        signs: The signs that were found, each with its meaning; several of one meaning are ways of writing it.
        idle_words: Places in the utterance, from 0, of words that mean nothing.
        word_orders: All word orders, the best first, each with how much less it explains than the best, nats.
        text: The same in words, which count from 1.
    """

    focus_probability: NDArray[np.float64]
    movement_probability: NDArray[np.float64]
    ambiguous: tuple[Ambiguity, ...]
    unsure_movements: tuple[int, ...]
    suspicions: tuple[Suspicion, ...]
    signs: tuple[Sign, ...]
    idle_words: tuple[int, ...]
    word_orders: tuple[tuple[WordOrder, float], ...]
    text: str

    def __str__(self) -> str:
        """Return the text."""
        return self.text


def ordinal(position: int) -> str:
    """Return "first" for position 0, and so on."""
    return _ORDINALS[position] if position < len(_ORDINALS) else f"{position + 1}th"


def rank_word_orders(belief: Belief) -> tuple[tuple[WordOrder, float], ...]:
    """Return all word orders, the best first, each with how much less it explains than the best, nats."""
    evidence = belief.word_order_evidence
    best, possible = float(evidence.max()), np.argwhere(np.isfinite(evidence))
    ranked = sorted((best - float(evidence[f, m]), WordOrder(int(f), int(m))) for f, m in possible)
    return tuple((order, loss) for loss, order in ranked)


def is_word_order_clear(understanding: Understanding) -> bool:
    """Return whether every other word order explains less by at least `ORDER_DOUBT`; true without a belief."""
    ranked = () if understanding.belief is None else rank_word_orders(understanding.belief)
    return len(ranked) < 2 or ranked[1][1] >= ORDER_DOUBT


def word_order_text(understanding: Understanding) -> str:
    """Say which word names what, or that it cannot be told yet: another word order explains nearly as much."""
    order = understanding.word_order
    names = f"the {ordinal(order.focus)} word names the object, the {ordinal(order.movement)} word names the movement."
    if is_word_order_clear(understanding):
        return names.capitalize()
    return f"The word order cannot be told yet; so far it seems that {names}"


def find_suspicions(understanding: Understanding, names: Names = UNNAMED) -> tuple[Suspicion, ...]:
    """Find the demonstrations whose trust is below `SUSPECT`, and those that they contradict."""
    if understanding.trust is None:
        return ()
    (movement, focus), (labels, about) = understanding.requests, understanding[:2]
    sound = (understanding.trust >= SUSPECT) & (labels == movement) & (about == focus)
    found = []
    for t in np.flatnonzero(understanding.trust < SUSPECT).tolist():
        other_object_only = labels[t] == movement[t] and about[t] != focus[t]
        kin = focus == focus[t] if other_object_only else movement == movement[t]
        against = tuple(np.flatnonzero(sound & kin).tolist())
        shown = None if labels[t] < 0 else (int(labels[t]), int(about[t]))
        asked = int(movement[t]), int(focus[t])
        found.append(Suspicion(t, float(understanding.trust[t]), asked, shown, against, names))
    return tuple(found)


def find_idle_words(understanding: Understanding) -> tuple[int, ...]:
    """Find the words, by their place in the utterance, that mean nothing; none without a belief."""
    words = 0 if understanding.belief is None else len(understanding.belief.word_order_evidence)
    return tuple(word for word in range(words) if word not in understanding.word_order)


def summarise(understanding: Understanding, objects: int, names: Names = UNNAMED) -> str:
    """Say which demonstrations show which movement about which object, and what each word and sign means.

    Args:
        understanding: What was inferred.
        objects: Number of objects in a scene.
        names: What they and the movements are called.

    Returns:
        Lines of text; demonstrations and movements are counted from 1, where their indices count from 0.
    """
    labels, focus, order = understanding[:3]
    count, signs = int(labels.max()) + 1, find_lexicon(understanding)
    shown = "1 demonstration shows" if len(labels) == 1 else f"{len(labels)} demonstrations show"
    lines = [f"{shown} {count} movement{'s' * (count != 1)}."]
    for m in range(count):
        numbers = np.flatnonzero(labels == m).tolist()
        members = ", ".join(f"{t + 1} (about {names.object(int(focus[t]))})" for t in numbers)
        lines.append(f"  M{names.movement(m)[1:]}: demonstration{'s' * (len(numbers) != 1)} {members}.")
    if (labels < 0).any():
        lines.append(f"  None of them: {_demonstrations(np.flatnonzero(labels < 0).tolist())}.")
    lines.append(word_order_text(understanding))
    lines += [f"The {ordinal(word)} word means nothing." for word in find_idle_words(understanding)]
    for_objects, for_movements = (sum(sign.role == role for sign in signs) for role in ("focus", "movement"))
    found = f"{len(signs)} sign{'s' * (len(signs) != 1)}"
    lines.append(f"There are {found}: {for_objects} for objects, {for_movements} for movements.")
    meanings = [("focus", i, f"the {names.object(i)} object") for i in range(objects)]
    meanings += [("movement", m, names.movement(m)) for m in range(count)]
    for role, number, meaning in meanings:
        forms = [_demonstrations(s.exemplars) for s in signs if (s.role, s.meaning) == (role, number)]
        word = ordinal(order.focus if role == "focus" else order.movement)
        if len(forms) > 1:
            ways = _COUNTS[len(forms)] if len(forms) < len(_COUNTS) else str(len(forms))
            listed = "; and of ".join(forms)
            lines.append(f"  {ways.capitalize()} ways of writing {meaning}: signs like the {word} of {listed}.")
        elif forms:
            lines.append(f"  Signs like the {word} of {forms[0]} mean {meaning}.")
        else:
            lines.append(f"  No sign was seen for {meaning}.")
    return "\n".join(lines)


def explain_understanding(
    understanding: Understanding, objects: NDArray[np.float64], names: Names = UNNAMED
) -> Reasons:
    """Explain what a learner understood, by its belief.

    Args:
        understanding: With a belief, as the joint learner has.
        objects: Object positions, shape (N, O, 2), m.
        names: What they and the movements are called.

    Raises:
        InvalidInputError: If the learner has no probabilities to tell.
    """
    belief = known_belief(understanding)
    focus, movement, _ = belief
    ambiguous = []
    for t in np.flatnonzero(((focus >= DOUBT).sum(axis=1) > 1) & (understanding.labels >= 0)).tolist():
        likely = [int(i) for i in np.argsort(-focus[t], kind="stable") if focus[t, i] >= DOUBT]
        apart = float(np.linalg.norm(objects[t, likely[0]] - objects[t, likely[1]]))
        ambiguous.append(Ambiguity(t, tuple(likely), tuple(float(focus[t, i]) for i in likely), apart, names))
    unsure = tuple(np.flatnonzero((movement >= DOUBT).sum(axis=1) > 1).tolist())
    ranked, suspicions = rank_word_orders(belief), find_suspicions(understanding, names)
    lines = [summarise(understanding, objects.shape[1], names)]
    if len(ranked) == 1:
        lines.append("With one word there is only one word order.")
    else:
        second, loss = ranked[1]
        words = f"{ordinal(second.focus)} word the object and {ordinal(second.movement)} the movement"
        lines.append(f"The next best word order, {words}, explains {loss:.1f} nats less.")
    lines += map(str, suspicions)
    lines += map(str, ambiguous)
    shown = [*map(names.movement, range(movement.shape[1] - 1)), "none of them"]
    for t in unsure:
        named = [f"{name} {p:.0%}" for name, p in zip(shown, movement[t], strict=True) if p >= DOUBT]
        lines.append(f"Demonstration {t + 1} may show {' or '.join(named)}.")
    if not (ambiguous or unsure or suspicions):
        lines.append(f"No demonstration is in doubt: nothing else is as probable as {DOUBT:.0%}.")
    signs, idle = find_lexicon(understanding), find_idle_words(understanding)
    return Reasons(focus, movement, tuple(ambiguous), unsure, suspicions, signs, idle, ranked, "\n".join(lines))


def known_belief(understanding: Understanding) -> Belief:
    """Return the belief of a learner.

    Raises:
        InvalidInputError: If it has no probabilities to tell.
    """
    if understanding.belief is None:
        raise InvalidInputError("method", 'probabilities, which "joint" has', "a method without")
    return understanding.belief


def _demonstrations(numbers: Sequence[int]) -> str:
    """Name demonstrations, counted from 1."""
    return f"demonstration{'s' * (len(numbers) != 1)} {', '.join(str(t + 1) for t in numbers)}"
