"""A policy on the table is the policy about the object, moved to where the object is."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, make_policy
from signimit.policies.frames import StatefulPlacedPolicy, on_table

Array = NDArray[np.float64]
ORIGIN = np.array([0.1, -0.2])
ANGLE = np.linspace(0, 4 * np.pi, 100)
CIRCLE = 0.1 * np.column_stack([np.cos(ANGLE), np.sin(ANGLE)])


class Counting:
    """A policy that goes right, ever faster, and remembers for how long."""

    kind = "counting"

    def __call__(self, hand: ArrayLike) -> Array:
        return np.zeros_like(np.asarray(hand, dtype=np.float64))

    def save(self, path: Any) -> None:
        """Not here."""

    def start(self) -> int:
        return 0

    def step(self, state: int, hand: ArrayLike) -> tuple[int, Array]:
        return state + 1, state + np.asarray(hand, dtype=np.float64)


def test_the_hand_is_seen_from_the_object() -> None:
    policy = make_policy([CIRCLE], [ANGLE], kind="knn")
    placed = on_table(policy, ORIGIN)
    hands = CIRCLE[:5]
    np.testing.assert_array_equal(placed(hands + ORIGIN), policy(hands + ORIGIN - ORIGIN))
    assert placed(hands[0]).shape == (2,)
    assert not hasattr(placed, "start")


def test_a_policy_keeps_its_state_on_the_table() -> None:
    placed = on_table(Counting(), ORIGIN)
    assert isinstance(placed, StatefulPlacedPolicy)
    state, velocity = placed.step(placed.start(), ORIGIN)
    assert (state, velocity.tolist()) == (1, [0.0, 0.0])
    state, velocity = placed.step(state, ORIGIN + 1.0)
    assert (state, velocity.tolist()) == (2, [2.0, 2.0])


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
        on_table(make_policy([CIRCLE], [ANGLE], kind="knn"), ORIGIN)(hand)
    assert str(caught.value) == sentence
