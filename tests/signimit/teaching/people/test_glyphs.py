"""The glyphs are what their names say, in the senses of rotation that their module states."""

import numpy as np
import pytest

from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS, SIGN_LABELS
from signimit.teaching.people.glyphs import GLYPHS


def area(points: np.ndarray) -> float:
    x, y = points.T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


@pytest.mark.parametrize("label", GLYPHS)
def test_targets_and_arcs_go_together_and_cannot_be_written(label: str) -> None:
    glyph = GLYPHS[label]
    assert glyph.targets.shape == (len(glyph.arcs) + 1, 2)
    assert np.isfinite(glyph.targets).all()
    assert (np.abs(glyph.arcs) < 2 * np.pi).all()
    assert not glyph.targets.flags.writeable
    assert not glyph.arcs.flags.writeable


def test_there_are_ten_digits_nine_movements_and_four_reaches() -> None:
    assert tuple("0123456789") == SIGN_LABELS
    assert len(MOVEMENT_LABELS) == 9
    assert set(MOVEMENT_LABELS) > {"circle", "triangle up", "triangle down", "square", "zigzag", "spiral", "star"}
    assert len(set(SIGN_LABELS + MOVEMENT_LABELS + GOAL_LABELS)) == len(GLYPHS) == 23


@pytest.mark.parametrize("label", ["triangle up", "triangle down", "square", "circle, other way"])
def test_polygons_run_counter_clockwise(label: str) -> None:
    assert area(GLYPHS[label].targets[:-1]) > 0


def test_the_circle_runs_clockwise_from_the_top() -> None:
    assert area(GLYPHS["circle"].targets[:-1]) < 0
    assert GLYPHS["circle"].targets[0] == pytest.approx([0, 1])


def test_reaches_end_at_the_object() -> None:
    for label in GOAL_LABELS:
        assert GLYPHS[label].targets[-1] == pytest.approx([0, 0])
