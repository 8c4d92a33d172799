"""Explanations say what is in doubt, and why, worked by hand."""

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import InvalidInputError, WordOrder
from signimit.explanation import explain_understanding
from signimit.learners.base import Understanding

OBJECTS = np.array([[[0.0, 0.0], [0.03, 0.04], [0.5, 0.5]]] * 2)


def understood(orders: list[list[float]] | None = None, **changes: NDArray[np.float64]) -> Understanding:
    diagnostics = {
        "focus_probability": np.array([[0.98, 0.01, 0.01], [0.98, 0.01, 0.01]]),
        "movement_probability": np.array([[0.99, 0.01, 0.0], [0.01, 0.98, 0.01]]),
        "word_order_evidence": np.array(orders or [[-np.inf, 30.0], [10.0, -np.inf]]),
    }
    labels, focus = np.array([0, 1]), np.array([0, 0])
    return Understanding(labels, focus, WordOrder(0, 1), diagnostics | changes)


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
    assert "Demonstration 1 is ambiguous: green 55%, red 40%; the first two are 0.05 m apart." in why.text


def test_a_movement_in_doubt_is_told() -> None:
    belief = np.array([[0.99, 0.01, 0.0], [0.3, 0.5, 0.2]])
    why = explain_understanding(understood(movement_probability=belief), OBJECTS)
    assert why.unsure_movements == (1,)
    assert "Demonstration 1 may show movement 0 30% or movement 1 50% or a new one 20%." in why.text


def test_word_orders_are_ranked_by_what_they_lose() -> None:
    why = explain_understanding(understood(), OBJECTS)
    assert why.word_orders == ((WordOrder(0, 1), 0), (WordOrder(1, 0), 20))
    assert "second word the object and first the movement, explains 20.0 nats less" in why.text
    assert "only one word order" in explain_understanding(understood([[3.0]]), OBJECTS).text


def test_a_learner_without_probabilities_has_nothing_to_explain() -> None:
    with pytest.raises(InvalidInputError, match='probabilities, which "joint" has'):
        explain_understanding(understood()._replace(diagnostics={}), OBJECTS)
