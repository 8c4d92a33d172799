"""What to ask for next: worked by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import Demonstration, DemonstrationSet, InvalidInputError, WordOrder
from signimit.asking import Query, choose_query
from signimit.learners.base import Asked, Belief, Understanding

Array = NDArray[np.float64]
TURN = np.linspace(0, 6 * np.pi, 120)
CLEAR = np.array([[-0.3, 0.0], [0.3, 0.0]])
CROWDED = np.array([[-0.02, 0.0], [0.02, 0.0]])


def demonstration(number: int, words: int = 2) -> Demonstration:
    """A circle of 10 cm; the signs tell whose they are."""
    hand = 0.1 * np.column_stack([np.cos(TURN), np.sin(TURN)])
    signs = tuple(np.array([[0.0, 0.0], [1.0, number + 10.0 * word]]) for word in range(words))
    return Demonstration(signs, CLEAR, hand, 0.02 * np.arange(len(TURN), dtype=np.float64))


def ask(
    labels: list[int],
    focus: list[int],
    scenes: list[Array],
    doubt: dict[str, int] | None = None,
    words: int = 2,
    asked: Asked | None = None,
    trust: list[float] | None = None,
) -> Query:
    """Ask after demonstrations that are beyond doubt, but for one movement or focus."""
    order = WordOrder(0, words - 1)
    movement = np.eye(max(labels) + 2)[labels]
    about = np.eye(2)[focus]
    for name, number in (doubt or {}).items():
        {"movement": movement, "focus": about}[name][number, :2] = 0.5
    belief = Belief(about, movement, np.zeros((words, words)))
    demos = DemonstrationSet([demonstration(t, words) for t in range(len(labels))])
    known = Understanding(np.array(labels), np.array(focus), order, belief, asked=asked)
    return choose_query(demos, known._replace(trust=None if trust is None else np.array(trust)), np.stack(scenes))


def test_it_asks_for_the_pair_that_nobody_has_shown() -> None:
    query = ask([0, 0, 1], [0, 1, 0], [CLEAR])
    assert (query.movement, query.focus) == (1, 1)
    assert query.copied == (1, 2)
    assert [sign[1, 1] for sign in query.signs] == [1.0, 12.0]


def test_it_asks_where_objects_lie_apart() -> None:
    assert ask([0, 1], [0, 1], [CROWDED, CLEAR, CROWDED]).scene == 1


def test_the_gain_of_a_new_pair_in_a_clear_scene_is_one() -> None:
    assert ask([0, 1], [0, 1], [CLEAR * 10]).gain == pytest.approx(1.0)


def test_objects_one_and_a_half_half_sizes_apart_are_told_apart_by_63_per_cent() -> None:
    apart = np.array([[0.0, 0.0], [0.15, 0.0]])
    assert ask([0, 1], [0, 1], [apart]).gain == pytest.approx(1 - np.exp(-1), rel=0.01)


def test_doubt_about_a_word_adds_its_entropy_and_that_demonstration_is_copied() -> None:
    query = ask([0, 0, 1, 1], [0, 1, 0, 1], [CLEAR * 10], {"movement": 2})
    assert query.movement == 1
    assert query.copied[1] == 2
    assert query.gain == pytest.approx(0.5 + np.log(2))
    assert ask([0, 0, 1, 1], [0, 1, 0, 1], [CLEAR * 10], {"focus": 3}).copied[0] == 3


def test_an_object_whose_word_nobody_has_heard_cannot_be_asked_for() -> None:
    query = ask([0, 0], [0, 0], [CLEAR])
    assert query.focus == 0
    assert query.gain == pytest.approx(1 / 3, rel=0.05)


def test_a_word_without_a_meaning_is_copied_too() -> None:
    query = ask([0, 1], [0, 1], [CLEAR], words=3)
    assert len(query.signs) == 3


def test_a_learner_without_probabilities_cannot_ask() -> None:
    demos = DemonstrationSet([demonstration(0)])
    with pytest.raises(InvalidInputError, match='probabilities, which "joint" has'):
        choose_query(demos, Understanding(np.array([0]), np.array([0]), WordOrder(0, 1)), CLEAR[None])


@settings(deadline=None, derandomize=True, max_examples=25)
@given(st.permutations(range(4)), st.lists(st.tuples(st.integers(0, 2), st.integers(0, 1)), min_size=2, max_size=8))
def test_the_order_of_scenes_does_not_matter(order: list[int], pairs: list[tuple[int, int]]) -> None:
    labels = np.unique([m for m, _ in pairs], return_inverse=True)[1].tolist()
    focus = [f for _, f in pairs]
    scenes = [np.array([[-d, 0.0], [d, 0.02]]) for d in (0.05, 0.1, 0.17, 0.2)]
    plain, mixed = ask(labels, focus, scenes), ask(labels, focus, [scenes[i] for i in order])
    assert order[mixed.scene] == plain.scene
    assert mixed[3:] == plain[3:]


PAIRS = Asked(np.array([0, 0, 1, 1, 1]), np.array([0, 1, 0, 1, 1]))


def test_after_a_suspicious_demonstration_it_asks_for_that_pair_again_with_words_of_trusted_ones() -> None:
    """Demonstration 2 (movement 1, object 0) does something else, or nothing; all other pairs are shown."""
    for did, about in ((0, 0), (-1, -1)):
        query = ask([0, 0, did, 1, 1], [0, 1, about, 1, 1], [CLEAR * 10], asked=PAIRS, trust=[1, 1, 0.1, 1, 1])
        assert (query.movement, query.focus) == (1, 0)
        assert query.copied[0] == 0
        assert query.copied[1] in (3, 4)
        assert query.gain == pytest.approx(1 / 1.1 + 3 * 0.9)


def test_a_suspicion_comes_before_a_pair_that_nobody_has_shown() -> None:
    asked = Asked(np.array([0, 0, 1]), np.array([0, 0, 0]))
    query = ask([0, 1, 1], [0, 0, 0], [CLEAR * 10], asked=asked, trust=[0.1, 0.2, 1])
    assert (query.movement, query.focus) == (1, 0)  # movement 0 has no trusted word
    asked = Asked(np.array([0, 0, 1, 1]), np.array([0, 1, 1, 1]))
    query = ask([0, 1, 1, 1], [0, 1, 1, 1], [CLEAR * 10], asked=asked, trust=[1, 0.1, 1, 1])
    assert (query.movement, query.focus) == (0, 1)  # not (1, 0), which is new


def test_a_suspicion_is_resolved_once_the_pair_was_shown_as_it_was_meant() -> None:
    asked = Asked(np.array([0, 0, 1, 1]), np.array([0, 1, 1, 1]))
    after, before = (
        ask([0, 0, 1, 1], [0, 1, 1, 1], [CLEAR * 10], asked=asked, trust=trust)
        for trust in ([1, 1, 0.1, 1], [1, 1, 1, 0.1])
    )
    assert (after.movement, after.focus) == (1, 0)  # nobody has shown it
    assert (before.movement, before.focus) == (1, 1)  # shown well before, not since


def test_a_pair_that_was_asked_for_in_vain_is_asked_for_less_urgently() -> None:
    asked = Asked(np.array([0, 0, 1, 1, 1]), np.array([0, 1, 1, 0, 0]))
    query = ask([0, 0, 1, 0, 0], [0, 1, 1, 0, 0], [CLEAR * 10], asked=asked, trust=[1, 1, 1, 0.1, 0.1])
    assert (query.movement, query.focus) == (1, 0)
    assert query.gain == pytest.approx(1 / 1.2 + 3 * 0.9 / 2)


def test_where_nothing_is_trusted_it_asks_nevertheless() -> None:
    query = ask([0, -1], [0, -1], [CLEAR], asked=Asked(np.array([0, 0]), np.array([0, 1])), trust=[0.3, 0.2])
    assert query.movement == 0
    assert query.copied[query.focus] in (0, 1)
    assert all(t >= 0 for t in query.copied)
