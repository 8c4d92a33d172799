"""Components of UNIPEN text: which there are, where, when, and in which units."""

import pytest
from numpy.testing import assert_allclose

from signimit import FileFormatError
from signimit.io.formats.unipen import pen_data
from signimit.io.formats.unipen.pen_data import PenReader
from signimit.io.formats.unipen.statements import StatementReader


def read_pen(text: str) -> PenReader:
    pen = PenReader()
    for statement in StatementReader("a.dat").read(text):
        pen.read(statement)
    pen.finish()
    return pen


def test_a_component_is_a_pen_down_or_pen_up_that_has_points() -> None:
    text = ".PEN_DOWN\n1 2\n3 4\n.PEN_UP\n.PEN_UP\n5 6\n.PEN_DOWN\n.PEN_DOWN 7 8\n.5 -1e1\n\n.PEN_UP\n\n"
    pen = read_pen(text)
    assert [(c.down, c.points.tolist()) for c in pen.components] == [
        (True, [[1, 2], [3, 4]]),
        (False, [[5, 6]]),
        (True, [[7, 8], [0.5, -10]]),
    ]
    assert [c.switch for c in pen.components] == [0, 2, 4]


@pytest.mark.parametrize(
    ("coord", "rows", "stamps"),
    [
        ("Y X", "2 1\n4 3", None),
        ("X Y T", "1 2 70\n3 4 80", [70, 80]),
        ("T Y X", "70 2 1\n80 4 3", [70, 80]),
        ("X Y Z P B RHO THETA PHI", "1 2 9 9 9 9 9 9\n3 4 9 9 9 9 9 9", None),
        ("x y p", "1 2 512\n3 4 513", None),
        ("X Y", "1 2 3 4", None),
        ("X Y", "1\n2\n3\n4", None),
        ("X Y T", "1 2 70 3 4 80", [70, 80]),
    ],
)
def test_coord_says_which_number_is_what(coord: str, rows: str, stamps: list[float] | None) -> None:
    (component,) = read_pen(f".COORD {coord}\n.PEN_DOWN\n{rows}\n.PEN_UP\n").components
    assert component.points.tolist() == [[1, 2], [3, 4]]
    assert (None if component.stamps is None else component.stamps.tolist()) == stamps


@pytest.mark.parametrize("coord", ["X", "RHO THETA", "X X Y", "X Y T T", ""])
def test_coordinates_without_one_x_and_one_y_are_refused(coord: str) -> None:
    with pytest.raises(FileFormatError, match=r"a.dat: line 1: expected .COORD with X and Y, once each, found '.*'\."):
        read_pen(f".COORD {coord}\n.PEN_DOWN\n1 2\n")


@pytest.mark.parametrize(
    ("coord", "rows", "line", "sentence"),
    [
        ("X Y", "1 2\n3\n4 5", 4, "expected two numbers, found '3'"),
        ("X Y", "1 2\n3 nine", 4, "expected two numbers, found '3 nine'"),
        ("X Y", "1 2 500\n3 4 500", 3, "expected two numbers, found '1 2 500'"),
        ("X Y T", "1 2\n3 4\n5 6", 3, "expected 3 numbers, X Y T, found '1 2'"),
        ("X Y", "1\n2\n3", 3, "expected two numbers, found '1'"),
    ],
)
def test_a_row_that_is_no_point_spoils_its_component_only(coord: str, rows: str, line: int, sentence: str) -> None:
    whole = " ".join("9" * len(coord.split()))
    pen = read_pen(f".COORD {coord}\n.PEN_DOWN\n{rows}\n.PEN_UP\n.PEN_DOWN\n{whole}\n.PEN_UP\n")
    spoilt, good = pen.components
    assert str(spoilt.error) == f"a.dat: line {line}: {sentence}."
    assert len(spoilt.points) == 0
    assert good.error is None
    assert good.points.tolist() == [[9, 9]]


@pytest.mark.parametrize(
    ("declared", "y"),
    [
        (".X_POINTS_PER_INCH 200\n.Y_POINTS_PER_INCH 100", 60),
        (".X_POINTS_PER_MM 5\n.Y_POINTS_PER_MM 20", 7.5),
        (".X_POINTS_PER_INCH 254\n.Y_POINTS_PER_MM 5", 60),
        (".X_POINTS_PER_INCH 254\n.Y_POINTS_PER_MM 10", 30),
        (".POINTS_PER_INCH 100", 30),
        (".X_POINTS_PER_INCH 200", 30),
        (".X_POINTS_PER_INCH 200\n.Y_POINTS_PER_INCH ?", 30),
        (".X_POINTS_PER_INCH 0\n.Y_POINTS_PER_INCH 100", 30),
        (".X_POINTS_PER_INCH 200\n.Y_POINTS_PER_INCH -1", 30),
        (".X_POINTS_PER_INCH 200\n.Y_POINTS_PER_INCH nan", 30),
    ],
)
def test_y_is_told_in_units_of_x(declared: str, y: float) -> None:
    (component,) = read_pen(f"{declared}\n.PEN_DOWN\n10 30\n").components
    assert_allclose(component.points, [(10, y)])


def test_declarations_hold_from_where_they_stand() -> None:
    first, second = read_pen(
        ".WRITER_ID ann\n.PEN_DOWN\n1 2\n.WRITER_ID Bob Lee\n.COORD Y X\n.PEN_DOWN\n1 2\n"
    ).components
    assert (first.points.tolist(), first.writer) == ([[1, 2]], "ann")
    assert (second.points.tolist(), second.writer) == ([[2, 1]], "Bob Lee")


def test_pen_up_points_and_dt_tell_how_long_a_pause_was() -> None:
    text = (
        ".POINTS_PER_SECOND 100\n.PEN_DOWN\n0 0\n1 0\n.PEN_UP\n2 0\n3 0\n4 0\n.PEN_DOWN\n5 0\n6 0\n.PEN_UP\n.DT 250\n"
        ".PEN_DOWN\n7 0\n.PEN_UP\n.PEN_DOWN\n8 0\n"
    )
    components = read_pen(text).components
    assert [c.interval for c in components] == [0.01] * 5
    assert [c.run for c in components] == [0, 0, 0, 0, 1]  # nothing tells how long the pen was up before the last
    assert_allclose([c.start for c in components], [0, 0.02, 0.05, 0.31, 0])


@pytest.mark.parametrize("rate", ["9600", "0", "?", "-100", "nan", "1e-300", ""])
def test_a_rate_that_no_tablet_has_is_passed_over(rate: str) -> None:
    pen = read_pen(f".POINTS_PER_SECOND {rate}\n.DT 100\n.PEN_DOWN\n1 2\n.PEN_UP\n3 4\n")
    assert [(c.interval, c.start) for c in pen.components] == [(None, 0), (None, 0)]
    assert [f.what for f in pen.findings] == [".POINTS_PER_SECOND that no tablet has, which is passed over"]


def test_stamps_that_lipitk_leaves_0_are_spread_between_the_others() -> None:
    text = ".COORD X Y T\n.PEN_DOWN\n1 2 8000\n1 3 0\n1 4 0\n1 5 8300\n.PEN_UP\n.PEN_DOWN\n1 2 0\n1 3 8\n.PEN_UP\n"
    pen = read_pen(text + ".PEN_DOWN\n1 2 9000\n1 3 0\n.PEN_UP\n")
    filled, from_0, open_end = (component.stamps for component in pen.components)
    assert filled is not None
    assert_allclose(filled, [8000, 8100, 8200, 8300])
    assert from_0 is not None
    assert_allclose(from_0, [0, 8])
    assert open_end is None
    assert [(f.where, f.number, f.kind) for f in pen.findings] == [
        ("a.dat: line 2", 2, "assumed"),
        ("a.dat: line 12", 1, "assumed"),
    ]


@pytest.mark.parametrize(
    ("text", "is_cut"),
    [
        (".PEN_DOWN\n1 2\n.PEN_UP\n.PEN_DOWN\n3 4\n", True),
        (".PEN_DOWN\n1 2\n.PEN_UP\n.PEN_DOWN\n3 4\n.PEN_UP\n", False),
        (".PEN_DOWN\n1 2\n.PEN_DOWN\n3 4\n", False),
        (".PEN_DOWN\n1 2\n.PEN_UP\n2 3\n.PEN_DOWN\n3 4\n", False),
        (".PEN_DOWN\n1 2\n.PEN_UP\n.PEN_DOWN\n2 3\n.PEN_DOWN\n3 4\n", False),
        (".PEN_DOWN\n1 2\n", False),
    ],
)
def test_the_last_component_is_cut_off_if_all_others_are_ended(text: str, is_cut: bool) -> None:
    last = read_pen(text).components[-1]
    assert ("found the end of the file" in str(last.error)) is is_cut


def test_more_components_and_longer_lines_than_can_be_meant_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    (component,) = read_pen(".PEN_DOWN\n" + "1 " * 600_000 + "\n").components
    assert "expected two numbers, found '1 1 1" in str(component.error)
    monkeypatch.setattr(pen_data, "MOST_COMPONENTS", 2)
    with pytest.raises(FileFormatError, match=r"line 5: expected at most 2 components, found more"):
        read_pen(".PEN_DOWN\n1 2\n" * 3)
