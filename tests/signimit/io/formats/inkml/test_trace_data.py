"""What stands in a trace: differences, wildcards, hexadecimals, booleans and commas."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from signimit import FileFormatError, StrokeLibrary
from signimit.io.formats import StrokeImportWarning
from signimit.io.formats.inkml.trace_data import read_trace_data
from signimit.io.formats.inkml.trace_format import Channel, TraceFormat

BUTTONS = TraceFormat(
    (
        Channel("X", "integer"),
        Channel("Y", "integer"),
        Channel("B1", "boolean", intermittent=True),
        Channel("B2", "boolean", intermittent=True),
    )
)
XY = TraceFormat()
XYT = TraceFormat((Channel("X"), Channel("Y"), Channel("T", intermittent=True)))


def test_the_example_of_the_standard() -> None:
    """Section 3.2.1: explicit values, velocities, accelerations, buttons that may be left out, a wildcard."""
    text = "1125 18432,'23'43,\"7\"-8,3-5,7-3,6 2,6 8,3 6 T,2 4*T,3 6,3-6 F F"
    expected = [
        (1125, 18432, 0, 0),
        (1148, 18475, 0, 0),  # velocities 23, 43
        (1178, 18510, 0, 0),  # 30, 35
        (1211, 18540, 0, 0),  # 33, 30
        (1251, 18567, 0, 0),  # 40, 27
        (1297, 18596, 0, 0),  # 46, 29
        (1349, 18633, 0, 0),  # 52, 37
        (1404, 18676, 1, 0),  # 55, 43
        (1461, 18723, 1, 1),  # 57, 47
        (1521, 18776, 1, 1),  # 60, 53
        (1584, 18823, 0, 0),  # 63, 47
    ]
    assert_array_equal(read_trace_data(text, BUTTONS).values, expected)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 2, 3 4", [(1, 2), (3, 4)]),
        ("1-2,-3+4,.5-1.5e1", [(1, -2), (-3, 4), (0.5, -15)]),
        ("10 10,'1'2,1 2,3 4", [(10, 10), (11, 12), (12, 14), (15, 18)]),
        ("10 10,'1 20,1 30,!5 40,6 50", [(10, 10), (11, 20), (12, 30), (5, 40), (6, 50)]),
        ("0 0,'3'3,\"1\"1,'2'2,2 2", [(0, 0), (3, 3), (7, 7), (9, 9), (11, 11)]),
        ('0 0, 3 1, "1"1', [(0, 0), (3, 1), (7, 3)]),  # the difference before is that of explicit values too
        ("! 1 ! 2, ' 3 ' 4", [(1, 2), (4, 6)]),
        ("1 2,* *,3 *", [(1, 2), (1, 2), (3, 2)]),
        ("1 2,'3'4,* *,**", [(1, 2), (4, 6), (7, 10), (10, 14)]),
        ("0 0,'1'1,\"2\"3,* *,**", [(0, 0), (1, 1), (4, 5), (9, 12), (16, 22)]),
        ("1 2,? 5,3 ?,4 4", [(1, 2), (np.nan, 5), (3, np.nan), (4, 4)]),
        ("#FF #10,'#a -#a", [(255, 16), (265, -10)]),
        ("", []),
        ("   \n ", []),
    ],
)
def test_values_worked_by_hand(text: str, expected: list[tuple[float, float]]) -> None:
    assert_array_equal(read_trace_data(text, XY).values, np.array(expected, dtype=float).reshape(-1, 2))


def test_every_trace_begins_explicit(read: Callable[..., StrokeLibrary]) -> None:
    library = read(
        "<traceGroup><trace>5 5,'1'1,1 1</trace></traceGroup><traceGroup><trace>1 1,3 2</trace></traceGroup>"
    )
    assert_array_equal(library[0].points, [(5, -5), (6, -6), (7, -7)])
    assert_array_equal(library[1].points, [(1, -1), (3, -2)])


def test_a_clock_that_is_left_out_is_unknown_and_other_channels_hold_their_value() -> None:
    assert_array_equal(read_trace_data("1 2 30,2 2,3 3 50", XYT).values[:, 2], [30, np.nan, 50])
    pressure = TraceFormat((Channel("X"), Channel("Y"), Channel("F", default=7.0, intermittent=True)))
    assert_array_equal(read_trace_data("1 2,2 2 5,3 3", pressure).values[:, 2], [7, 5, 5])


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("1 2, 3", "'3'"),
        ("1 2, 3 4 5", "'3 4 5'"),
        ("1 2, nan 4", "'nan 4'"),
        ("1 2, inf 4", "'inf 4'"),
        ("1 2, 1_0 4", "'1_0 4'"),
        ("1 2, 1.2.3", "'1.2.3'"),
        ("1 2, ١ 4", "'١ 4'"),
        ("1 2, T F", "'T F'"),
        ("1 2, x 4", "'x 4'"),
        ("1 2; 3 4", "'1 2; 3 4'"),
        ("1 2, #G 4", "'#G 4'"),
        ("'1 2, 3 4", '"\'1 2"'),
        ("1 2, '' 4", "\"'' 4\""),
    ],
)
def test_what_is_no_point_is_named(text: str, found: str) -> None:
    with pytest.raises(FileFormatError) as caught:
        read_trace_data(text, XY)
    number = 0 if text.startswith(("'", "1 2;")) else 1
    assert str(caught.value) == f"point {number}: expected a value for each of X, Y, found {found}."


@pytest.mark.parametrize("text", ["1 2, 1e101 4", "1 2, 1e400 4", "1 2, '1e308 4, 1e308 5", "1 2, -1e200 ?"])
def test_numbers_beyond_reason_are_named(text: str) -> None:
    with pytest.raises(FileFormatError, match=r"point [12]: expected numbers up to 1e\+100, found -?(inf|1e\+)"):
        read_trace_data(text, XY)


@pytest.mark.parametrize(
    ("text", "commas"),
    [("1 2,3 4,", 1), (",1 2,3 4", 1), ("1 2,,3 4, \n,", 3), ("1 2,3 4", 0), (",", 1), ("", 0)],
)
def test_commas_without_a_point_are_counted(text: str, commas: int) -> None:
    data = read_trace_data(text, XY)
    assert data.stray_commas == commas
    assert_array_equal(data.values, [(1, 2), (3, 4)] if "1" in text else np.empty((0, 2)))


def test_a_comma_too_many_is_repaired_and_told(read: Callable[..., StrokeLibrary]) -> None:
    with pytest.warns(StrokeImportWarning, match="1 of them repaired.*drawing 0: commas without a point behind them"):
        library = read("<trace>0 0, 10 0,, 20 5,\n</trace>")
    assert_array_equal(library[0].points, [(0, 0), (10, 0), (20, -5)])


def test_points_without_a_position_are_left_out_and_told(read: Callable[..., StrokeLibrary]) -> None:
    with pytest.warns(StrokeImportWarning, match="points without a reported position: left out"):
        library = read("<trace>0 0, ? 3, 4 ?, 5 5</trace>")
    assert_array_equal(library[0].points, [(0, 0), (5, -5)])


numbers = st.integers(-5000, 5000)


@given(values=st.lists(st.tuples(numbers, numbers), min_size=1, max_size=30), data=st.data())
@settings(deadline=None, derandomize=True, max_examples=100)
def test_any_mixture_of_encodings_says_the_same(values: list[tuple[int, int]], data: st.DataObject) -> None:
    """Differences are written as the definition has them: v[n] - v[n-1], and what that differs from the one before."""
    columns = np.array(values).T
    words: list[list[str]] = [[] for _ in values]
    for column in columns:
        steps = np.diff(column, prepend=column[:1])
        order = 0
        for n, value in enumerate(column):
            new = data.draw(st.integers(0, 2)) if n else 0
            written = (value, steps[n], steps[n] - steps[n - 1] if n else 0)[new]
            prefix = "!'\""[new] if new != order or data.draw(st.booleans()) else ""
            words[n].append(f"{prefix}{written}")
            order = new
    text = ",".join(" ".join(point) for point in words)
    assert_array_equal(read_trace_data(text, XY).values, values)
