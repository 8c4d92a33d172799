"""Strokes and libraries of them: checked copies, and files that come back the same or say what is wrong."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit import FileFormatError, InvalidInputError, Stroke, StrokeLibrary, UnknownNameError
from signimit.io.archive import write_archive
from signimit.strokes import cut, flatten

LINE = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0]])


def stroke(scale: float = 1.0) -> Stroke:
    return Stroke(scale * LINE, np.arange(3.0))


@pytest.fixture
def library() -> StrokeLibrary:
    longer = Stroke(np.vstack([LINE, [[9.0, 9.0]]]), np.arange(4.0))
    return StrokeLibrary((stroke(), longer, stroke(2.0)), ("4", "kreis ø", "4"), ("ann", "ann", "bob"), "nobody")


def test_a_stroke_is_a_read_only_copy() -> None:
    points = LINE.copy()
    made = Stroke(points, np.arange(3.0))
    points[:] = 0.0
    assert made.points.tolist() == LINE.tolist()
    assert len(made) == 3
    with pytest.raises(ValueError, match="read-only"):
        made.points[0, 0] = 1.0


@pytest.mark.parametrize(
    ("points", "times", "sentence"),
    [
        (LINE[:1], [0.0], "stroke points: expected at least 2 points, found 1."),
        (LINE, [0.0, 0.0, 1.0], "stroke times: expected strictly increasing seconds, found 0 then 0 at index 0."),
        (LINE, [0.0, 1.0], "stroke times: expected numbers of shape (3,), found shape (2,)."),
        (LINE * np.nan, [0.0, 1.0, 2.0], "stroke points: expected finite numbers, found nan at index (0, 0)."),
        (LINE * 0, [0.0, 1.0, 2.0], "stroke points: expected points that move, found 3 points in one place."),
    ],
)
def test_a_bad_stroke_names_its_field(points: Any, times: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        Stroke(points, times)
    assert str(caught.value) == sentence


def test_a_library_is_a_sequence(library: StrokeLibrary) -> None:
    assert len(library) == 3
    assert list(library) == [library[0], library[1], library[2]]
    assert library[1:] == (library[1], library[2])


def test_parts_are_chosen_by_label_and_writer(library: StrokeLibrary) -> None:
    assert library.select(label="4").writers == ("ann", "bob")
    assert library.select(writer="ann").labels == ("4", "kreis ø")
    assert library.select("4", "bob").strokes == (library[2],)
    assert len(library.select("kreis ø", "bob")) == 0
    assert library.select(label="4").source == "nobody"


def test_an_unknown_label_or_writer_is_told_with_the_known_ones(library: StrokeLibrary) -> None:
    with pytest.raises(UnknownNameError, match=r"Unknown label '5'; known are 4, kreis ø\."):
        library.select(label="5")
    with pytest.raises(UnknownNameError, match=r"Unknown writer 'eve'; known are ann, bob\."):
        library.select(writer="eve")


def test_libraries_add_up(library: StrokeLibrary) -> None:
    both = library + StrokeLibrary((stroke(),), ("x",), ("eve",), "somebody") + library
    assert len(both) == 7
    assert both.labels[3] == "x"
    assert both.source == "nobody + somebody + nobody"


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        (((stroke(),), (), ("a",)), "as many labels and writers as strokes, found 1 strokes, 0 labels, 1 writers"),
        (((stroke(),), (4,), ("a",)), "stroke library: labels: expected strs, found 4 at 0"),
        (((LINE,), ("4",), ("a",)), "stroke library: strokes: expected Strokes, found array"),
    ],
)
def test_a_library_has_a_label_and_a_writer_for_each_stroke(parts: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError, match=sentence):
        StrokeLibrary(*parts)


def test_a_library_comes_back_from_its_file(library: StrokeLibrary, tmp_path: Path) -> None:
    library.save(tmp_path / "l.npz")
    again = StrokeLibrary.load(tmp_path / "l.npz")
    assert (again.labels, again.writers, again.source) == (library.labels, library.writers, library.source)
    for a, b in zip(again, library, strict=True):
        assert a.points.tobytes() == b.points.tobytes()
        assert a.times.tobytes() == b.times.tobytes()
    again.save(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == (tmp_path / "l.npz").read_bytes()


def test_an_empty_library_comes_back_too(tmp_path: Path) -> None:
    StrokeLibrary((), (), ()).save(tmp_path / "l.npz")
    assert len(StrokeLibrary.load(tmp_path / "l.npz")) == 0


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"points": None}, "expected an array 'points', found none."),
        ({"offsets": np.array([0, 3, 6])}, "offsets of points: expected whole numbers rising from 0 to 10, found"),
        ({"offsets": np.array([0, 7, 3, 10])}, "offsets of points: expected whole numbers rising"),
        ({"offsets": np.array([0, -3, 3, 10])}, "offsets of points: expected whole numbers rising"),
        ({"offsets": np.array([0, 2**63, 7, 10], np.uint64)}, "offsets of points: expected whole numbers rising"),
        ({"offsets": np.array([0.0, 3.0, 7.0, 10.0])}, "offsets of points: expected whole numbers rising"),
        ({"offsets": np.array(3)}, "offsets of points: expected whole numbers rising"),
        ({"offsets": np.zeros(0, np.int64)}, "offsets of points: expected whole numbers rising"),
        ({"offsets": np.array([0, 1, 7, 10])}, "stroke 0: stroke points: expected at least 2 points, found 1."),
        ({"times": np.zeros(10)}, "stroke 0: stroke times: expected strictly increasing seconds"),
        ({"times": np.arange(9.0)}, "offsets of times: expected whole numbers rising from 0 to 9"),
        ({"points": np.zeros(())}, "points: expected numbers of shape"),
        ({"points": np.full((10, 2), "a")}, "points: expected numbers of shape"),
        ({"labels": np.array(["a"])}, "as many labels and writers as strokes"),
        ({"labels": np.arange(3)}, "labels: expected strs, found 0 at 0"),
        ({"writers": np.array("a")}, "as many labels and writers as strokes"),
    ],
)
def test_a_file_that_lies_is_told_with_its_name_and_field(
    library: StrokeLibrary, tmp_path: Path, changes: dict[str, Any], sentence: str
) -> None:
    points, times, offsets = flatten([(s.points, s.times) for s in library])
    arrays = {"points": points, "times": times, "offsets": offsets,
              "labels": np.array(library.labels), "writers": np.array(library.writers)} | changes  # fmt: skip
    path = tmp_path / "l.npz"
    write_archive(path, "stroke library", 1, {k: v for k, v in arrays.items() if v is not None})
    with pytest.raises(FileFormatError) as caught:
        StrokeLibrary.load(path)
    assert str(caught.value).startswith(str(path))
    assert sentence in str(caught.value)


def test_what_was_flattened_can_be_cut_apart() -> None:
    parts = [(s.points, s.times) for s in (stroke(), stroke(3.0))]
    points, times, offsets = flatten(parts)
    assert [p.tolist() for p in cut(points, "points", offsets)] == [p.tolist() for p, _ in parts]
    assert [t.tolist() for t in cut(times, "times", offsets)] == [t.tolist() for _, t in parts]
    assert cut(np.zeros((0, 2)), "points", np.array([0])) == []


def test_a_library_shows_counts_not_arrays() -> None:
    strokes = [Stroke(np.array([[0.0, 0.0], [1.0, 2.0]]), np.array([0.5, 2.0]))] * 3
    assert repr(strokes[0]) == "Stroke(2 points, 1.50 s)"
    library = StrokeLibrary(tuple(strokes), ("4", "4", "7"), ("ann",) * 3, "synthetic")
    assert repr(library) == "StrokeLibrary(3 strokes, 2 labels, 1 writer, source='synthetic')"


@pytest.mark.parametrize(
    "parts", [{"labels": ("half \ud800",)}, {"writers": ("\udfff",)}, {"source": "\ud800"}, {"source": 7}]
)
def test_text_that_cannot_be_printed_is_refused(parts: Any) -> None:
    whole = {"strokes": (stroke(),), "labels": ("4",), "writers": ("ann",), "source": ""}
    with pytest.raises(InvalidInputError, match="expected text"):
        StrokeLibrary(**{**whole, **parts})


@pytest.mark.parametrize("offsets", [[0, 2**63 - 1, -(2**63), -1, 3], [0, -1, 3], [0, 4, 3], [0.0, 3.0]])
def test_offsets_that_leave_the_array_are_refused_even_if_their_differences_overflow(offsets: Any) -> None:
    with pytest.raises(InvalidInputError, match="offsets of points: expected whole numbers rising from 0 to 3"):
        cut(LINE, "points", offsets)
