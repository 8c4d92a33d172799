"""Channels: resolution, units and orientation, also where X and Y differ."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from signimit import FileFormatError, StrokeLibrary

Read = Callable[..., StrokeLibrary]
SQUARE = "<trace>0 0, 100 0, 100 200</trace>"


def device(x: str = "", y: str = "", properties: str = "", trace: str = SQUARE) -> str:
    """A document of one device with channels X and Y with these attributes, and these properties."""
    return (
        f'<definitions><inkSource xml:id="i"><traceFormat><channel name="X" {x}/><channel name="Y" {y}/></traceFormat>'
        f"<channelProperties>{properties}</channelProperties></inkSource></definitions>{trace}"
    )


def resolution(channel: str, value: str, units: str) -> str:
    return f'<channelProperty channel="{channel}" name="resolution" value="{value}" units="{units}"/>'


@pytest.mark.parametrize(
    ("x", "y"),
    [
        (("1000", "1/cm"), ("2000", "1/cm")),  # numbers in a unit
        (("0.1", "mm"), ("0.05", "mm")),  # units in a number
        (("100", "1/mm"), ("5080", "1/in")),  # 25.4 mm are an inch
        (("1000", "1/cm"), ("0.5", "himetric")),
        (("500", "1/dev"), ("1000", "1/dev")),
    ],
)
def test_unequal_resolutions_keep_the_shape(read: Read, x: tuple[str, str], y: tuple[str, str]) -> None:
    """200 steps of Y are as long as 100 of X, so half as long each: the drawing is 100 wide and 100 high."""
    library = read(device(properties=resolution("X", *x) + resolution("Y", *y)))
    assert_allclose(library[0].points, [(0, 0), (100, 0), (100, -100)], atol=1e-9)


def test_equal_resolutions_leave_the_numbers_as_they_are(read: Read) -> None:
    library = read(device(properties=resolution("X", "1000", "1/cm") + resolution("Y", "1000", "1/cm")))
    assert_array_equal(library[0].points, [(0, 0), (100, 0), (100, -200)])


@pytest.mark.parametrize("value", ["0", "-3", "nan", "much"])
def test_a_resolution_that_is_none_declares_nothing(read: Read, value: str) -> None:
    library = read(device(properties=resolution("X", value, "1/dev") + resolution("Y", "7", "1/mm")))
    assert_array_equal(library[0].points, [(0, 0), (100, 0), (100, -200)])


def test_unequal_units_keep_the_shape(read: Read) -> None:
    library = read(device('units="cm"', 'units="mm"'))
    assert_allclose(library[0].points, [(0, 0), (100, 0), (100, -20)], atol=1e-12)


def test_units_that_cannot_be_compared_are_named(read: Read) -> None:
    match = r"drawing 0: trace 0: channels X and Y: expected units that can be compared, found m and em"
    with pytest.raises(FileFormatError, match=match):
        read(device('units="cm"', 'units="em"'))


@pytest.mark.parametrize(
    ("x", "y", "last"),
    [("", "", (100, -200)), ("-ve", "", (-100, -200)), ("", "-ve", (100, 200)), ("-ve", "-ve", (-100, 200))],
)
def test_orientation_of_both_channels(read: Read, x: str, y: str, last: tuple[float, float]) -> None:
    """Without, X grows to the right and Y downwards."""
    library = read(device(*(f'orientation="{sign}"' if sign else "" for sign in (x, y))))
    assert_array_equal(library[0].points[-1], last)


def test_drawings_of_two_devices_are_in_one_unit(read: Read) -> None:
    """The first counts in 0.01 mm, the second in 0.1 mm: a step of the second is ten of the first."""
    contexts = "".join(
        f'<context xml:id="{name}"><inkSource xml:id="pad{name}"><traceFormat><channel name="X"/><channel name="Y"/>'
        f"</traceFormat><channelProperties>{resolution('X', value, '1/mm')}{resolution('Y', value, '1/mm')}"
        "</channelProperties></inkSource></context>"
        for name, value in (("a", "100"), ("b", "10"))
    )
    traces = "".join(f'<traceGroup><trace contextRef="#{n}">0 0,3 4</trace></traceGroup>' for n in "ab")
    library = read(f"<definitions>{contexts}</definitions>{traces}")
    assert_array_equal(library[0].points[-1], (3, -4))
    assert_allclose(library[1].points[-1], (30, -40))


def test_channels_are_found_by_name_and_others_passed_over(read: Read) -> None:
    layout = "".join(f'<channel name="{name}"/>' for name in ("F", "Y", "OTx", "X"))
    library = read(f"<traceFormat>{layout}</traceFormat><trace>9 2 8 1, 9 4 8 3</trace>")
    assert_array_equal(library[0].points, [(1, -2), (3, -4)])


def test_intermittent_channels_may_be_left_out(read: Read) -> None:
    layout = (
        '<traceFormat><channel name="X"/><channel name="Y"/><intermittentChannels><channel name="S" type="boolean"/>'
        '<channel name="F"/></intermittentChannels></traceFormat>'
    )
    library = read(f"{layout}<trace>1 2 T 7, 3 4, 5 6 F</trace>")
    assert_array_equal(library[0].points, [(1, -2), (3, -4), (5, -6)])


def test_a_format_without_x_or_y_is_named(read: Read) -> None:
    layout = '<traceFormat><channel name="R"/><channel name="Y"/></traceFormat>'
    with pytest.raises(FileFormatError, match="trace format: expected channels X and Y, found R, Y"):
        read(f"{layout}<trace>1 2, 3 4</trace>")


@pytest.mark.parametrize(
    ("unit", "seconds"),
    [("s", 1), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9), ("", 1e-3)],
)
def test_units_of_time(read: Read, unit: str, seconds: float) -> None:
    units = f'units="{unit}"' if unit else ""
    layout = f'<traceFormat><channel name="X"/><channel name="Y"/><channel name="T" {units}/></traceFormat>'
    library = read(f"{layout}<trace>0 0 0, 1 1 {0.2 / seconds:f}, 2 3 {0.5 / seconds:f}</trace>")
    assert_allclose(library[0].times, [0, 0.2, 0.5])


def test_ticks_have_the_length_that_the_resolution_says(read: Read) -> None:
    """A clock of 50 ticks a second."""
    trace = "<trace>0 0 7, 1 1 17, 2 3 32</trace>"
    body = device('units="dev"', "", resolution("T", "50", "1/s"), trace)
    library = read(body.replace("</traceFormat>", '<channel name="T" units="dev"/></traceFormat>'))
    assert_allclose(library[0].times, [0, 0.2, 0.5])


def test_ticks_of_unknown_length_are_no_clock(read: Read) -> None:
    layout = '<traceFormat><channel name="X"/><channel name="Y"/><channel name="T" units="dev"/></traceFormat>'
    library = read(f"{layout}<trace>0 0 7, 1 1 17, 2 3 32</trace>")
    assert_allclose(library[0].times, [0, 0.01, 0.02])


def test_values_far_from_one_stay_exact(read: Read) -> None:
    library = read(device(trace="<trace>9007199254740991 0, 0 1</trace>"))
    assert_array_equal(library[0].points, np.array([(9007199254740991, 0), (0, -1)], dtype=float))
