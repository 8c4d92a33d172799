"""Libraries are changed as asked: labels, mirror images, noise."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from signimit import Stroke, StrokeLibrary, UnknownNameError
from signimit.teaching.people import synthetic_library
from signimit.teaching.people.relabelling import renamed, selected, with_both_triangles, with_mirror_images, with_waver


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


def test_the_waver_has_the_amount_it_says() -> None:
    library = synthetic_library(("circle",), samples=40, rng=np.random.default_rng(0))
    noisy = with_waver(library, np.random.default_rng(1), 0.06)
    shares = [
        np.sqrt(np.mean((a.points - b.points) ** 2)) / (np.ptp(b.points, axis=0).max() / 2)
        for a, b in zip(noisy.strokes, library.strokes, strict=True)
    ]
    assert np.mean(shares) == pytest.approx(0.06, rel=0.15)


def test_a_triangle_down_is_the_mirror_of_an_apex_up_triangle(library: StrokeLibrary) -> None:
    both = with_both_triangles(library)
    up, down = both.select("triangle up")[0], both.select("triangle down")[0]
    np.testing.assert_array_equal(up.points, library[0].points)
    np.testing.assert_array_equal(down.points, up.points * (1, -1))


def test_triangles_that_have_a_direction_stay_as_they_are() -> None:
    library = synthetic_library(["triangle up", "triangle down"], samples=2, rng=np.random.default_rng(0))
    assert with_both_triangles(library) is library
