"""Drawings of UNIPEN text: segments of a level, with the points, times, labels and writers that the standard means."""

from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from signimit import FileFormatError, UnknownNameError
from signimit.io.formats import read_strokes
from signimit.io.formats.import_report import StrokeImportWarning
from signimit.io.formats.unipen import drawings, parse_unipen, read_unipen


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "digits.txt"
    path.write_text(text)
    return path


NESTED = r""".VERSION 1.0
.HIERARCHY PAGE WORD CHARACTER
.COORD X Y
.POINTS_PER_SECOND 100
.WRITER_ID ann
.SEGMENT PAGE 0-4 ? ""
.SEGMENT WORD 0-3 GOOD "a \"b\""
.SEGMENT CHARACTER 0:0-2:1 OK "a"
.SEGMENT CHARACTER 2:1-2:2,3 BAD "b"
.START_SET words
.PEN_DOWN
0 0
1 0
.PEN_UP
2 0
3 0
.PEN_DOWN
4 0
5 0
6 0
.PEN_UP
.DT 40
.PEN_DOWN
7 0
8 0
.PEN_UP
.WRITER_ID bob
.START_BOX
.PEN_DOWN
90 90
91 90
"""


def test_segments_of_the_innermost_labelled_level_are_drawings(tmp_path: Path) -> None:
    pen_file = parse_unipen(NESTED, tmp_path / "page.dat")
    a, b = pen_file.recordings
    assert (a.label, b.label, a.writer, b.writer) == ("a", "b", "ann", "ann")
    assert [piece.tolist() for piece in a.pieces] == [[[0, 0], [1, 0]], [[4, 0], [5, 0]]]  # without the pen-up points
    assert [piece.tolist() for piece in b.pieces] == [[[5, 0], [6, 0]], [[7, 0], [8, 0]]]
    assert (a.where, b.where) == (f"{tmp_path / 'page.dat'}: line 8", f"{tmp_path / 'page.dat'}: line 9")
    assert [(f.what, f.number, f.kind) for f in pen_file.findings] == [
        ("pen-down components in no segment", 1, "assumed")
    ]
    assert not pen_file.left_out


def test_another_level_can_be_chosen(tmp_path: Path) -> None:
    path = written(tmp_path, NESTED)
    word = read_unipen(path, level="WORD")
    assert word.labels == ('a "b"',)
    assert word[0].points.tolist() == [[x, 0] for x in range(9)]
    assert read_unipen(path, level="PAGE").labels == ("digits",)  # it has no label: the file's name
    with pytest.raises(UnknownNameError, match="Unknown level of segments 'LINE'; known are PAGE, WORD, CHARACTER"):
        read_unipen(path, level="LINE")


def test_a_declared_rate_pen_up_points_and_dt_give_the_time(tmp_path: Path) -> None:
    (word,) = read_unipen(written(tmp_path, NESTED), level="WORD")
    assert_allclose(word.times, [0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.1, 0.11])


def test_without_a_told_pause_points_keep_the_declared_rate(tmp_path: Path) -> None:
    text = '.POINTS_PER_SECOND 50\n.SEGMENT C 0-1 OK "i"\n.PEN_DOWN\n0 4\n0 3\n.PEN_UP\n.PEN_DOWN\n0 1\n0 0\n.PEN_UP\n'
    (stroke,) = read_unipen(written(tmp_path, text))
    assert stroke.points.tolist() == [[0, 4], [0, 3], [0, 2], [0, 1], [0, 0]]
    assert_allclose(stroke.times, [0, 0.02, 0.04, 0.06, 0.08])


def test_a_part_of_a_component_keeps_its_stamps(tmp_path: Path) -> None:
    text = '.COORD X Y T\n.SEGMENT C 0:1-0:3 OK "i"\n.PEN_DOWN\n0 4 10\n0 3 30\n0 2 40\n0 0 70\n0 0 80\n.PEN_UP\n'
    (stroke,) = read_unipen(written(tmp_path, text))
    assert stroke.points.tolist() == [[0, 3], [0, 2], [0, 0]]
    assert_allclose(stroke.times, [0, 0.01, 0.04])


def test_components_in_pieces_are_joined_in_the_order_in_which_they_are_named(tmp_path: Path) -> None:
    text = '.PEN_DOWN\n3 0\n4 0\n.PEN_UP\n.PEN_DOWN\n1 0\n2 0\n.PEN_UP\n.SEGMENT C 1,0 OK "-"\n'
    (stroke,) = read_unipen(written(tmp_path, text))
    assert stroke.points.tolist() == [[1, 0], [2, 0], [3, 0], [4, 0]]


DATA = ".WRITER_ID ann\n.PEN_DOWN\n1 2\n3 4\n.PEN_UP\n.PEN_DOWN\n5 6\n7 8\n.PEN_UP\n"


def test_segments_of_included_pen_data_are_read_once(tmp_path: Path) -> None:
    (tmp_path / "raw").mkdir()
    (tmp_path / "raw" / "x.dat").write_text(DATA)
    path = tmp_path / "a.dat"
    path.write_text('.VERSION 1.0\n.INCLUDE raw/x.dat\n.SEGMENT CHARACTER 1 ? "a"\n.SEGMENT CHARACTER 0 ? "b"\n')
    assert parse_unipen(path.read_text(), path).includes == ((tmp_path / "raw" / "x.dat").resolve(),)
    library = read_unipen(path)
    assert (library.labels, library.writers) == (("a", "b"), ("ann", "ann"))
    assert library[0].points.tolist() == [[5, 6], [7, 8]]
    assert read_strokes([tmp_path]).labels == ("a", "b")
    assert read_strokes([path, tmp_path / "raw"]).labels == ("a", "b")


def test_missing_pen_data_is_said_with_the_file_that_was_not_found(tmp_path: Path) -> None:
    path = written(tmp_path, '.VERSION 1.0\n.INCLUDE raw/x.dat\n.SEGMENT CHARACTER 1 ? "a"\n')
    with pytest.raises(FileFormatError) as caught:
        read_unipen(path)
    assert str(caught.value) == (
        f"{path}: expected UNIPEN text with .PEN_DOWN and points, "
        f"found none ({path}: line 2: .INCLUDE of a file that is not there)."
    )


def test_without_segments_the_file_is_one_drawing(tmp_path: Path) -> None:
    path = written(tmp_path, DATA)
    library = read_unipen(path)
    assert (library.labels, library.writers) == (("digits",), ("ann",))
    assert library[0].points.tolist() == [[1, 2], [3, 4], [5, 6], [7, 8]]
    findings = parse_unipen(DATA, path).findings
    assert [(f.what, f.kind) for f in findings] == [("no .SEGMENT: the whole file taken as one drawing", "assumed")]


@pytest.mark.parametrize(
    ("segments", "sentence"),
    [
        ('.SEGMENT C 7 ? "b"\n', "line 2: expected component 7 of 'b', found 2 components, from 0."),
        (".SEGMENT C 1 ?\n", 'line 2: expected .SEGMENT level first-last quality "label", found no label.'),
        ('.SEGMENT C 1:1-1:9 ? "b"\n', "line 2: expected points 1 to 9 of component 1, found 2."),
        ('.SEGMENT C 1:1-1:1 ? "b"\n', "line 2: stroke points: expected at least 2 points, found 1."),
    ],
)
def test_one_bad_segment_does_not_spoil_the_others(tmp_path: Path, segments: str, sentence: str) -> None:
    path = written(tmp_path, '.SEGMENT C 0 ? "a"\n' + segments + DATA)
    with pytest.warns(StrokeImportWarning) as caught:
        assert read_unipen(path).labels == ("a",)
    assert str(caught[0].message).endswith(f"{path}: {sentence}")


def test_a_drawing_needs_the_pen_down(tmp_path: Path) -> None:
    text = '.SEGMENT C 0 ? "a"\n.PEN_UP\n1 2\n3 4\n.PEN_DOWN\n5 6\n'
    with pytest.raises(FileFormatError, match=r"line 1: expected a component of 'a' with the pen down, found none"):
        read_unipen(written(tmp_path, text))


def test_there_are_as_many_segments_as_can_be_meant(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawings, "MOST_SEGMENTS", 2)
    with pytest.raises(FileFormatError, match=r"line 3: expected at most 2 segments, found more"):
        read_unipen(written(tmp_path, ".SEGMENT C\n" * 3 + DATA))
