"""The loop moves hands as a policy says, by whatever carries out its velocities."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, Policy, make_policy, run_policy
from signimit.policies import CONTROL_PERIOD
from signimit.policies.closed_loop import count_steps, move_exactly

Array = NDArray[np.float64]
ANGLE = np.linspace(0, 4 * np.pi, 100)
CIRCLE = 0.1 * np.column_stack([np.cos(ANGLE), np.sin(ANGLE)])


class Accelerating(Policy):
    """Goes right, 1 mm/s faster with every step."""

    def start(self) -> int:
        return 0

    def step(self, state: int, hand: ArrayLike) -> tuple[int, Array]:
        return state + 1, np.broadcast_to([1e-3 * state, 0.0], np.shape(hand))


def east(hand: Array) -> list[float]:
    return [0.5, 0.0]


def test_a_hand_that_is_a_point_integrates_the_policy() -> None:
    path = run_policy(east, [0.1, 0.2], 2.0)
    np.testing.assert_allclose(path, [0.1, 0.2] + np.arange(101)[:, None] * [0.01, 0.0])


def test_a_policy_keeps_its_state_along_the_way() -> None:
    path = run_policy(Accelerating(), np.zeros((3, 2)), 1.0)
    assert path.shape == (51, 3, 2)
    np.testing.assert_allclose(path[:, :, 0].T, [CONTROL_PERIOD * 1e-3 * np.cumsum([0, *range(50)])] * 3)


@pytest.mark.parametrize("kind", ["knn", "path-following"])
def test_the_loop_is_what_its_definition_spells_out(kind: str) -> None:
    policy = make_policy([CIRCLE], [ANGLE / np.pi], kind)
    place, state = np.array([0.05, 0.2]), policy.start()
    path = run_policy(policy, place, 3.0)
    for step in range(150):
        np.testing.assert_array_equal(path[step], place)
        state, velocity = policy.step(state, place)
        place = place + 0.02 * velocity
    np.testing.assert_array_equal(path[150:], [place])


def test_what_carries_out_a_velocity_is_told_it_and_says_where_the_hand_is() -> None:
    told: list[Any] = []

    def lazy(hand: Array, velocity: Array) -> Array:
        told.append((hand.tolist(), velocity.tolist()))
        return move_exactly(hand, 0.5 * velocity)

    path = run_policy(east, [0.0, 0.0], 0.06, lazy)
    assert told == [([x, 0.0], [0.5, 0.0]) for x in (0.0, 0.005, 0.01)]
    np.testing.assert_allclose(path[-1], [0.015, 0.0])


def test_the_motion_ends_where_nothing_carries_it_on() -> None:
    places = iter([np.ones(2), np.full(2, 2.0)])
    path = run_policy(east, [0.0, 0.0], 10.0, lambda *_: next(places, None))
    assert path.tolist() == [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]


def test_no_time_leaves_the_hands_where_they_are() -> None:
    assert run_policy(east, [0.1, 0.2], 0.0).tolist() == [[0.1, 0.2]]


def test_the_path_shares_no_memory_with_the_hands() -> None:
    hands = np.zeros((2, 2))
    path = run_policy(Accelerating(), hands, 0.1)
    hands += 1.0
    assert not path[0].any()


def test_a_control_period_is_what_times_are_counted_in() -> None:
    assert [count_steps(seconds) for seconds in (0.0, 0.009, 0.02, 1.0, 4.0, 600.0)] == [0, 0, 1, 50, 200, 30_000]


@pytest.mark.parametrize("hands", [[np.nan, 0.0], [0.0], "here"])
def test_what_is_no_hand_is_refused(hands: Any) -> None:
    with pytest.raises(InvalidInputError, match="hand"):
        run_policy(east, hands, 1.0)
