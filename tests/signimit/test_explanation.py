"""What is told about a model: a summary, what is in doubt or under suspicion, and why; worked by hand."""

from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import DemonstrationSet, InvalidInputError, Suspicion, WordOrder, learn
from signimit.benchmark.studies.conditions import compose_study_session, study_condition
from signimit.explanation import (
    ORDER_DOUBT,
    explain_understanding,
    find_suspicions,
    ordinal,
    summarise,
    word_order_text,
)
from signimit.learners.base import Asked, Belief, Understanding
from signimit.names import object_name


def test_what_was_understood_is_said() -> None:
    text = summarise(Understanding(np.array([0, 1, 0]), np.array([0, 2, 2]), WordOrder(focus=0, movement=1)), 3)
    assert text.splitlines() == [
        "3 demonstrations show 2 movements.",
        "  Movement 1: demonstrations 1 (about red), 3 (about blue).",
        "  Movement 2: demonstration 2 (about blue).",
        "The first word names the object, the second word names the movement.",
        "There are 4 signs: 2 for objects, 2 for movements.",
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
    assert "Demonstration 2 may show movement 1 30% or movement 2 50% or none of them 20%." in why.text


def test_word_orders_are_ranked_by_what_they_lose() -> None:
    why = explain_understanding(understood(), OBJECTS)
    assert why.word_orders == ((WordOrder(0, 1), 0), (WordOrder(1, 0), 20))
    assert "second word the object and first the movement, explains 20.0 nats less" in why.text
    assert "only one word order" in explain_understanding(understood([[3.0]]), OBJECTS).text


def test_a_learner_without_probabilities_has_nothing_to_explain() -> None:
    with pytest.raises(InvalidInputError, match='probabilities, which "joint" has'):
        explain_understanding(understood()._replace(belief=None), OBJECTS)


class Distances(NamedTuple):
    """Evidence of a learner that measured signs."""

    sign_distances: NDArray[np.float64]


def mistaken(trust: list[float] | None = None) -> Understanding:
    """Five demonstrations; all are asked for movement 1, 1, 2, 2, 2, the last two do something else."""
    return Understanding(
        labels=np.array([0, 0, 1, 0, -1]),
        focus=np.array([0, 1, 0, 1, -1]),
        word_order=WordOrder(0, 1),
        belief=Belief(np.full((5, 2), 0.5), np.eye(3)[[0, 0, 1, 0, 2]], np.array([[-np.inf, 9.0], [0.0, -np.inf]])),
        asked=Asked(np.array([0, 0, 1, 1, 1]), np.array([0, 1, 0, 1, 0])),
        trust=np.array(trust or [0.99, 0.98, 0.97, 0.02, 0.03]),
    )


def test_a_suspicion_says_what_was_asked_for_what_was_shown_and_what_would_fit() -> None:
    another, nothing = find_suspicions(mistaken())
    assert another == Suspicion(3, 0.02, asked=(1, 1), shown=(0, 1), against=(2,))
    assert nothing == Suspicion(4, 0.03, asked=(1, 0), shown=None, against=(2,))
    assert str(another) == (
        "Demonstration 4 asks for movement 2 about the green object but shows movement 1 about it. It would fit if it "
        "showed movement 2, as demonstration 3 does, or asked for movement 1."
    )
    assert str(nothing) == (
        "Demonstration 5 asks for movement 2 about the red object but shows none of the movements. It would fit if it "
        "showed that movement, as demonstration 3 does."
    )


@pytest.mark.parametrize(
    ("shown", "against", "told"),
    [
        ((1, 2), (), "but shows it about the blue object. It would fit if it were about the red object, or asked for"),
        ((1, 2), (0, 3), "if it were about the red object, as demonstrations 1, 4 do, or asked for the blue object."),
        ((0, 2), (), "but shows movement 1 about the blue object. It would fit if it showed what it asks for, or"),
        ((1, 0), (), "and seems to show it, but was meant so with 20% only."),
    ],
)
def test_each_kind_of_suspicion_has_its_sentence(shown: tuple[int, int], against: tuple[int, ...], told: str) -> None:
    sentence = str(Suspicion(5, 0.2, (1, 0), shown, against))
    assert sentence.startswith("Demonstration 6 asks for movement 2 about the red object ")
    assert told in sentence


def test_another_object_contradicts_those_that_were_asked_for_the_same_object() -> None:
    known = mistaken([1, 1, 1, 0.1, 1])._replace(labels=np.array([0, 0, 1, 1, 1]), focus=np.array([0, 1, 0, 0, 0]))
    (suspicion,) = find_suspicions(known)
    assert (suspicion.shown, suspicion.against) == ((1, 0), (1,))


def test_trust_of_a_half_is_no_suspicion_and_without_trust_there_is_none() -> None:
    assert not find_suspicions(mistaken([1, 1, 1, 0.5, 0.5]))
    assert not find_suspicions(mistaken()._replace(trust=None))


def test_reasons_have_the_suspicions_and_no_ambiguity_of_what_is_about_nothing() -> None:
    why = explain_understanding(mistaken(), np.zeros((5, 2, 2)))
    assert [s.demonstration for s in why.suspicions] == [3, 4]
    assert 4 not in [doubt.demonstration for doubt in why.ambiguous]
    assert str(why.suspicions[0]) in why.text
    assert "No demonstration is in doubt" not in why.text


def test_signs_are_listed_by_what_was_asked_for_movements_by_what_was_done() -> None:
    lines = summarise(mistaken(), 2).splitlines()
    assert "  Movement 1: demonstrations 1 (about red), 2 (about green), 4 (about green)." in lines
    assert "  None of them: demonstration 5." in lines
    assert "  Signs like the second of demonstrations 3, 4, 5 mean movement 2." in lines
    assert "There are 4 signs: 2 for objects, 2 for movements." in lines


def test_two_ways_of_writing_a_meaning_are_told() -> None:
    form = np.array([0, 0, 1, 1, 0])
    apart = np.where(form[:, None] == form, 0.1, 1.1)
    np.fill_diagonal(apart, 0.0)
    known = Understanding(
        np.array([0, 1, 0, 1, 0]),
        np.zeros(5, dtype=np.int64),
        WordOrder(0, 1),
        evidence=Distances(np.stack([apart] * 2)),
    )
    lines = summarise(known, 1).splitlines()
    assert "There are 4 signs: 2 for objects, 2 for movements." in lines
    two = (
        "  Two ways of writing the red object: signs like the first of demonstrations 1, 2, 5; and of demonstrations 3"
    )
    assert f"{two}, 4." in lines


def test_words_that_mean_nothing_are_told() -> None:
    evidence = np.full((3, 3), -np.inf)
    evidence[0, 2], evidence[2, 0] = 9.0, 1.0
    known = understood(word_order_evidence=evidence)._replace(word_order=WordOrder(0, 2))
    why = explain_understanding(known, OBJECTS)
    assert why.idle_words == (1,)
    assert "The second word means nothing." in why.text
    assert "means nothing" not in explain_understanding(understood(), OBJECTS).text


def test_the_word_order_cannot_be_told_where_another_explains_nearly_as_much() -> None:
    near, far = (understood([[-np.inf, 30.0], [30.0 - loss, -np.inf]]) for loss in (ORDER_DOUBT - 0.1, ORDER_DOUBT))
    plain = "the first word names the object, the second word names the movement."
    assert word_order_text(near) == f"The word order cannot be told yet; so far it seems that {plain}"
    assert word_order_text(far) == plain.capitalize()
    assert word_order_text(understood([[3.0]])._replace(word_order=WordOrder(0, 0))).startswith("The first word")


def test_a_word_order_that_is_told_is_right_from_the_first_demonstrations_on() -> None:
    told = 0
    for seed in range(4):
        session = compose_study_session(study_condition(3, 3, 1), seed)
        language = session.truth.language
        for count in (1, 2, 3, 4, 6):
            known = learn(DemonstrationSet(list(session.demonstrations)[:count])).understanding
            if "cannot be told" not in word_order_text(known):
                told += 1
                assert tuple(known.word_order) == (language.focus_word, language.movement_word)
    assert told >= 4  # of 20: all after six demonstrations
