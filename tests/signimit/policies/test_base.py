"""A policy on the table is the policy about the object, moved to where the object is; a function can be a policy."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, PlacedPolicy, Policy, load_policy, make_policy
from signimit.policies import as_policy

Array = NDArray[np.float64]
PLACE = np.array([0.1, -0.2])
ANGLE = np.linspace(0, 4 * np.pi, 100)
CIRCLE = 0.1 * np.column_stack([np.cos(ANGLE), np.sin(ANGLE)])


class Counting(Policy):
    """A policy that goes right, ever faster, and remembers for how long."""

    def start(self) -> int:
        return 0

    def step(self, state: int, hand: ArrayLike) -> tuple[int, Array]:
        return state + 1, state + np.asarray(hand, dtype=np.float64)


def test_the_hand_is_seen_from_the_place() -> None:
    policy = make_policy([CIRCLE], [ANGLE], kind="knn")
    placed = policy.at(PLACE)
    hands = CIRCLE[:5]
    np.testing.assert_array_equal(placed(hands + PLACE), policy(hands + PLACE - PLACE))
    assert placed(hands[0]).shape == (2,)
    assert placed.kind == "knn"


def test_a_policy_keeps_its_state_on_the_table() -> None:
    placed = Counting().at(PLACE)
    state, velocity = placed.step(placed.start(), PLACE)
    assert (state, velocity.tolist()) == (1, [0.0, 0.0])
    state, velocity = placed.step(state, PLACE + 1.0)
    assert (state, velocity.tolist()) == (2, [2.0, 2.0])


def test_a_placed_policy_is_put_elsewhere_not_farther() -> None:
    policy = make_policy([CIRCLE], [ANGLE])
    moved = policy.at([5.0, 5.0]).at(PLACE)
    assert moved.policy is policy
    np.testing.assert_array_equal(moved(CIRCLE + PLACE), policy.at(PLACE)(CIRCLE + PLACE))


def test_many_hands_may_each_have_a_place_of_their_own() -> None:
    policy, places = make_policy([CIRCLE], [ANGLE], kind="knn"), np.arange(10.0).reshape(5, 2)
    hands = CIRCLE[:5] + places
    alone = [policy.at(place)(hand) for place, hand in zip(places, hands, strict=True)]
    np.testing.assert_allclose(policy.at(places)(hands), alone, atol=1e-12)


def test_a_place_is_a_copy_that_cannot_be_changed() -> None:
    place = PLACE.copy()
    placed = Counting().at(place)
    place += 1.0
    np.testing.assert_array_equal(placed.place, PLACE)
    assert not placed.place.flags.writeable


@pytest.mark.parametrize("place", [[np.nan, 0.0], [0.0], [1e9, 0.0], "here"])
def test_what_is_no_place_is_told(place: Any) -> None:
    with pytest.raises(InvalidInputError, match=r"^place: expected"):
        Counting().at(place)


def test_a_placed_policy_is_saved_in_the_frame_of_its_object(tmp_path: Path) -> None:
    policy = make_policy([CIRCLE], [ANGLE])
    policy.at(PLACE).save(tmp_path / "policy.npz")
    np.testing.assert_array_equal(load_policy(tmp_path / "policy.npz")(CIRCLE), policy(CIRCLE))


def test_only_kinds_that_can_be_made_can_be_saved(tmp_path: Path) -> None:
    with pytest.raises(InvalidInputError, match=r"policy: expected a kind that make_policy makes, .* found Counting"):
        Counting().save(tmp_path / "policy.npz")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("hand", "sentence"),
    [
        ("x", "hand: expected numbers of shape (2,) or (B, 2), found <U1 values."),
        ([1j, 2.0], "hand: expected numbers of shape (2,) or (B, 2), found complex128 values."),
        ([[1.0, 2.0], [3.0]], "hand: expected shape (2,) or (B, 2), found a ragged list."),
        ([1.0, 2.0, 3.0], "hand: expected shape (2,) or (B, 2), found shape (3,)."),
        ([np.nan, 0.0], "hand: expected finite positions within 1000 m, found [nan  0.]."),
    ],
)
def test_what_is_no_hand_is_told(hand: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        make_policy([CIRCLE], [ANGLE], kind="knn").at(PLACE)(hand)
    assert str(caught.value) == sentence


def test_a_policy_is_a_policy_as_it_is() -> None:
    for policy in (Counting(), make_policy([CIRCLE], [ANGLE]), Counting().at(PLACE)):
        assert as_policy(policy) is policy
    assert isinstance(Counting().at(PLACE), PlacedPolicy)


def test_a_function_of_hands_is_a_policy_without_a_state() -> None:
    policy = as_policy(lambda hand: [0.1, 0])
    assert policy.start() is None
    state, velocity = policy.step(None, PLACE)
    assert state is None
    assert (velocity.tolist(), velocity.dtype.name) == ([0.1, 0.0], "float64")
    assert policy(PLACE).tolist() == [0.1, 0.0]


def test_an_object_with_start_and_step_is_stepped_not_called() -> None:
    class Callers:
        def start(self) -> int:
            return 7

        def step(self, state: int, hand: Array) -> tuple[int, list[float]]:
            return state + 1, [state, 0]

        def __call__(self, hand: Array) -> Array:
            raise AssertionError("a policy with a state is stepped")

    policy = as_policy(Callers())
    assert policy.start() == 7
    assert policy.step(7, PLACE)[0] == 8
    assert policy(PLACE).tolist() == [7.0, 0.0]


def test_what_is_no_policy_is_told() -> None:
    with pytest.raises(InvalidInputError, match="policy: expected a policy, found int"):
        as_policy(3)  # type: ignore[arg-type]
