"""Judging a performed path: what it was, about which object, how far round, by hand and by what must not matter."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import InvalidInputError, count_turns, performed
from signimit.evaluation import NOTHING, TOLERANCE, Performance, settled_part

Array = NDArray[np.float64]
OBJECTS = np.array([[-0.15, 0.0], [0.15, 0.05], [0.0, 0.15]])
properties = settings(deadline=None, derandomize=True, max_examples=15)


def polygon(corners: Array, loops: int = 1) -> Array:
    """Return a closed path through corners at a steady speed."""
    closed = np.vstack([np.tile(corners, (loops, 1)), corners[:1]])
    ticks = np.arange(0, len(closed) - 1 + 1e-9, 0.05)
    return np.column_stack([np.interp(ticks, np.arange(len(closed)), closed[:, d]) for d in (0, 1)])


def circle(loops: float = 1, radius: float = 0.1) -> Array:
    angle = np.linspace(0, 2 * np.pi * loops, int(100 * loops))
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


UP = np.array([[-0.1, -0.087], [0.1, -0.087], [0.0, 0.087]])  # corners of a triangle, counter-clockwise
SHAPES = {"up": polygon(UP), "down": polygon(UP[::-1] * [1, -1]), "circle": circle(), "clockwise": circle()[::-1]}
TEMPLATES = [[shape] for shape in SHAPES.values()]


@pytest.mark.parametrize("focus", range(3))
@pytest.mark.parametrize("movement", range(4))
def test_a_shown_drawing_about_an_object_is_told_from_all_others(movement: int, focus: int) -> None:
    path = np.tile(TEMPLATES[movement][0], (3, 1)) + OBJECTS[focus]
    found = performed(path, OBJECTS, TEMPLATES)
    assert (found.movement, found.focus) == (movement, focus)
    assert found.misfit < 0.1
    assert found.coverage == 1.0


@pytest.mark.parametrize(("shape", "turns"), [("circle", 3), ("clockwise", -3), ("up", 3), ("down", 3)])
def test_turns_are_counted_with_their_sense(shape: str, turns: float) -> None:
    loops = {
        "circle": circle(3),
        "clockwise": circle(3)[::-1],
        "up": polygon(UP, 3),
        "down": polygon(UP[::-1] * [1, -1], 3),
    }
    found = performed(loops[shape] + OBJECTS[1], OBJECTS, TEMPLATES)
    assert found.turns == pytest.approx(turns, abs=0.02)
    assert count_turns(loops[shape] + OBJECTS[1], OBJECTS[0]) == pytest.approx(
        0.0, abs=0.3
    )  # a neighbour is not circled


def test_the_way_to_the_object_is_not_judged() -> None:
    reach = np.linspace([0.3, -0.3], OBJECTS[0] + [0.1, 0.0], 90)
    found = performed(np.vstack([reach, circle(2) + OBJECTS[0]]), OBJECTS, TEMPLATES)
    assert (found.movement, found.focus) == (2, 0)


@pytest.mark.parametrize(
    "path",
    [np.zeros((0, 2)), [[0.1, 0.1]], np.tile([0.1, 0.2], (50, 1)), 0.001 * circle(1)],
    ids=["no point", "one point", "at rest", "hardly moved"],
)
def test_a_hand_that_rests_performs_nothing(path: Any) -> None:
    assert performed(path, OBJECTS, TEMPLATES) == NOTHING


def test_no_objects_leave_nothing_to_perform_about() -> None:
    assert performed(circle(), np.zeros((0, 2)), TEMPLATES) == NOTHING


def test_a_path_like_none_of_the_drawings_is_none_of_them() -> None:
    path = np.linspace([-0.3, -0.3], [0.3, 0.3], 100)
    found = performed(path, OBJECTS, TEMPLATES)
    assert (found.movement, found.focus) == (-1, -1)
    assert TOLERANCE < found.misfit < np.inf


def test_half_a_drawing_covers_half_of_it() -> None:
    found = performed(np.tile(circle(0.5) + OBJECTS[0], (3, 1)), OBJECTS[:1], [[circle()]])
    assert 0.5 < found.coverage < 0.8


def test_the_error_by_hand() -> None:
    # a circle of twice the radius, sampled alike: half a size off there and back, in the same direction
    found = performed(circle(3, 0.2), [[0.0, 0.0]], [[circle(1, 0.1)]])
    assert found.misfit == pytest.approx((0.1 + 0.1) / (2 * 0.1), abs=0.02)


def test_a_movements_error_is_the_mean_of_its_two_best_drawings() -> None:
    path, objects = circle(3), [[0.0, 0.0]]
    alone = [performed(path, objects, [[circle(1, r)]]).misfit for r in (0.1, 0.11, 0.2)]
    together = performed(path, objects, [[circle(1, r) for r in (0.2, 0.1, 0.11)]]).misfit
    assert together == pytest.approx((alone[0] + alone[1]) / 2)


def test_a_drawing_beside_its_object_is_judged_as_one_about_it() -> None:
    aside, path = np.array([0.3, -0.2]), circle(3, 0.11)
    about = performed(path, [[0.0, 0.0]], [[circle()]])
    beside = performed(path + aside, [[0.0, 0.0]], [[circle() + aside]])
    assert beside[:4] == pytest.approx(about[:4])


@properties
@given(st.floats(-100, 100), st.floats(-100, 100), st.integers(0, 3), st.integers(0, 2))
def test_moving_path_and_objects_together_changes_nothing(x: float, y: float, movement: int, focus: int) -> None:
    shift = np.array([x, y])
    path = np.tile(TEMPLATES[movement][0], (3, 1)) + OBJECTS[focus]
    here, there = performed(path, OBJECTS, TEMPLATES), performed(path + shift, OBJECTS + shift, TEMPLATES)
    assert (here.movement, here.focus) == (there.movement, there.focus)
    np.testing.assert_allclose(there[2:], here[2:], atol=1e-6)


@properties
@given(st.integers(0, 10_000))
def test_movements_and_objects_in_another_order_are_found_there(seed: int) -> None:
    rng = np.random.default_rng(seed)
    movements, places = rng.permutation(4), rng.permutation(3)
    path = np.tile(TEMPLATES[1][0], (3, 1)) + OBJECTS[2]
    found = performed(path, OBJECTS[places], [TEMPLATES[m] for m in movements])
    assert (movements[found.movement], places[found.focus]) == (1, 2)


def test_the_last_two_thirds_are_judged() -> None:
    path = np.column_stack([np.arange(91.0), np.zeros(91)])
    settled = settled_part(path)
    assert settled is not None
    assert settled[0].tolist() == [30.0, 0.0]
    assert settled[-1].tolist() == [90.0, 0.0]
    assert settled.shape == (200, 2)


def test_inputs_may_be_read_only_and_are_not_written_to() -> None:
    path, objects, template = circle(3) + OBJECTS[0], OBJECTS.copy(), circle()
    for array in (path, objects, template):
        array.setflags(write=False)
    performed(path, objects, [[template]])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((np.zeros((3, 3)), OBJECTS, TEMPLATES), "path: expected numbers of shape (n, 2), found shape (3, 3)."),
        ((circle() * np.nan, OBJECTS, TEMPLATES), "path: expected finite numbers, found nan at index (0, 0)."),
        ((circle(), OBJECTS[0], TEMPLATES), "objects: expected numbers of shape (n, 2), found shape (2,)."),
        ((circle(), OBJECTS, []), "templates: expected at least one, found none."),
        ((circle(), OBJECTS, 3), "templates: expected a list, found int."),
        ((circle(), OBJECTS, [[circle()], []]), "templates of movement 1: expected at least one, found none."),
        ((circle(), OBJECTS, [[circle()], [circle()[:1]]]), "template: expected at least 2 points, found 1."),
        ((circle(), OBJECTS, [circle()]), "template: expected numbers of shape (n, 2), found shape (2,)."),
    ],
)
def test_what_cannot_be_judged_is_told(arguments: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        performed(*arguments)
    assert sentence in str(caught.value)


def test_the_misfit_keeps_the_name_of_version_0_1_0() -> None:
    assert Performance(0, 1, 0.25, 1.0, 2.0).path_error == 0.25
