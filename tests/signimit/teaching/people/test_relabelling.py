"""Public labels become those of a language."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from signimit import Stroke, StrokeLibrary, UnknownNameError
from signimit.teaching.people.relabelling import renamed, selected, with_mirror_images


@pytest.fixture
def library() -> StrokeLibrary:
    strokes = tuple(Stroke(np.array([(0, 0), (i, 2.0)]), np.array([0, 1.0])) for i in range(3))
    return StrokeLibrary(strokes, ("triangle", "circle", "triangle"), ("a", "a", "b"), "here")


def test_labels_are_renamed_and_the_rest_stays(library: StrokeLibrary) -> None:
    new = renamed(library, {"triangle": "triangle up"})
    assert new.labels == ("triangle up", "circle", "triangle up")
    assert (new.strokes, new.writers, new.source) == (library.strokes, library.writers, library.source)


def test_mirror_images_are_added_upside_down(library: StrokeLibrary) -> None:
    new = with_mirror_images(library, {"triangle": "triangle down"})
    assert new.labels == (*library.labels, "triangle down", "triangle down")
    assert new.writers == ("a", "a", "b", "a", "b")
    assert new.source == "here"
    assert_allclose(new[4].points, [(0, 0), (2, -2)])


def test_labels_and_writers_are_chosen_in_the_librarys_order(library: StrokeLibrary) -> None:
    assert selected(library).strokes == library.strokes
    assert selected(library, writers=["b", "a"]).writers == ("a", "a", "b")
    assert selected(library, ["triangle"], ["b"]).strokes == library[2:]
    with pytest.raises(UnknownNameError, match="Unknown writer 'c'; known are a, b"):
        selected(library, writers=["c"])
    with pytest.raises(UnknownNameError, match="Unknown label 'heart'"):
        selected(library, ["heart"])


@pytest.mark.parametrize("change", [renamed, with_mirror_images])
def test_unknown_labels_are_refused(library: StrokeLibrary, change) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(UnknownNameError, match="Unknown label 'heart'; known are circle, triangle"):
        change(library, {"heart": "x"})
