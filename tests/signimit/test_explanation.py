"""What is told about a model: a summary, what is in doubt and why, and what to ask for next; worked by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import Demonstration, DemonstrationSet, InvalidInputError, WordOrder
from signimit.explanation import Query, choose_query, explain_understanding, object_name, ordinal, summarise
from signimit.learners.base import Belief, Understanding


def test_what_was_understood_is_said() -> None:
    text = summarise(Understanding(np.array([0, 1, 0]), np.array([0, 2, 2]), WordOrder(focus=0, movement=1)), 3)
    assert text.splitlines() == [
        "3 demonstrations show 2 movements.",
        "  Movement 1: demonstrations 1 (about red), 3 (about blue).",
        "  Movement 2: demonstration 2 (about blue).",
        "The first word names the object, the second word names the movement.",
        "  Signs like the first of demonstration 1 mean the red object.",
        "  No sign was seen for the green object.",
        "  Signs like the first of demonstrations 2, 3 mean the blue object.",
        "  Signs like the second of demonstrations 1, 3 mean movement 1.",
        "  Signs like the second of demonstration 2 mean movement 2.",
    ]


def test_a_swapped_word_order_and_one_movement_are_said() -> None:
    text = summarise(Understanding(np.array([0]), np.array([1]), WordOrder(focus=1, movement=0)), 2)
    assert "1 demonstration shows 1 movement." in text
    assert "The second word names the object, the first word names the movement." in text


@pytest.mark.parametrize(("index", "name"), [(0, "red"), (1, "green"), (2, "blue"), (6, "number 7")])
def test_objects_have_colours_while_there_are_some(index: int, name: str) -> None:
    assert object_name(index) == name


@pytest.mark.parametrize(("position", "name"), [(0, "first"), (1, "second"), (6, "7th")])
def test_positions_are_counted_in_words(position: int, name: str) -> None:
    assert ordinal(position) == name


OBJECTS = np.array([[[0.0, 0.0], [0.03, 0.04], [0.5, 0.5]]] * 2)


def understood(orders: list[list[float]] | None = None, **changes: NDArray[np.float64]) -> Understanding:
    belief = Belief(
        focus_probability=np.array([[0.98, 0.01, 0.01], [0.98, 0.01, 0.01]]),
        movement_probability=np.array([[0.99, 0.01, 0.0], [0.01, 0.98, 0.01]]),
        word_order_evidence=np.array(orders or [[-np.inf, 30.0], [10.0, -np.inf]]),
    )
    return Understanding(np.array([0, 1]), np.array([0, 0]), WordOrder(0, 1), belief._replace(**changes))


def test_where_nothing_is_in_doubt_that_is_said() -> None:
    why = explain_understanding(understood(), OBJECTS)
    assert not why.ambiguous
    assert not why.unsure_movements
    assert "No demonstration is in doubt" in str(why)
    assert "2 demonstrations show 2 movements." in why.text


def test_two_objects_close_together_are_named_with_their_distance() -> None:
    belief = np.array([[0.98, 0.01, 0.01], [0.4, 0.55, 0.05]])
    why = explain_understanding(understood(focus_probability=belief), OBJECTS)
    (doubt,) = why.ambiguous
    assert (doubt.demonstration, doubt.objects) == (1, (1, 0))
    assert doubt.apart == pytest.approx(0.05)
    assert "Demonstration 2 is ambiguous: green 55%, red 40%; the first two are 0.05 m apart." in why.text


def test_a_movement_in_doubt_is_told() -> None:
    belief = np.array([[0.99, 0.01, 0.0], [0.3, 0.5, 0.2]])
    why = explain_understanding(understood(movement_probability=belief), OBJECTS)
    assert why.unsure_movements == (1,)
    assert "Demonstration 2 may show movement 1 30% or movement 2 50% or a new one 20%." in why.text


def test_word_orders_are_ranked_by_what_they_lose() -> None:
    why = explain_understanding(understood(), OBJECTS)
    assert why.word_orders == ((WordOrder(0, 1), 0), (WordOrder(1, 0), 20))
    assert "second word the object and first the movement, explains 20.0 nats less" in why.text
    assert "only one word order" in explain_understanding(understood([[3.0]]), OBJECTS).text


def test_a_learner_without_probabilities_has_nothing_to_explain() -> None:
    with pytest.raises(InvalidInputError, match='probabilities, which "joint" has'):
        explain_understanding(understood()._replace(belief=None), OBJECTS)


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
    labels: list[int], focus: list[int], scenes: list[Array], doubt: dict[str, int] | None = None, words: int = 2
) -> Query:
    """Ask after demonstrations that are beyond doubt, but for one movement or focus."""
    order = WordOrder(0, words - 1)
    movement = np.eye(max(labels) + 2)[labels]
    about = np.eye(2)[focus]
    for name, number in (doubt or {}).items():
        {"movement": movement, "focus": about}[name][number, :2] = 0.5
    belief = Belief(about, movement, np.zeros((words, words)))
    demos = DemonstrationSet([demonstration(t, words) for t in range(len(labels))])
    return choose_query(demos, Understanding(np.array(labels), np.array(focus), order, belief), np.stack(scenes))


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
