"""The objective against plain loops over pairs, and what a move of one demonstration gains."""

from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import WordOrder
from signimit.learners.joint.distance_model import SIGNS
from signimit.learners.joint.measurements import Measurements
from signimit.learners.joint.objective import (
    NOTHING,
    Assumptions,
    Hypothesis,
    Objective,
    drawing_evidence,
    word_evidence,
)

Array = NDArray[np.float64]
properties = settings(deadline=None, derandomize=True, max_examples=40)
sessions = st.tuples(st.integers(1, 6), st.integers(1, 3), st.integers(0, 10_000))
ODD = Assumptions(-0.5, 0.9, 4.0, 0.3, 15.0, 2.5, -3.0, 1.2, 2.1, 0.7, 2.3, 4.1)  # no two alike
ORDER = WordOrder(2, 0)


def random_seen(count: int, places: int, seed: int) -> tuple[Measurements, Array]:
    """Random measurements, and evidence of three words for one meaning."""
    rng = np.random.default_rng(seed)
    unlike = rng.normal(-1, 5, (count, count))
    words = rng.normal(0, 2, (3, count, count))
    unlike, words = unlike + unlike.T, words + words.transpose(0, 2, 1)
    words[:, np.arange(count), np.arange(count)] = 0.0
    offsets, place = rng.normal(0, 0.5, (count, places, 2)), rng.normal(0, 2, (count, places))
    return Measurements(unlike, np.zeros_like(words), offsets, place), words


def random_hypothesis(count: int, places: int, seed: int) -> Hypothesis:
    """Some do what they ask for, some something else, and some nothing; somebody shows whatever is asked for."""
    rng = np.random.default_rng(seed)
    movement, place = rng.integers(-1, 3, count), rng.integers(0, places, count)
    movement[0] = 0
    shown = movement[movement != NOTHING]
    strays = (rng.random(count) < 0.3) | (movement == NOTHING)
    asked = np.where(strays, rng.choice(shown, count), movement)
    return Hypothesis(movement, place, asked, np.where(strays, rng.integers(0, places, count), place))


def slow_value(seen: Measurements, words: Array, known: Hypothesis, assumed: Assumptions) -> float:
    """The objective as the module's docstring says it, under the word order `ORDER`."""
    count, places = seen.place_evidence.shape
    movements = sorted(set(known.movement.tolist()) - {NOTHING})

    def alike(t: int, k: int) -> float:
        drawn = np.clip(assumed.slope * (assumed.likeness - seen.drawings[t, k]), -assumed.most, assumed.most)
        gap = seen.offsets[t, known.place[t]] - seen.offsets[k, known.place[k]]
        spread = 2 * assumed.offset_spread**2  # of a difference, along each axis
        near = np.log(assumed.area / (2 * np.pi * spread)) - gap @ gap / (2 * spread)
        return float(drawn + np.clip(near, assumed.least_offset, assumed.most_offset))

    total = 0.0
    for m in movements:
        members = np.flatnonzero(known.movement == m)
        total += sum(alike(t, k) for t, k in combinations(members, 2)) * 2 / len(members)
    for word, asked in ((ORDER.movement, known.asked_movement), (ORDER.focus, known.asked_focus)):
        for meaning in set(asked.tolist()):
            members = np.flatnonzero(asked == meaning)
            total += sum(words[word, t, k] for t, k in combinations(members, 2)) * 2 / len(members)
    sizes = [int((known.movement == m).sum()) for m in movements]
    even = sum(sizes) / max(1, len(sizes))
    total -= assumed.movement_price * len(sizes) + assumed.imbalance_price * sum((n - even) ** 2 / even for n in sizes)
    for t in range(count):
        if known.movement[t] == NOTHING:
            total -= assumed.irrelevance_price
            continue
        total += seen.place_evidence[t, known.place[t]]
        if (known.movement[t], known.place[t]) != (known.asked_movement[t], known.asked_focus[t]):
            total -= assumed.mistake_price + np.log(len(movements) * places)
    return float(total)


def changed(known: Hypothesis, member: int, choice: tuple[int, int, int, int]) -> Hypothesis:
    other = Hypothesis(*(values.copy() for values in known))
    for values, value in zip(other, choice, strict=True):
        values[member] = value
    return other


def value_of(objective: Objective, known: Hypothesis) -> float:
    objective.start(known)
    return objective.value()


@properties
@given(sessions)
def test_the_value_is_the_sum_over_pairs(session: tuple[int, int, int]) -> None:
    (seen, words), known = random_seen(*session), random_hypothesis(*session)
    value = value_of(Objective(seen, words, ORDER, ODD), known)
    assert value == pytest.approx(slow_value(seen, words, known, ODD))


@properties
@given(sessions)
def test_scores_are_what_a_move_gains(session: tuple[int, int, int]) -> None:
    """Whatever one demonstration may do and ask for: the values of all choices differ as their scores do."""
    (seen, words), known = random_seen(*session), random_hypothesis(*session)
    objective = Objective(seen, words, ORDER, ODD)
    objective.start(known)
    known, scores = objective.hypothesis, objective.scores()
    gone = int(known.movement.max()) + 1
    for t in range(session[0]):
        base = None
        for m, c, am, af in product(range(-1, gone + 1), range(session[1]), range(gone + 1), range(session[1])):
            if (m, c) == (am, af):
                gain = scores.meant[t, m, c]
            elif not scores.shown[t, am]:
                continue
            else:
                asked = scores.askable[t, am] + scores.focus[t, af]
                gain = asked + (scores.mistaken[t, m, c] if m != NOTHING else -scores.irrelevance)
            left = slow_value(seen, words, changed(known, t, (m, c, am, af)), ODD) - gain
            base = left if base is None else base
            assert left == pytest.approx(base, abs=1e-9), (t, m, c, am, af)
