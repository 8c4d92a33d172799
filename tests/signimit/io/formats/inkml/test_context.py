"""Contexts: which trace format, canvas and device hold for a trace."""

from collections.abc import Callable

import pytest
from numpy.testing import assert_allclose, assert_array_equal

from signimit import FileFormatError, StrokeLibrary
from signimit.io.formats import StrokeImportWarning

Read = Callable[..., StrokeLibrary]
XY = '<traceFormat><channel name="X"/><channel name="Y"/></traceFormat>'
YX = '<traceFormat><channel name="Y"/><channel name="X"/></traceFormat>'
FXY = '<traceFormat><channel name="F"/><channel name="X"/><channel name="Y"/></traceFormat>'


def two_formats(traces: str) -> str:
    return f'<definitions><context xml:id="a">{XY}</context><context xml:id="b">{YX}</context></definitions>{traces}'


def test_each_trace_has_the_format_of_its_context(read: Read) -> None:
    library = read(two_formats('<trace contextRef="#a">0 0, 9 1</trace><trace contextRef="#b">1 20, 0 29</trace>'))
    assert_array_equal(library[0].points[[0, 1, -2, -1]], [(0, 0), (9, -1), (20, -1), (29, 0)])


def test_a_reference_to_a_bare_format_is_understood(read: Read) -> None:
    formats = XY.replace("<traceFormat", '<traceFormat xml:id="a"') + YX.replace(
        "<traceFormat", '<traceFormat xml:ID="b"'
    )
    body = f'<definitions>{formats}</definitions><trace contextRef="#b">1 2, 3 4</trace>'
    assert_array_equal(read(body)[0].points, [(2, -1), (4, -3)])


def test_a_group_s_context_holds_for_its_traces(read: Read) -> None:
    body = '<traceGroup contextRef="#b"><trace>1 20, 0 29</trace><trace contextRef="#a">30 0, 39 0</trace></traceGroup>'
    assert_array_equal(read(two_formats(body))[0].points[[0, 1, -2, -1]], [(20, -1), (29, 0), (30, 0), (39, 0)])


def test_the_only_format_of_a_document_holds_wherever_it_stands(read: Read) -> None:
    for layout in (
        f"<definitions>{FXY}</definitions>",
        f'<definitions><inkSource xml:id="i">{FXY}</inkSource></definitions>',
        f'<definitions><context xml:id="c"><inkSource xml:id="i">{FXY}</inkSource></context></definitions>',
        f'<context xml:id="c">{FXY}</context>',
        FXY,
    ):
        assert_array_equal(read(f"{layout}<trace>7 1 2, 8 3 4</trace>")[0].points, [(1, -2), (3, -4)])


def test_without_a_context_the_standard_s_format_holds_where_there_are_several(read: Read) -> None:
    assert_array_equal(read(two_formats("<trace>1 2, 3 4</trace>"))[0].points, [(1, -2), (3, -4)])
    body = two_formats('<traceGroup contextRef="#DefaultContext"><trace>1 2, 3 4</trace></traceGroup>')
    assert_array_equal(read(body)[0].points, [(1, -2), (3, -4)])


def test_contexts_between_traces_hold_for_those_behind_them(read: Read) -> None:
    groups = "<traceGroup><trace>1 2, 3 4</trace></traceGroup>"
    library = read(f'{groups}<context xml:id="b">{YX}</context>{groups}<context>{XY}</context>{groups}')
    assert [stroke.points.tolist() for stroke in library] == [
        [[1, -2], [3, -4]],
        [[2, -1], [4, -3]],
        [[1, -2], [3, -4]],
    ]


def test_formats_between_traces_hold_for_those_behind_them(read: Read) -> None:
    timed = XY.replace("</traceFormat>", '<channel name="T" units="{}"/></traceFormat>')
    body = f"{timed.format('ms')}<traceGroup><trace>0 0 0, 1 1 500</trace></traceGroup>"
    library = read(f"{body}{timed.format('s')}<traceGroup><trace>0 0 0, 1 1 2</trace></traceGroup>")
    assert [stroke.times[-1] for stroke in library] == [0.5, 2]


def test_a_context_builds_on_another(read: Read) -> None:
    definitions = (
        f'<definitions><context xml:id="a" contextRef="#b" brushRef="#no"/><traceFormat xml:id="f">{YX[13:]}'
        '<inkSource xml:id="i" traceFormatRef="#f"><sampleRate value="50"/></inkSource>'
        '<context xml:id="b" inkSourceRef="#i"/></definitions>'
    )
    library = read(f'{definitions}<trace contextRef="#a">1 2, 3 4</trace>')
    assert_array_equal(library[0].points, [(2, -1), (4, -3)])
    assert_allclose(library[0].times, [0, 0.02])


def test_the_own_format_of_a_context_wins_over_its_device_s(read: Read) -> None:
    context = f'<context xml:id="c"><inkSource xml:id="i">{XY}</inkSource>{YX}</context>'
    assert_array_equal(read(f"{context}<trace>1 2, 3 4</trace>")[0].points, [(2, -1), (4, -3)])


def test_a_context_without_a_format_has_the_only_one(read: Read) -> None:
    body = f'<definitions>{FXY}<context xml:id="c"><timestamp xml:id="t" time="0"/></context></definitions>'
    assert_array_equal(read(f'{body}<trace contextRef="#c">7 1 2, 8 3 4</trace>')[0].points, [(1, -2), (3, -4)])


def test_the_format_of_a_canvas_is_none_of_traces(read: Read) -> None:
    canvas = f'<definitions><canvas xml:id="c">{YX}</canvas></definitions>'
    assert_array_equal(read(f"{canvas}<trace>1 2, 3 4</trace>")[0].points, [(1, -2), (3, -4)])


def test_contexts_of_other_namespaces_are_none_of_traces(read: Read) -> None:
    foreign = (
        '<annotationXML><m:context xmlns:m="urn:other" type="paragraph"><m:traceFormat/></m:context></annotationXML>'
    )
    assert_array_equal(read(f"{foreign}{YX}<trace>1 2, 3 4</trace>")[0].points, [(2, -1), (4, -3)])


@pytest.mark.parametrize(
    ("context", "match"),
    [
        (
            "",
            r"drawing 1: trace 0: contextRef: expected a context or inkSource or traceFormat of this file, found '#c'",
        ),
        ('<context xml:id="c" contextRef="#c"/>', r"contextRef: expected a context that does not refer to itself"),
        ('<context xml:id="c" inkSourceRef="#no"/>', r"inkSourceRef: expected a inkSource of this file, found '#no'"),
        (f'<context xml:id="c">{XY}</context>' * 2, r"contextRef: expected one context with the id 'c', found 2"),
    ],
)
def test_a_context_that_cannot_be_found_costs_its_drawings_only(read: Read, context: str, match: str) -> None:
    good, bad = (f"<traceGroup{ref}><trace>1 2, 3 4</trace></traceGroup>" for ref in ("", ' contextRef="#c"'))
    body = f"{XY}<definitions>{context}</definitions>{good}{bad}{good}"
    with pytest.warns(StrokeImportWarning, match=match):
        assert len(read(body, strict=False)) == 2
    with pytest.raises(FileFormatError, match=match):
        read(body)


def test_a_broken_context_between_traces_costs_those_behind_it(read: Read) -> None:
    group = "<traceGroup><trace>1 2, 3 4</trace></traceGroup>"
    with pytest.warns(StrokeImportWarning, match=r"1 left out.*drawing 1: trace 0: traceFormatRef: expected a"):
        assert len(read(f'{group}<context traceFormatRef="#no"/>{group}', strict=False)) == 1
