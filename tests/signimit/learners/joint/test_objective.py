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
ODD = Assumptions(  # no two numbers alike
    likeness=-0.5,
    slope=0.9,
    most_alike=2.7,
    most_unlike=4.0,
    offset_spread=0.3,
    area=15.0,
    most_offset=2.5,
    least_offset=-3.0,
    word_weight=1.2,
    movement_price=2.1,
    imbalance_price=0.7,
    mistake_price=2.3,
    irrelevance_price=4.1,
)
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

    near = [sorted(seen.drawings[t, k] for k in range(count) if k != t) for t in range(count)]
    nearest = float(np.median([row[(count - 2) // 11] for row in near])) if count > 1 else 0.0
    likeness = assumed.likeness + assumed.closeness * min(0.0, nearest - assumed.typical)

    def alike(t: int, k: int) -> float:
        drawn = assumed.slope * (likeness - seen.drawings[t, k])
        gap = seen.offsets[t, known.place[t]] - seen.offsets[k, known.place[k]]
        spread = 2 * assumed.offset_spread**2  # of a difference, along each axis
        near = np.log(assumed.area / (2 * np.pi * spread)) - gap @ gap / (2 * spread)
        drawn = np.clip(drawn, -assumed.most_unlike, assumed.most_alike)
        return float(drawn + np.clip(near, assumed.least_offset, assumed.most_offset))

    total = 0.0
    for m in movements:
        members = np.flatnonzero(known.movement == m).tolist()
        total += sum(alike(t, k) for t, k in combinations(members, 2)) * 2 / len(members)
    for word, asked in ((ORDER.movement, known.asked_movement), (ORDER.focus, known.asked_focus)):
        for meaning in set(asked.tolist()):
            members = np.flatnonzero(asked == meaning).tolist()
            total += sum(float(words[word, t, k]) for t, k in combinations(members, 2)) * 2 / len(members)
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


def wanted_of(known: Hypothesis, member: int) -> int | None:
    """Return the movement that somebody else asks for and nobody else does."""
    movement, others = known.movement[member], np.arange(len(known.movement)) != member
    alone = movement != NOTHING and movement not in known.movement[others] and movement in known.asked_movement[others]
    return int(movement) if alone else None


@properties
@given(sessions)
def test_scores_are_what_a_move_gains(session: tuple[int, int, int]) -> None:
    """Whatever one demonstration may do and ask for: the values of all choices differ as their scores do.

    What others ask for remains shown by somebody.
    """
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
                gain = asked + (scores.mistaken[t, m, c] if m != NOTHING else -scores.irrelevance[t])
            if np.isneginf(gain):
                assert wanted_of(known, t) not in (m, None)
                continue
            assert wanted_of(known, t) in (m, None)
            left = slow_value(seen, words, changed(known, t, (m, c, am, af)), ODD) - gain
            base = left if base is None else base
            assert left == pytest.approx(base, abs=1e-9), (t, m, c, am, af)


def test_evidence_of_drawings_by_hand() -> None:
    """0.9 nats for each unit below -0.5, at most 2.7 for and 4 against; nobody is compared with oneself."""
    unlike = np.array([[-9.0, -1.5, -9.0], [-1.5, 7.0, 9.0], [-9.0, 9.0, 0.0]])
    same = ODD._replace(closeness=0.0)
    np.testing.assert_allclose(drawing_evidence(unlike, same), [[0, 0.9, 2.7], [0.9, 0, -4], [2.7, -4, 0]])
    assert unlike[0, 0] == -9.0


def test_who_repeats_themselves_closely_means_something_else_sooner() -> None:
    """The nearest are at -9, -9 and -1.5: 3.5 below -5.5 in the middle, so that the middle moves from -0.5 to -2.25."""
    unlike = np.array([[0.0, -1.5, -9.0], [-1.5, 0.0, -1.0], [-9.0, -1.0, 0.0]])
    close = ODD._replace(closeness=0.5, typical=-5.5)
    found = drawing_evidence(unlike, close)
    np.testing.assert_allclose(found, [[0, -0.675, 2.7], [-0.675, 0, -1.125], [2.7, -1.125, 0]])


def test_evidence_of_signs_by_hand() -> None:
    distances = np.array([[[0.0, 0.2], [0.2, 0.0]], [[0.0, 0.9], [0.9, 0.0]]])
    near, far = 1.2 * SIGNS.log_ratios(np.array([0.2, 0.9]), SIGNS.equal_mean)
    np.testing.assert_allclose(word_evidence(distances, ODD), [[[0, near], [near, 0]], [[0, far], [far, 0]]])
    assert near > 1 > -1 > far


def value_of_equals(sizes: list[int]) -> float:
    """Value of movements of such sizes that nothing speaks for or against."""
    count = sum(sizes)
    no_evidence = np.zeros((count, count))
    seen = Measurements(no_evidence + ODD.likeness, no_evidence[None], np.zeros((count, 1, 2)), np.zeros((count, 1)))
    assumed = ODD._replace(area=np.pi * 4 * ODD.offset_spread**2)  # drawings at one place say nothing
    movement, nowhere_else = np.repeat(np.arange(len(sizes)), sizes), np.zeros(count, dtype=np.int64)
    objective = Objective(seen, no_evidence[None], WordOrder(0, 0), assumed)
    return value_of(objective, Hypothesis(movement, nowhere_else, movement, nowhere_else))


@pytest.mark.parametrize(("sizes", "chi_square"), [([4], 0), ([3, 3], 0), ([1, 3], 1), ([2, 4, 6], 2), ([1, 1, 4], 3)])
def test_prices_of_movements_and_of_unequal_sizes_by_hand(sizes: list[int], chi_square: float) -> None:
    """Pearson's: 1 and 3 where 2 and 2 are even, (1 + 1) / 2; 2, 4, 6 for 4, (4 + 4) / 4; 1, 1, 4 for 2, 6 / 2."""
    assert value_of_equals(sizes) == pytest.approx(-2.1 * len(sizes) - 0.7 * chi_square)


@pytest.mark.parametrize(("count", "weighted"), [(2, 1), (3, 2), (6, 5)])
def test_n_drawings_count_as_n_less_one_comparisons(count: int, weighted: int) -> None:
    """One nat for each pair: 1, 3, 15 of them, weighted by 2 / 2, 2 / 3, 2 / 6."""
    ones, nothing = np.ones((count, count)), np.zeros((count, count))
    drawn = ODD.likeness - ones / ODD.slope
    seen = Measurements(drawn, nothing[None], np.zeros((count, 1, 2)), np.zeros((count, 1)))
    assumed = ODD._replace(area=np.pi * 4 * ODD.offset_spread**2)
    same = np.zeros(count, dtype=np.int64)
    objective = Objective(seen, np.stack([nothing, nothing]), WordOrder(0, 1), assumed)
    assert value_of(objective, Hypothesis(same, same, same, same)) == pytest.approx(weighted - 2.1)


def test_movements_are_numbered_as_they_appear_and_those_only_asked_for_last() -> None:
    found = Hypothesis(*map(np.array, ([5, NOTHING, 2, 5], [0] * 4, [5, 7, 5, 2], [0] * 4))).compact()
    assert found.movement.tolist() == [0, NOTHING, 1, 0]
    assert found.asked_movement.tolist() == [0, 2, 0, 1]
    assert found.meant.tolist() == [True, False, False, False]


def test_where_drawings_of_one_movement_lie_about_their_places_by_hand() -> None:
    """At one place log(15 / (pi 0.36)) nats, above the most, 2.5; a gap of 0.6 half sizes takes 0.36 / 0.36 away."""
    nothing, same = np.zeros((2, 2)), np.zeros(2, dtype=np.int64)
    for gap, nats in ((0.0, 2.5), (0.6, np.log(15 / (np.pi * 0.36)) - 1), (1.0e9, -3.0)):
        offsets = np.array([[[0.3, 0.1]], [[0.3, 0.1 + gap]]])
        seen = Measurements(nothing + ODD.likeness, nothing[None], offsets, np.zeros((2, 1)))
        objective = Objective(seen, np.stack([nothing, nothing]), WordOrder(0, 1), ODD)
        assert value_of(objective, Hypothesis(same, same, same, same)) == pytest.approx(nats - 2.1)
