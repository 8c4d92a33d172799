"""People from files and synthetic ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from signimit.exceptions import FileFormatError, InvalidInputError, UnknownNameError
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people.choosing import Source, choose_people, load_person


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


@pytest.fixture
def shapes(tmp_path: Path) -> Path:
    """Two writers: "a" drew a triangle and a circle, "b" only a triangle."""
    triangle = Stroke(np.array([[0, 1], [-1, -1], [1, -1], [0, 1.0]]), np.arange(4.0))
    circle = Stroke(np.array([[0, 1], [-1, 0], [0, -1], [1, 0], [0, 1.0]]), np.arange(5.0))
    library = StrokeLibrary((triangle, circle, triangle), ("triangle", "circle", "triangle"), ("a", "a", "b"))
    library.save(tmp_path / "shapes.npz")
    return tmp_path / "shapes.npz"


def test_synthetic_people_draw_everything_the_language_needs_and_are_called_synthetic() -> None:
    people = choose_people(PAPER_LANGUAGE, rng())
    assert set(people.signs.labels) == {*"123456789"}
    assert set(people.movements.labels) == set(PAPER_LANGUAGE.movements)
    assert all("synthetic" in name for name in people.names)


def test_anybody_is_somebody_who_drew_everything(shapes: Path) -> None:
    for seed in range(5):
        _, name = load_person(Source(shapes), PAPER_LANGUAGE.movements, np.random.default_rng(seed))
        assert name == "a of shapes.npz"


def test_a_named_person_is_taken_alone(shapes: Path) -> None:
    library, name = load_person(Source(shapes, "b"), ("triangle up",), rng())
    assert name == "b of shapes.npz"
    assert set(library.writers) == {"b"}


def test_a_person_who_did_not_draw_something_is_refused_by_name(shapes: Path) -> None:
    with pytest.raises(InvalidInputError, match=r"shapes.npz: b: .*none of circle"):
        load_person(Source(shapes, "b"), PAPER_LANGUAGE.movements, rng())


def test_an_unknown_person_is_told_who_is_there(shapes: Path) -> None:
    with pytest.raises(UnknownNameError, match="known are a, b"):
        load_person(Source(shapes, "c"), ("circle",), rng())


def test_a_person_without_a_library_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="a stroke library"):
        choose_people(PAPER_LANGUAGE, rng(), Source(None, "a"))


def test_another_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.npz").write_bytes(b"no")
    with pytest.raises(FileFormatError, match="stroke library"):
        choose_people(PAPER_LANGUAGE, rng(), Source(tmp_path / "x.npz"))


def test_a_library_at_hand_serves_as_well_as_its_file(shapes: Path) -> None:
    of_file, _ = load_person(Source(shapes), ("circle",), rng())
    of_library, name = load_person(Source(StrokeLibrary.load(shapes)), ("circle",), rng())
    assert name.startswith("a of ")
    assert [s.points.tobytes() for s in of_library] == [s.points.tobytes() for s in of_file]


def test_somebody_who_drew_too_little_is_not_chosen(shapes: Path) -> None:
    with pytest.raises(
        InvalidInputError, match="everybody: expected at least 2 strokes each of circle, found fewer of circle"
    ):
        load_person(Source(shapes), ("circle",), rng(), least=2)
