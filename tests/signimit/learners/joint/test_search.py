"""The objective against plain loops, and the search against trying everything."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit.learners.joint.search import (
    IMBALANCE_PRICE,
    MOVEMENT_PRICE,
    PairEvidence,
    conditional_scores,
    first_guesses,
    improve_explanation,
    merge_groups,
    score_explanation,
)

Labels = NDArray[np.int64]
properties = settings(deadline=None, derandomize=True, max_examples=30)
sizes = (st.integers(1, 6), st.integers(1, 3), st.integers(0, 10_000))


def random_evidence(count: int, frames: int, seed: int) -> PairEvidence:
    rng = np.random.default_rng(seed)
    drawing = rng.normal(0, 3, (count, count, frames, frames))
    drawing = drawing + drawing.transpose(1, 0, 3, 2)
    words = rng.normal(0, 2, (2, count, count))
    words = words + words.transpose(0, 2, 1)
    nobody = np.eye(count, dtype=bool)
    drawing[nobody] = words[:, nobody] = 0.0
    return PairEvidence(drawing, words[0], words[1], rng.normal(0, 2, (count, frames)))


def random_answer(count: int, frames: int, seed: int) -> tuple[Labels, Labels]:
    rng = np.random.default_rng(seed)
    labels = np.unique(rng.integers(0, 3, count), return_inverse=True)[1].astype(np.int64)
    return labels, rng.integers(0, frames, count)


def slow_score(evidence: PairEvidence, labels: Labels, focus: Labels) -> float:
    """The sum as the module's docstring says it."""
    members = [labels.tolist().count(m) for m in set(labels.tolist())]
    even = len(labels) / len(members)
    total = -MOVEMENT_PRICE * len(members) - IMBALANCE_PRICE * sum((n - even) ** 2 / even for n in members)
    for t in range(len(labels)):
        total += evidence.place[t, focus[t]]
        for k in range(t):
            if labels[t] == labels[k]:
                total += evidence.drawing[t, k, focus[t], focus[k]] + evidence.movement_word[t, k]
            if focus[t] == focus[k]:
                total += evidence.focus_word[t, k]
    return float(total)


def planted_evidence(labels: Labels, focus: Labels, frames: int) -> PairEvidence:
    """Evidence of 3 nats for what is true and against what is not."""
    one_movement = np.where(labels[:, None] == labels[None], 3.0, -3.0)
    drawing = np.full((len(labels), len(labels), frames, frames), -3.0)
    for t, k in product(range(len(labels)), repeat=2):
        drawing[t, k, focus[t], focus[k]] = one_movement[t, k]
    one_focus = np.where(focus[:, None] == focus[None], 3.0, -3.0)
    nobody = np.eye(len(labels), dtype=bool)
    drawing[nobody] = one_movement[nobody] = one_focus[nobody] = 0.0
    return PairEvidence(drawing, one_movement, one_focus, np.zeros((len(labels), frames)))


@properties
@given(*sizes)
def test_the_objective_is_the_sum_over_pairs(count: int, frames: int, seed: int) -> None:
    evidence, (labels, focus) = random_evidence(count, frames, seed), random_answer(count, frames, seed)
    assert score_explanation(evidence, labels, focus) == pytest.approx(slow_score(evidence, labels, focus))


@properties
@given(*sizes)
def test_conditional_scores_are_differences_of_the_objective(count: int, frames: int, seed: int) -> None:
    evidence, (labels, focus) = random_evidence(count, frames, seed), random_answer(count, frames, seed)
    scores = conditional_scores(evidence, labels, focus)
    here = slow_score(evidence, labels, focus)
    for t, m, i in np.ndindex(scores.shape):
        moved, turned = labels.copy(), focus.copy()
        moved[t], turned[t] = m, i
        gain = slow_score(evidence, moved, turned) - here
        assert scores[t, m, i] - scores[t, labels[t], focus[t]] == pytest.approx(gain, abs=1e-9)


@properties
@given(*sizes)
def test_a_relabelled_copy_is_never_preferred(count: int, frames: int, seed: int) -> None:
    evidence, (labels, focus) = random_evidence(count, frames, seed), random_answer(count, frames, seed)
    names = np.random.default_rng(seed).permutation(count + 3)
    ours, theirs = (score_explanation(evidence, which, focus) for which in (labels, names[labels]))
    assert ours == theirs


@properties
@given(*sizes)
def test_the_search_ends_where_no_single_change_helps_and_never_below_its_start(
    count: int, frames: int, seed: int
) -> None:
    evidence, (labels, focus) = random_evidence(count, frames, seed), random_answer(count, frames, seed)
    before = (labels.copy(), focus.copy())
    found = improve_explanation(evidence, labels, focus)
    np.testing.assert_array_equal((labels, focus), before)
    assert found.score >= slow_score(evidence, labels, focus) - 1e-9
    assert found.score == pytest.approx(slow_score(evidence, found.labels, found.focus))
    scores = conditional_scores(evidence, found.labels, found.focus)
    best = scores.reshape(count, -1).max(axis=1)
    assert (best <= scores[np.arange(count), found.labels, found.focus] + 1e-9).all()


@pytest.mark.parametrize("seed", range(4))
def test_what_is_planted_is_found_and_is_the_best_of_all_answers(seed: int) -> None:
    labels, focus = random_answer(4, 2, seed)
    evidence = planted_evidence(labels, focus, 2)
    answers = product(product(range(4), repeat=4), product(range(2), repeat=4))
    best = max(slow_score(evidence, np.array(m), np.array(i)) for m, i in answers)
    found = [improve_explanation(evidence, *guess) for guess in first_guesses(evidence)]
    assert max(f.score for f in found) == pytest.approx(best)


def test_groups_merge_as_long_as_it_pays() -> None:
    truth = np.array([0, 1, 0, 2, 1, 0])
    affinity = np.where(truth[:, None] == truth[None], 4.0, -4.0)
    np.testing.assert_array_equal(merge_groups(affinity), truth)
    np.testing.assert_array_equal(affinity[0, 1], -4.0)


def slow_groups(affinity: NDArray[np.float64]) -> list[list[int]]:
    """Merge the pair of groups whose pairs sum to most, the first of several, while that pays."""
    groups = [[t] for t in range(len(affinity))]
    while len(groups) > 1:
        gains = {(a, b): affinity[np.ix_(groups[a], groups[b])].sum() for a in range(len(groups)) for b in range(a)}
        a, b = min(gains, key=lambda pair: (-gains[pair], groups[pair[1]][0], groups[pair[0]][0]))
        if gains[a, b] <= -MOVEMENT_PRICE:
            break
        groups[b] += groups.pop(a)
    return groups


@properties
@given(st.integers(1, 12), st.sampled_from([0, 1, 9]), st.integers(0, 10_000))
def test_remembered_partners_lead_to_the_groups_of_plain_loops(count: int, decimals: int, seed: int) -> None:
    """Rounded to whole numbers many pairs tie, and the first is merged."""
    affinity = np.random.default_rng(seed).normal(-1, 3, (count, count)).round(decimals)
    affinity = affinity + affinity.T
    labels = merge_groups(affinity)
    assert [np.flatnonzero(labels == m).tolist() for m in range(labels.max() + 1)] == [
        sorted(group) for group in slow_groups(affinity)
    ]


def test_merging_saves_the_price_of_a_movement_and_no_more() -> None:
    for evidence, together in ((-MOVEMENT_PRICE + 0.1, True), (-MOVEMENT_PRICE - 0.1, False)):
        labels = merge_groups(np.array([[0.0, evidence], [evidence, 0.0]]))
        assert (labels[0] == labels[1]) == together


def test_one_demonstration_is_one_movement() -> None:
    assert merge_groups(np.zeros((1, 1))).tolist() == [0]
    evidence = random_evidence(1, 3, 0)
    found = improve_explanation(evidence, *first_guesses(evidence)[0])
    assert found.labels.tolist() == [0]
    assert found.focus.tolist() == [int(evidence.place[0].argmax())]
