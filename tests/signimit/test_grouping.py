"""Algorithm 1: its step against the printed loops, by hand, and what the grouping finds."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError, group_movements
from signimit.grouping import (
    canonical_labels,
    joint_memberships,
    push_as_printed,
    push_multiplicative,
    push_strengths,
    step_memberships,
)

Array = NDArray[np.float64]
Rule = Callable[[float, float, float], float]
RULES: dict[str, tuple[Any, Rule]] = {
    "paper": (push_multiplicative, lambda m, mk, xi: mk * xi * m + (1 - mk) * m),
    "paper-literal": (push_as_printed, lambda m, mk, xi: mk * xi + (1 - mk) * m),
}
properties = settings(deadline=None, derandomize=True, max_examples=25)


def random_similarity(count: int, seed: int) -> Array:
    gamma = np.random.default_rng(seed).gamma(2.0, 3.0, (count, count))
    gamma = gamma + gamma.T
    np.fill_diagonal(gamma, 0.0)
    return np.asarray(gamma)


def random_memberships(count: int, seed: int) -> Array:
    return np.random.default_rng(seed).dirichlet(np.ones(count), count).T


def slow_strengths(m: Array, gamma: Array) -> Array:
    """The definitions of ω, ϖ and ξ, element by element."""
    count = len(m)
    joint = [[max(m[:, t] * m[:, k]) for k in range(count)] for t in range(count)]
    omega = [[joint[t][k] / sum(joint[t]) for k in range(count)] for t in range(count)]
    mean = [sum(omega[t][k] * gamma[t, k] for k in range(count)) for t in range(count)]
    return np.array([[np.exp(gamma[t, k] / mean[t] - 1) for k in range(count)] for t in range(count)])


def slow_step(old: Array, gamma: Array, rule: Rule) -> Array:
    """One pass of Algorithm 1's printed loops."""
    new, xi, count = old.copy(), slow_strengths(old, gamma), len(old)
    for m in range(count):
        for t in range(count):
            for k in range(count):
                if k != t:
                    new[m, t] = rule(new[m, t], old[m, k], xi[t, k])
    new /= new.sum(axis=0)
    new *= np.array([new[m].sum() ** 0.25 for m in range(count)])[:, None]
    new /= new.sum(axis=0)
    new += 0.0001
    return np.asarray(new / new.sum(axis=0))


@pytest.mark.parametrize("name", RULES)
@pytest.mark.parametrize("count", [2, 3, 7, 12])
def test_a_step_is_that_of_the_printed_loops(name: str, count: int) -> None:
    fast, rule = RULES[name]
    for seed in range(3):
        old, gamma = random_memberships(count, seed), random_similarity(count, seed)
        np.testing.assert_allclose(
            step_memberships(old, gamma, fast), slow_step(old, gamma, rule), rtol=1e-10, atol=1e-14
        )


def test_joint_memberships_by_hand() -> None:
    memberships = np.array([[0.5, 0.25], [0.5, 0.75]])
    # max(.5 .5, .5 .5) = .25; max(.5 .25, .5 .75) = .375; max(.25², .75²) = .5625
    expected = [[0.25 / 0.625, 0.375 / 0.625], [0.375 / 0.9375, 0.5625 / 0.9375]]
    np.testing.assert_allclose(joint_memberships(memberships), expected)


def test_push_strengths_by_hand() -> None:
    memberships, gamma = np.full((2, 2), 0.5), np.array([[0.0, 4.0], [4.0, 0.0]])
    # all ω are 1/2, so the mean is 2 and ξ off the diagonal e^(4/2 - 1)
    np.testing.assert_allclose(push_strengths(memberships, gamma), np.exp([[-1.0, 1.0], [1.0, -1.0]]))


def test_no_push_is_stronger_than_e_to_the_50() -> None:
    gamma = np.array([[0.0, 1.0], [1.0, 0.0]])  # two groups of one: ω is the identity and both means are 0
    np.testing.assert_allclose(push_strengths(np.eye(2), gamma), np.exp([[-1.0, 50.0], [50.0, -1.0]]))


def test_the_pushed_trajectorys_mean_normalises() -> None:
    memberships, gamma = np.full((3, 3), 1 / 3), np.array([[0.0, 6, 0], [6, 0, 3], [0, 3, 0]])
    # ϖ = (2, 3, 1): trajectory 2 is pushed by 1 with e^(3/1 - 1), trajectory 1 by 2 with e^(3/3 - 1)
    xi = push_strengths(memberships, gamma)
    assert xi[2, 1] == pytest.approx(np.exp(2))
    assert xi[1, 2] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("push", "expected"),
    [
        # m_00 = .6 pushed by m_01 = .2 with ξ = 3: .2·3·.6 + .8·.6 = .84; m_10 = .4 by .8: .8·3·.4 + .2·.4 = 1.04
        (push_multiplicative, [0.84 / (0.84 + 1.04), 1.04 / (0.84 + 1.04)]),
        # .2·3 + .8·.6 = 1.08; .8·3 + .2·.4 = 2.48
        (push_as_printed, [1.08 / (1.08 + 2.48), 2.48 / (1.08 + 2.48)]),
    ],
)
def test_a_push_by_hand(push: Any, expected: list[float]) -> None:
    old, xi = np.array([[0.6, 0.2], [0.4, 0.8]]), np.array([[9.0, 3.0], [1.0, 9.0]])
    pushed = push(old, xi)[:, 0]
    np.testing.assert_allclose(pushed / pushed.sum(), expected)


def test_the_largest_membership_of_each_trajectory_is_held_at_one() -> None:
    """However strong and however many the pushes are, no product of them overflows."""
    old, xi = random_memberships(30, 0), np.full((30, 30), np.exp(50.0))  # the product of all is e^1450
    pushed = push_multiplicative(old, xi)
    np.testing.assert_array_equal(pushed.max(axis=0), 1.0)
    assert (pushed > 0).all()


@properties
@given(st.integers(1, 8), st.integers(0, 10_000), st.sampled_from(sorted(RULES)))
def test_memberships_stay_probabilities(count: int, seed: int, method: str) -> None:
    found = group_movements(random_similarity(count, seed), method, steps=5, rng=seed)
    assert found.history.shape == (6, count, count)
    assert found.memberships.tolist() == found.history[-1].tolist()
    assert (found.history >= 0).all()
    np.testing.assert_allclose(found.history.sum(axis=1), 1.0)
    assert found.labels.tolist() == canonical_labels(found.memberships.argmax(axis=0)).tolist()


@properties
@given(st.integers(0, 10_000))
def test_a_step_does_not_know_the_order_of_trajectories_or_groups(seed: int) -> None:
    rng = np.random.default_rng(seed)
    old, gamma = random_memberships(5, seed), random_similarity(5, seed)
    order, groups = rng.permutation(5), rng.permutation(5)
    push = push_multiplicative  # the printed rule depends on the order of k
    new = step_memberships(old, gamma, push)
    permuted = step_memberships(old[groups][:, order], gamma[np.ix_(order, order)], push)
    np.testing.assert_allclose(permuted, new[groups][:, order], rtol=1e-9)


@properties
@given(st.integers(0, 10_000), st.floats(1e-3, 1e3))
def test_the_unit_of_similarity_does_not_matter(seed: int, unit: float) -> None:
    gamma = random_similarity(6, seed)
    assert group_movements(unit * gamma).labels.tolist() == group_movements(gamma).labels.tolist()


def block_similarity(sizes: list[int], within: float, between: float) -> Array:
    labels = np.repeat(np.arange(len(sizes)), sizes)
    gamma = np.where(labels[:, None] == labels, within, between)
    np.fill_diagonal(gamma, 0.0)
    return np.asarray(gamma)


def test_clear_groups_are_found_from_nearly_every_start() -> None:
    gamma = block_similarity([4, 4, 4], 8.0, 1.0)
    right = [group_movements(gamma, rng=seed).labels.tolist() == [0] * 4 + [1] * 4 + [2] * 4 for seed in range(51)]
    assert sum(right) >= 46


def test_the_printed_rule_leaves_memberships_flat() -> None:
    memberships = group_movements(block_similarity([4, 4, 4], 8.0, 1.0), "paper-literal").memberships
    assert memberships.max() < 0.5
    assert group_movements(block_similarity([4, 4, 4], 8.0, 1.0), "paper").memberships.max() > 0.95


def test_the_same_seed_gives_the_same_bytes() -> None:
    gamma = random_similarity(9, 0)
    first, again = group_movements(gamma, rng=3), group_movements(gamma, rng=np.random.default_rng(3))
    assert first.history.tobytes() == again.history.tobytes()
    assert group_movements(gamma, rng=4).history.tobytes() != first.history.tobytes()


def test_similarities_may_be_read_only_and_are_not_written_to() -> None:
    gamma = random_similarity(4, 0)
    np.fill_diagonal(gamma, 5.0)
    gamma.setflags(write=False)
    group_movements(gamma)
    assert gamma[0, 0] == 5.0


def test_what_is_on_the_diagonal_is_not_used() -> None:
    gamma = random_similarity(4, 0)
    with_self = gamma + 100 * np.eye(4)
    assert group_movements(with_self).memberships.tobytes() == group_movements(gamma).memberships.tobytes()


@pytest.mark.parametrize("method", sorted(RULES))
@pytest.mark.parametrize(
    "gamma",
    [
        np.zeros((1, 1)),
        np.zeros((4, 4)),
        np.full((4, 4), 1e6),
        np.where(np.eye(4)[[1, 0, 3, 2]] > 0, 1e6, 1e-3),
        np.where(np.eye(4)[[1, 0, 3, 2]] > 0, 1e99, 1e-99),
    ],
    ids=["one alone", "nothing alike", "all the same", "two pairs of twins", "absurd twins"],
)
def test_extreme_similarities_give_finite_memberships(gamma: Array, method: str) -> None:
    assert np.isfinite(group_movements(gamma, method).history).all()


def test_twins_are_grouped() -> None:
    assert group_movements(np.where(np.eye(4)[[1, 0, 3, 2]] > 0, 1e6, 1e-3)).labels.tolist() == [0, 0, 1, 1]


def test_what_is_left_out_is_the_papers_method_50_steps_and_seed_0() -> None:
    gamma = random_similarity(4, 0)
    found = group_movements(gamma)
    assert found.history.shape == (51, 4, 4)
    assert found.history.tobytes() == group_movements(gamma, "paper", 50, rng=0).history.tobytes()


def test_no_step_leaves_the_start() -> None:
    found = group_movements(random_similarity(3, 0), steps=0)
    assert found.history.shape == (1, 3, 3)


def test_labels_are_numbered_by_first_appearance() -> None:
    assert canonical_labels([7, 2, 7, 0, 2]).tolist() == [0, 1, 0, 2, 1]
    assert canonical_labels([]).tolist() == []


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"similarity": np.zeros((2, 3))}, "similarity: expected a square matrix, found shape (2, 3)."),
        ({"similarity": np.zeros((0, 0))}, "similarity: expected a square matrix, found shape (0, 0)."),
        ({"similarity": [[0, -1], [-1, 0]]}, "similarity: expected no negative numbers, found -1."),
        ({"similarity": [[0, 1], [2, 0]]},
         "similarity: expected a symmetric matrix, found 1 at [0, 1] and 2 at [1, 0]."),
        ({"similarity": [[0, 9, 1], [9, 0, 2], [1, 5, 0]]},
         "similarity: expected a symmetric matrix, found 2 at [1, 2] and 5 at [2, 1]."),
        ({"similarity": [[0, np.nan], [1, 0]]}, "similarity: expected finite numbers, found nan at index (0, 1)."),
        ({"steps": -1}, "steps: expected a whole number, 0 or more, found -1."),
        ({"steps": 2.5}, "steps: expected a whole number, 0 or more, found 2.5."),
        ({"rng": "x"}, "rng: expected a numpy Generator or a seed, 0 or more, found 'x'."),
    ],
)  # fmt: skip
def test_what_cannot_be_grouped_is_told(arguments: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        group_movements(**({"similarity": random_similarity(2, 0)} | arguments))
    assert str(caught.value) == sentence


def test_an_unknown_method_is_told_with_the_known_ones() -> None:
    with pytest.raises(UnknownNameError, match="Unknown grouping method 'kmeans'; known are paper, paper-literal"):
        group_movements(random_similarity(2, 0), "kmeans")
