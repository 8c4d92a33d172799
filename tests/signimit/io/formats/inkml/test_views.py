"""Views: what they refer to, and from where to where."""

from collections.abc import Callable

import pytest

from signimit import FileFormatError, StrokeLibrary
from signimit.io.formats import StrokeImportWarning

Read = Callable[..., StrokeLibrary]
SIX = '<trace xml:id="t">0 0, 1 0, 2 0, 3 0, 4 0, 5 0</trace>'
TREE = (  # numbers of the points are 1xx in the first trace, 2xx in the second group's, and so on
    '<definitions><traceGroup xml:id="g"><trace>101 0, 102 0, 103 0</trace>'
    "<traceGroup><trace>211 0, 212 0</trace><trace>221 0, 222 0, 223 0</trace></traceGroup>"
    "<trace>301 0, 302 0, 303 0</trace></traceGroup></definitions>"
)


def visited(library: StrokeLibrary, drawing: int = 0) -> list[int]:
    """The whole numbers among the x, so not what bridges gaps between traces."""
    return [int(x) for x, y in library[drawing].points if x.is_integer() and y == 0]


def view(ends: str, reference: str = "g") -> str:
    return f'<traceView traceDataRef="#{reference}" {ends}/>'


@pytest.mark.parametrize(
    ("ends", "expected"),
    [
        ("", [0, 1, 2, 3, 4, 5]),
        ('from="2"', [1, 2, 3, 4, 5]),
        ('to="2"', [0, 1]),
        ('from="2" to="4"', [1, 2, 3]),
        ('from="1" to="6"', [0, 1, 2, 3, 4, 5]),
        ('from=" 5 " to="6"', [4, 5]),
    ],
)
def test_points_are_counted_from_one_to_the_last_included(read: Read, ends: str, expected: list[int]) -> None:
    assert visited(read(SIX + view(ends, "t"))) == expected


@pytest.mark.parametrize(
    ("ends", "first", "last", "traces"),
    [
        ("", 101, 303, 4),
        ('from="2"', 211, 303, 3),
        ('from="2" to="2"', 211, 223, 2),
        ('to="1"', 101, 103, 1),
        ('from="1:2" to="3:2"', 102, 302, 4),
        ('from="2:2" to="3"', 221, 303, 2),
        ('from="2:1:2" to="2:2:1"', 212, 221, 2),
        ('from="2:2:2" to="2:2:3"', 222, 223, 1),
        ('from="1:3" to="2:1"', 103, 212, 2),
        ('from="2 : 1 : 2"', 212, 303, 3),
    ],
)
def test_each_number_of_an_index_is_one_level(read: Read, ends: str, first: int, last: int, traces: int) -> None:
    points = read(TREE + view(ends))[0].points[:, 0]
    assert (points[0], points[-1]) == (first, last)
    starts = {101: 1, 211: 2, 221: 3, 301: 4}
    assert len({max(n for n in starts if n <= x) for x in (first, last)}) == min(traces, 2)
    inner = {n for n in starts if first <= n <= last} | {max(n for n in starts if n <= first)}
    assert len(inner) == traces


def test_a_view_of_a_view_counts_in_that_view(read: Read) -> None:
    inner = '<definitions><traceView xml:id="v" traceDataRef="#t" from="3" to="6"/></definitions>'
    assert visited(read(SIX + inner + view('from="2" to="3"', "v"))) == [3, 4]


def test_a_view_of_views_counts_what_they_hold(read: Read) -> None:
    """The second child of the view is the nested group, the second of that the trace with 221 to 223."""
    inner = '<definitions><traceView xml:id="v" traceDataRef="#g" from="1:3" to="2"/></definitions>'
    assert visited(read(TREE + inner + view('from="2:2:2" to="2:2:3"', "v"))) == [222, 223]


def test_one_trace_may_be_cut_into_several_drawings(read: Read) -> None:
    letters = "".join(
        f'<traceView><annotation type="label">{letter}</annotation>{view(ends, "t")}</traceView>'
        for letter, ends in (("a", 'to="3"'), ("b", 'from="4"'))
    )
    library = read(SIX + letters)
    assert library.labels == ("a", "b")
    assert [visited(library, i) for i in (0, 1)] == [[0, 1, 2], [3, 4, 5]]


def test_an_id_means_a_trace_before_a_group(read: Read) -> None:
    """As in the CROHME data, where traces and groups are numbered each for themselves."""
    body = (
        '<trace id="1">0 0, 1 0</trace><trace id="2">5 0, 6 0</trace><traceGroup xml:id="1">'
        '<traceGroup xml:id="2"><annotation type="truth">x</annotation><traceView traceDataRef="2"/></traceGroup>'
        '<traceGroup xml:id="3"><annotation type="truth">y</annotation><traceView traceDataRef="1"/></traceGroup>'
        "</traceGroup>"
    )
    library = read(body)
    assert library.labels == ("x", "y")
    assert [visited(library, i) for i in (0, 1)] == [[5, 6], [0, 1]]


@pytest.mark.parametrize(
    ("body", "match"),
    [
        (view("", "no"), "traceView: expected a trace or traceGroup or traceView of this file, found '#no'"),
        ('<traceView traceDataRef="other.inkml#t"/>', "of this file, found 'other.inkml#t'"),
        ('<traceView traceDataRef=""/>', "of this file, found ''"),
        (
            f'<trace id="d">0 0,1 1</trace><trace id="d">0 0,2 2</trace>{view("", "d")}',
            "one trace with the id 'd', found 2",
        ),
        (view('from="0"', "t"), "from and to of what it holds, found 0 to the end"),
        (view('from="3" to="2"', "t"), "from and to of what it holds, found 3 to 2"),
        (view('from="-2"', "t"), "from and to of what it holds, found -2 to the end"),
        (view('from="2" to="7"', "t"), "from and to between 1 and 6, found 2 to 7"),
        (view('from="8"', "t"), "from and to between 1 and 6, found 8 to 6"),
        (view('from="1:1"', "t"), "one number for a point of a trace, found 1:1 to the end"),
        (view('from="4"'), "from and to between 1 and 3, found 4 to the end"),
        (view('from="1:9"'), "from and to between 1 and 3, found 9 to 3"),
        (
            '<definitions><traceGroup id="e"/></definitions>' + view('from="1"', "e"),
            "between 1 and 0, found 1 to the end",
        ),
        (view('from="two"', "t"), "from as numbers with colons between, found 'two'"),
        (view('to="1::2"'), "to as numbers with colons between"),
        (view(f'to="{"9" * 5000}"', "t"), "to as numbers with colons between"),
        (view(f'to="{":".join("1" * 200)}"'), "to as numbers with colons between"),
        ('<traceView xml:id="v" traceDataRef="#v"/>', "views that do not refer to themselves"),
        (
            '<traceView xml:id="v"><traceView xml:id="w" traceDataRef="#v"/></traceView>',
            "views that do not refer to themselves",
        ),
        (
            f'<traceView traceDataRef="#t">{view("", "t")}</traceView>',
            "either a traceDataRef or views inside, found both",
        ),
    ],
)
def test_a_view_that_cannot_be_followed_costs_its_drawing_only(read: Read, body: str, match: str) -> None:
    tree = TREE.replace("</definitions>", "<trace xml:id='t'>0 0, 1 0, 2 0, 3 0, 4 0, 5 0</trace></definitions>")
    good = '<traceGroup><annotation type="label">good</annotation><trace>0 0, 1 0</trace></traceGroup>'
    with pytest.raises(FileFormatError, match=match) as caught:
        read(tree + good + body)
    assert "drawing " in str(caught.value)
    with pytest.warns(StrokeImportWarning, match="1 left out"):
        assert "good" in read(tree + good + body, strict=False).labels


def test_a_small_file_cannot_refer_to_its_ink_a_million_times(read: Read) -> None:
    doubling = "".join(
        f'<traceView xml:id="v{i + 1}">{view("", f"v{i}") * 2}</traceView>'.replace("#v0", "#t") for i in range(60)
    )
    body = f"<trace>0 5, 1 5</trace><definitions>{SIX}{doubling}</definitions>"
    with pytest.raises(FileFormatError, match="views of at most 10 times the ink, found more"):
        read(body + view("", "v60"))
    with pytest.warns(StrokeImportWarning, match="1 left out"):
        assert len(read(body + view("", "v60"), strict=False)) == 1


def test_long_chains_and_deep_trees_end(read: Read) -> None:
    chain = "".join(f'<traceView xml:id="v{i + 1}" traceDataRef="#v{i}"/>' for i in range(5_000))
    first = SIX.replace("#t", "#v0").replace('id="t"', 'id="v0"')
    library = read(f"<definitions>{first}{chain}</definitions>{view('', 'v5000')}")
    assert visited(library) == [*range(6)]
    deep = "<traceView>" * 5_000 + view("", "t") + "</traceView>" * 5_000
    assert visited(read(f"{SIX}{deep}")) == [*range(6)]
    with pytest.raises(FileFormatError, match="found '#v0'"):
        read(chain)
