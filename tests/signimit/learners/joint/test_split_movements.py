"""Two movements that were taken for one come apart; one that is one stays, worked by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit.learners.joint.split_movements import split_movements

NEAR, AKIN, FAR = np.exp(-1.2), np.exp(-0.6), 1.0


def distances(truth: list[int], akin: tuple[int, int] = (0, 1), across: float = AKIN) -> NDArray[np.float64]:
    """Equals are near, two kinds are akin, all others are far."""
    kinds = np.array(truth)
    found = np.where(kinds[:, None] == kinds[None], NEAR, FAR)
    first, second = akin
    found[np.ix_(kinds == first, kinds == second)] = found[np.ix_(kinds == second, kinds == first)] = across
    np.fill_diagonal(found, 0.0)
    return found


TRUTH = [0, 1, 0, 1, 2, 2, 0, 1, 2]  # three of each
TAKEN = np.array([0, 0, 0, 0, 1, 1, 0, 0, 1])  # 0 and 1 for one


def test_a_movement_whose_halves_differ_in_drawings_and_words_is_two() -> None:
    split = split_movements(TAKEN, distances(TRUTH), distances(TRUTH))
    assert split.max() == 2
    assert len(set(zip(split.tolist(), TRUTH, strict=True))) == 3


def test_words_alone_take_nothing_apart() -> None:
    alike = distances(TRUTH, across=NEAR)
    assert split_movements(TAKEN, alike, distances(TRUTH, across=FAR)).tolist() == TAKEN.tolist()


@pytest.mark.parametrize(("others", "limit"), [(1, 0.6), (2, 0.55)])
def test_the_limit_of_the_contrast_is_lower_where_a_split_makes_sizes_equal(others: int, limit: float) -> None:
    """With one other movement the third costs 3 nats and saves 3 of unequal sizes; with two the fourth saves 4.5.

    Half of these 1.5 nats is as much as 0.05 of contrast, at 5 nats for each of three members.
    """
    truth = [0, 0, 0, 1, 1, 1] + [2 + i // 3 for i in range(3 * others)]
    taken = np.array([max(kind - 1, 0) for kind in truth])
    for contrast, more in ((limit - 0.01, 0), (limit + 0.01, 1)):
        drawings = distances(truth, across=NEAR * np.exp(contrast))
        split = split_movements(taken, drawings, distances(truth, across=NEAR))
        assert split.max() == taken.max() + more


def test_a_weak_contrast_does_not_make_movements_of_half_the_usual_size() -> None:
    truth = [0, 0, 1, 1] + [2] * 4 + [3] * 4
    taken = np.array([0] * 4 + [1] * 4 + [2] * 4)
    drawings = distances(truth, across=NEAR * np.exp(0.9))
    # a fourth movement: half of its price 3 and of 3 * (4 * (4 + 4 + 16 + 16) / 12 - 12) = 4; evidence 2 * 5 * 0.3
    assert split_movements(taken, drawings, distances(truth, across=NEAR)).tolist() == taken.tolist()


@pytest.mark.parametrize("taken", [[0, 0, 0], [0, 0, 1, 1, 2]])
def test_what_has_fewer_than_four_members_stays(taken: list[int]) -> None:
    apart = np.full((len(taken), len(taken)), FAR)
    assert split_movements(np.array(taken), apart, apart).tolist() == taken


def test_one_odd_demonstration_is_no_movement() -> None:
    truth = [0, 1, 1, 1, 1]
    assert split_movements(np.zeros(5, dtype=np.int64), distances(truth, across=FAR), distances(truth)).max() == 0


@settings(deadline=None, derandomize=True, max_examples=30)
@given(st.permutations(range(len(TRUTH))))
def test_the_order_of_demonstrations_does_not_matter(order: list[int]) -> None:
    both = distances(TRUTH)
    moved = split_movements(TAKEN[order], both[np.ix_(order, order)], both[np.ix_(order, order)])
    straight = split_movements(TAKEN, both, both)[order]
    assert (moved[:, None] == moved).tolist() == (straight[:, None] == straight).tolist()
