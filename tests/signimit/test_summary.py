"""The summary says in words how many movements there are, who shows them, about what, and what signs mean."""

import numpy as np
import pytest

from signimit import WordOrder
from signimit.learners.base import Understanding
from signimit.summary import object_name, ordinal, summarise


def understanding(labels: list[int], focus: list[int], order: WordOrder) -> Understanding:
    return Understanding(np.array(labels), np.array(focus), order, {})


def test_what_was_understood_is_said() -> None:
    text = summarise(understanding([0, 1, 0], [0, 2, 2], WordOrder(focus=0, movement=1)), 3)
    assert text.splitlines() == [
        "3 demonstrations show 2 movements.",
        "  Movement 0: demonstrations 0 (about red), 2 (about blue).",
        "  Movement 1: demonstration 1 (about blue).",
        "The first word names the object, the second word names the movement.",
        "  Signs like the first of demonstration 0 mean the red object.",
        "  No sign was seen for the green object.",
        "  Signs like the first of demonstrations 1, 2 mean the blue object.",
        "  Signs like the second of demonstrations 0, 2 mean movement 0.",
        "  Signs like the second of demonstration 1 mean movement 1.",
    ]


def test_a_swapped_word_order_and_one_movement_are_said() -> None:
    text = summarise(understanding([0], [1], WordOrder(focus=1, movement=0)), 2)
    assert "1 demonstration shows 1 movement." in text
    assert "The second word names the object, the first word names the movement." in text


@pytest.mark.parametrize(("index", "name"), [(0, "red"), (1, "green"), (2, "blue"), (6, "number 6")])
def test_objects_have_colours_while_there_are_some(index: int, name: str) -> None:
    assert object_name(index) == name


@pytest.mark.parametrize(("position", "name"), [(0, "first"), (1, "second"), (6, "7th")])
def test_positions_are_counted_in_words(position: int, name: str) -> None:
    assert ordinal(position) == name
