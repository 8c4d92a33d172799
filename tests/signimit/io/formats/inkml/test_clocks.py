"""When points were drawn: T, respectTo, time stamps, timeOffset, duration, sampleRate."""

from collections.abc import Callable

import pytest
from numpy.testing import assert_allclose

from signimit import FileFormatError, StrokeLibrary
from signimit.io.formats import StrokeImportWarning

Read = Callable[..., StrokeLibrary]


def timed(attributes: str = 'units="ms"') -> str:
    return f'<traceFormat><channel name="X"/><channel name="Y"/><channel name="T" {attributes}/></traceFormat>'


FIRST, SECOND = "0 0 {}, 1 0 {}, 2 0 {}", "3 0 {}, 4 0 {}, 5 0 {}"


def two(a: tuple[int, int, int], b: tuple[int, int, int], first: str = "", second: str = "") -> str:
    return f"<trace {first}>{FIRST.format(*a)}</trace><trace {second}>{SECOND.format(*b)}</trace>"


def test_one_clock_for_all_traces(read: Read) -> None:
    library = read(timed() + two((1000, 1020, 1040), (1500, 1520, 1540)))
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_clocks_that_begin_with_each_trace_are_put_end_to_end(read: Read) -> None:
    """The standard: without respectTo, T counts from the beginning of its trace."""
    library = read(timed() + two((0, 20, 40), (0, 20, 40)))
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.06, 0.08, 0.1])


def test_clocks_that_begin_anew_are_put_end_to_end_whatever_they_count_from(read: Read) -> None:
    with pytest.warns(
        StrokeImportWarning, match="pieces whose clock begins anew or overlaps: put behind the one before"
    ):
        library = read(timed('units="ms" respectTo="#gone"') + two((0, 20, 40), (0, 20, 40)))
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.06, 0.08, 0.1])


def test_an_offset_says_when_a_trace_began(read: Read) -> None:
    body = two((0, 20, 40), (0, 20, 40), 'timeOffset="100"', 'timeOffset="600"')
    assert_allclose(read(timed() + body)[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])
    in_seconds = body.replace(" 20", " 0.02").replace(" 40", " 0.04")
    assert_allclose(read(timed('units="s"') + in_seconds)[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_an_offset_says_when_a_trace_began_whose_clock_begins_anew_whatever_it_counts_from(read: Read) -> None:
    stamp = '<definitions><timestamp xml:id="ts" time="5"/></definitions>'
    body = two((0, 20, 40), (0, 20, 40), 'timeOffset="0"', 'timeOffset="500"')
    library = read(stamp + timed('units="ms" respectTo="#ts"') + body)
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_an_offset_is_not_added_to_a_clock_that_has_it_already(read: Read) -> None:
    body = two((100, 120, 140), (600, 620, 640), 'timeOffset="100"', 'timeOffset="600"')
    assert_allclose(read(timed() + body)[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_a_clock_with_a_named_beginning_needs_no_offset(read: Read) -> None:
    stamp = '<definitions><timestamp xml:id="ts" time="5"/></definitions>'
    body = two((0, 20, 40), (500, 520, 540), "", 'timeOffset="90"')
    library = read(stamp + timed('units="ms" respectTo="#ts"') + body)
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ('time="1300000000000"', 'time="1300000000500"'),
        ('timeString="2011-03-13T07:06:40Z"', 'timeString="2011-03-13T07:06:40.500Z"'),
        ('timeString="2011-03-13T07:06:40"', 'timeString="2011-03-13T08:06:40.5+01:00"'),
        ('time="1300000000000"', 'timestampRef="#a" timeOffset="500"'),
        ('timestampRef="#b" timeOffset="-500"', 'time="0"'),
    ],
)
def test_traces_that_count_from_different_time_stamps(read: Read, first: str, second: str) -> None:
    contexts = "".join(
        f'<context xml:id="c{name}"><timestamp xml:id="{name}" {time}/>'
        + timed(f'units="ms" respectTo="#{name}"')
        + "</context>"
        for name, time in (("a", first), ("b", second))
    )
    body = two((0, 20, 40), (0, 20, 40), 'contextRef="#ca"', 'contextRef="#cb"')
    library = read(f"<definitions>{contexts}</definitions>{body}")
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54], atol=1e-6)


def test_traces_whose_contexts_have_different_time_stamps(read: Read) -> None:
    contexts = "".join(
        f'<context xml:id="c{time}"><timestamp xml:id="t{time}" time="{time}"/>{timed()}</context>' for time in (7, 507)
    )
    body = two((0, 20, 40), (0, 20, 40), 'contextRef="#c7"', 'contextRef="#c507"')
    library = read(f"<definitions>{contexts}</definitions>{body}")
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54], atol=1e-9)


@pytest.mark.parametrize(
    "stamp", ["", 'timeString="yesterday"', 'timestampRef="#ts"', 'timestampRef="#no"', 'time="x"']
)
def test_a_time_stamp_that_says_nothing_does_no_harm(read: Read, stamp: str) -> None:
    body = f'<definitions><timestamp xml:id="ts" {stamp}/></definitions>' + timed('respectTo="#ts"')
    assert_allclose(read(body + two((5, 25, 45), (505, 525, 545)))[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_traces_of_different_units_of_time(read: Read) -> None:
    contexts = "".join(
        f'<context xml:id="{unit}">' + timed(f'units="{unit}" respectTo="#x"') + "</context>" for unit in ("s", "ms")
    )
    library = read(
        f"<definitions>{contexts}</definitions><trace contextRef='#ms'>0 0 1000, 1 0 1020, 2 0 1040</trace>"
        "<trace contextRef='#s'>3 0 1.5, 4 0 1.52, 5 0 1.54</trace>"
    )
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_an_intermittent_clock_is_filled_in_between(read: Read) -> None:
    layout = (
        '<traceFormat><channel name="X"/><channel name="Y"/><intermittentChannels><channel name="T" units="ms"/>'
        "</intermittentChannels></traceFormat>"
    )
    library = read(f"{layout}<trace>0 0, 1 0 100, 2 0, 3 0 140, 4 0, 5 0</trace>")
    assert_allclose(library[0].times, [0, 0.02, 0.04, 0.06, 0.08, 0.1])
    library = read(f"{layout}<trace>0 0, 1 0 100, 2 0</trace>")  # one stamp: 10 ms apart
    assert_allclose(library[0].times, [0, 0.01, 0.02])


def test_a_clock_may_be_written_in_differences(read: Read) -> None:
    library = read(f"{timed()}<trace>0 0 500, 1 0'20, 2 0 30</trace>")
    assert_allclose(library[0].times, [0, 0.02, 0.05])


def test_offset_and_duration_make_a_clock(read: Read) -> None:
    body = (
        '<trace timeOffset="100" duration="40">0 0, 1 0, 2 0</trace>'
        '<trace timeOffset="600" duration="40">3 0, 4 0, 5 0</trace>'
    )
    assert_allclose(read(body)[0].times, [0, 0.02, 0.04, 0.5, 0.52, 0.54])


def test_durations_alone_are_put_end_to_end(read: Read) -> None:
    body = '<trace duration="40">0 0, 1 0, 2 0</trace><trace duration="40">3 0, 4 0, 5 0</trace>'
    assert_allclose(read(body)[0].times, [0, 0.02, 0.04, 0.06, 0.08, 0.1])


def test_offsets_alone_say_when_traces_begin(read: Read) -> None:
    """Word and OneNote write no other time; the first trace's offset is left out."""
    body = '<trace>0 0, 1 0, 2 0</trace><trace timeOffset="500.5">3 0, 4 0, 5 0</trace>'
    assert_allclose(read(body)[0].times, [0, 0.01, 0.02, 0.5005, 0.5105, 0.5205])


def test_offsets_that_leave_no_time_to_draw_are_passed_over(read: Read) -> None:
    body = '<trace>0 0, 1 0, 2 0</trace><trace timeOffset="15">3 0, 4 0, 5 0</trace>'
    assert_allclose(read(body)[0].times, [0, 0.01, 0.02, 0.03, 0.04, 0.05])


def test_a_part_of_a_trace_keeps_its_time(read: Read) -> None:
    body = (
        '<definitions><trace xml:id="t" duration="80">0 0, 1 0, 2 0, 3 0, 4 0</trace>'
        '<trace xml:id="u" timeOffset="100" duration="0">5 0, 6 0</trace></definitions>'
        '<traceView><traceView traceDataRef="#t" from="2" to="3"/><traceView traceDataRef="#u"/></traceView>'
    )
    assert_allclose(read(body)[0].times[[0, 1, -2, -1]], [0, 0.02, 0.08, 0.09])


@pytest.mark.parametrize(
    ("rate", "step"), [("50", 0.02), ("133.3333333", 0.0075), ("0", 0.01), ("-5", 0.01), ("x", 0.01)]
)
def test_the_sample_rate_is_the_pace_without_a_clock(read: Read, rate: str, step: float) -> None:
    source = f'<inkSource xml:id="i"><traceFormat/><sampleRate uniform="true" value="{rate}"/></inkSource>'
    library = read(f"<definitions>{source}</definitions><trace>0 0, 1 0, 2 0</trace>")
    assert_allclose(library[0].times, [0, step, 2 * step], rtol=1e-6)


def test_a_unit_that_is_none_of_time_is_named(read: Read) -> None:
    match = "channel T: expected a unit of s, ms, us, µs, ns, sec, msec, found 'h'"
    with pytest.raises(FileFormatError, match=match):
        read(timed('units="h"') + two((1, 2, 3), (4, 5, 6)))
