"""Policies are called for all their hands at once, and tell each what they would tell it alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import signimit
from signimit.policies import POLICY_KINDS, Policy
from signimit_envs.arm.batch.policy_batch import PolicyBatch

Array = NDArray[np.float64]


class Counting(Policy):
    """Moves right, faster with every step; knows how often it was called and with how many hands."""

    def __init__(self) -> None:
        self.calls: list[int] = []

    def __call__(self, hand: Any) -> Array:
        raise AssertionError("a policy with a state is stepped")

    def start(self) -> int:
        return 0

    def step(self, state: int, hand: Any) -> tuple[int, Array]:
        self.calls.append(len(hand))
        return state + 1, np.stack([np.full(len(hand), state), hand[:, 1]], axis=1)


def learned(kind: str) -> signimit.Policy:
    times = np.arange(0.0, 3.0, 0.02)
    rng, around = np.random.default_rng(0), 4 * times
    loops = [
        0.08 * np.column_stack([np.cos(around + a), np.sin(2 * around + a)]) + rng.normal(0, 0.001, (len(times), 2))
        for a in (0.0, 0.3, 0.6)
    ]
    return signimit.make_policy(loops, [times] * 3, kind=kind)


def told_first(policy: Policy, hands: Array) -> Array:
    return np.asarray(policy.step(policy.start(), hands)[1])


def test_a_policy_is_called_once_for_all_its_hands_and_keeps_one_state_for_them() -> None:
    shared, own = Counting(), Counting()
    batch = PolicyBatch([shared.at([0.0, 0.1]), own.at([0.0, 0.0]), shared.at([0.0, 0.0])])
    hands = np.array([[0.0, 0.5], [0.0, 0.6], [0.0, 0.7]])
    state, velocities = batch.step(batch.start(), hands)
    np.testing.assert_allclose(velocities, np.array([[0, 0.4], [0, 0.6], [0, 0.7]]))
    np.testing.assert_allclose(batch.step(state, hands)[1], np.array([[1, 0.4], [1, 0.6], [1, 0.7]]))
    assert shared.calls == [2, 2]
    assert len(own.calls) == 2


def test_a_policy_is_another_where_it_is_not_placed() -> None:
    shared = Counting()
    batch = PolicyBatch([shared, shared.at([0.0, 1.0])])
    np.testing.assert_allclose(told_first(batch, np.array([[1.0, 2.0], [3.0, 4.0]])), np.array([[0, 2], [0, 3]]))


def test_a_function_of_hands_on_the_table_is_a_policy() -> None:
    batch = PolicyBatch([lambda hand: 2 * hand, lambda hand: -hand])
    np.testing.assert_allclose(told_first(batch, np.array([[1.0, 2.0], [3.0, 4.0]])), np.array([[2, 4], [-3, -4]]))


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_a_hand_is_told_the_same_whoever_else_asks(kind: str) -> None:
    rng, policy = np.random.default_rng(1), learned(kind)
    places, hands = rng.uniform(-0.2, 0.2, (40, 2)), rng.uniform(-0.3, 0.3, (5, 40, 2))

    def told(numbers: Any) -> Array:
        batch = PolicyBatch([policy.at(places[n]) for n in numbers])
        state, velocities = batch.start(), []
        for now in hands:
            state, wanted = batch.step(state, now[numbers])
            velocities.append(wanted)
        return np.array(velocities)

    together = told(range(40))
    for numbers in ([11], [39], [8, 3], list(range(39, -1, -1)), list(range(0, 40, 3))):
        np.testing.assert_array_equal(told(numbers), together[:, numbers])


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_hands_are_told_what_their_policy_tells_them_one_by_one(kind: str) -> None:
    rng, policy = np.random.default_rng(2), learned(kind)
    places, hands = rng.uniform(-0.2, 0.2, (10, 2)), rng.uniform(-0.3, 0.3, (10, 2))
    policies = [policy.at(place) for place in places]
    alone = [told_first(p, hand) for p, hand in zip(policies, hands, strict=True)]
    np.testing.assert_allclose(told_first(PolicyBatch(policies), hands), alone, atol=1e-12)
