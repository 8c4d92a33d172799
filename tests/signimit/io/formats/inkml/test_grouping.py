"""Which traces are a drawing, what it is called and who drew it."""

from collections.abc import Callable

import pytest
from numpy.testing import assert_array_equal

from signimit import FileFormatError, StrokeLibrary
from signimit.io.formats import StrokeImportWarning

Read = Callable[..., StrokeLibrary]
STORED = "".join(f'<trace xml:id="t{i}">{i}0.25 0, {i}1 0</trace>' for i in range(4))


def label(text: str, kind: str = "label") -> str:
    return f'<annotation type="{kind}">{text}</annotation>'


def group(*inside: str) -> str:
    return f"<traceGroup>{''.join(inside)}</traceGroup>"


def views(*inside: str) -> str:
    return f"<traceView>{''.join(inside)}</traceView>"


def view(i: int, inside: str = "") -> str:
    return f'<traceView traceDataRef="#t{i}">{inside}</traceView>'


def trace(i: int) -> str:
    return f"<trace>{i}0.25 0, {i}1 0</trace>"


def drawings(library: StrokeLibrary) -> list[tuple[str, list[int]]]:
    """Label and traces of each drawing, the traces by the numbers that they begin with."""
    return [
        (name, [int(x) // 10 for x in stroke.points[:, 0] if x % 10 == 0.25])
        for name, stroke in zip(library.labels, library, strict=True)
    ]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        # traces outside groups stay, as one drawing, where the first of them stands
        (trace(1) + trace(2) + group(label("a"), trace(5)), [("house", [1, 2]), ("a", [5])]),
        (group(label("a"), trace(5)) + trace(1), [("a", [5]), ("house", [1])]),
        (trace(1) + group(label("a"), trace(5)) + trace(2) + label("all"), [("all", [1, 2]), ("a", [5])]),
        (STORED + views(label("a"), view(1)), [("house", [0, 2, 3]), ("a", [1])]),
        # groups in groups
        (group(label("a"), trace(1), group(label("b"), trace(2)), trace(3)), [("a", [1, 3]), ("b", [2])]),
        (group(label("a"), group(trace(1)), group(trace(2))), [("a", [1]), ("a", [2])]),
        # labels of views at any level
        (STORED + views(views(label("one"), view(0), view(1)), views(label("two"), view(2), view(3))),
         [("one", [0, 1]), ("two", [2, 3])]),
        (STORED + views(label("line"), views(views(label("x"), view(0)), views(view(1))), view(2), view(3)),
         [("x", [0]), ("line", [1]), ("line", [2, 3])]),
        (STORED + views(view(0, label("x")), view(1, label("y")), view(2), view(3)),
         [("x", [0]), ("y", [1]), ("house", [2, 3])]),
        (STORED + view(0, label("x")) + view(1) + view(2) + view(3),
         [("x", [0]), ("house", [1]), ("house", [2]), ("house", [3])]),
        (STORED + label("root") + views(views(view(0), view(1)), views(view(2), view(3))),
         [("root", [0, 1]), ("root", [2, 3])]),
        # groups and views mixed
        (STORED + group(label("a"), view(2), trace(7), view(0)), [("house", [1, 3]), ("a", [2, 7, 0])]),
        # a view without a label has that of what it refers to
        (
            "<definitions><traceGroup xml:id='g'>" + label("a") + trace(5) + trace(6) + "</traceGroup></definitions>"
            "<traceView><traceView traceDataRef='#g'/></traceView>",
            [("a", [5, 6])],
        ),
        (
            "<traceGroup xml:id='g'>" + label("a") + trace(5) + "</traceGroup>"
            "<traceGroup xml:id='h'>" + label("b") + trace(6) + "</traceGroup>"
            "<traceView><traceView traceDataRef='#h'/><traceView traceDataRef='#g'/></traceView>",
            [("b", [6]), ("a", [5])],
        ),
        # but its own first, and then what has another label where it is stored is there whole
        (
            "<traceGroup xml:id='g'>" + label("word") + STORED + "</traceGroup>"
            + views(label("x"), view(0), view(1)) + views(label("y"), view(2), view(3)),
            [("word", [0, 1, 2, 3]), ("x", [0, 1]), ("y", [2, 3])],
        ),
    ],
)  # fmt: skip
def test_groups_and_labels(read: Read, body: str, expected: list[tuple[str, list[int]]]) -> None:
    assert drawings(read(body)) == expected


@pytest.mark.parametrize("kind", ["label", "truth", "transcription", "Truth", "LABEL"])
def test_kinds_of_labels(read: Read, kind: str) -> None:
    body = label("no", "type") + group(label("Word", "type"), label(" ", kind), label(" a ", kind), trace(1))
    assert read(body).labels == ("a",)


def test_a_recogniser_s_best_guess_is_a_label_where_nobody_gave_one(read: Read) -> None:
    emma = (
        '<annotationXML><e:emma xmlns:e="urn:emma"><e:one-of><e:interpretation><e:literal> This </e:literal>'
        "</e:interpretation><e:interpretation><e:literal>Thins</e:literal></e:interpretation></e:one-of></e:emma>"
        "</annotationXML>"
    )
    assert read(group(emma, trace(1)) + group(emma, label("that"), trace(2))).labels == ("This", "that")


def test_the_nearest_writer_counts(read: Read) -> None:
    body = (
        label("ann", "writer")
        + group(trace(1))
        + group(label("bob", "writer"), group(trace(2)), group(label("cy", "writer"), trace(3)))
        + '<definitions><traceGroup xml:id="g">' + label("dan", "writer") + trace(4) + "</traceGroup></definitions>"
        + '<traceView traceDataRef="#g"/>'
    )  # fmt: skip
    assert read(body).writers == ("ann", "bob", "cy", "dan")


def test_traces_of_definitions_are_drawn_only_if_they_are_viewed(read: Read) -> None:
    assert drawings(read(f"<definitions>{STORED}</definitions>" + views(view(2)))) == [("house", [2])]
    with pytest.raises(FileFormatError, match="expected traces, or views of them, outside definitions, found none"):
        read(f"<definitions>{STORED}</definitions>")


def test_traces_within_what_the_standard_does_not_know_are_read(read: Read) -> None:
    """And those within a remark are not, though a view may refer to them."""
    remark = f"<annotationXML>{STORED}</annotationXML>"
    assert drawings(read(f"<page>{trace(5)}</page>{remark}")) == [("house", [5])]
    assert drawings(read(remark + view(1))) == [("house", [1])]


def test_a_group_refers_to_nothing(read: Read) -> None:
    assert drawings(read(STORED + '<traceGroup traceDataRef="#t0"/>' + group(trace(5)))) == [
        ("house", [0, 1, 2, 3]),
        ("house", [5]),
    ]


def test_equal_ids_of_traces_that_nothing_refers_to_do_no_harm(read: Read) -> None:
    assert drawings(read('<trace id="1">0.25 0, 1 0</trace><trace id="1">10.25 0, 11 0</trace>')) == [("house", [0, 1])]


def test_pen_up_traces_are_left_out_and_indeterminate_ones_cut_by_the_tip_switch(read: Read) -> None:
    layout = (
        '<traceFormat><channel name="X"/><channel name="Y"/><channel name="S" type="boolean"/>'
        '<channel name="T" units="s"/></traceFormat>'
    )
    signature = "0 0 F 0, 1 0 T 1, 2 0 T 2, 3 0 F 3, 4 0 F 4, 5 0 T 5, 6 0 T 6"
    up = '<trace type="penUp">90 0 T 7, 91 0 T 8</trace>'
    library = read(f'{layout}<trace type="indeterminate">{signature}</trace>{up}')
    assert_array_equal(library[0].points[:, 0], [1, 2, 3, 4, 5, 6])
    assert_array_equal(library[0].times, [0, 1, 2, 3, 4, 5])
    with_pen_down = read(f"{layout}<trace>{signature}</trace>")
    assert_array_equal(with_pen_down[0].points[:, 0], [0, 1, 2, 3, 4, 5, 6])


def test_an_unknown_kind_of_trace_is_named(read: Read) -> None:
    with pytest.raises(FileFormatError, match="type: expected one of penDown, penUp, indeterminate, found 'hover'"):
        read('<trace type="hover">0 0, 1 0</trace>')


def test_traces_that_continue_others_follow_them(read: Read) -> None:
    """Two pens at a time: the stream alternates between them."""
    body = (
        '<trace xml:id="a" continuation="begin">0 0, 10 0</trace><trace xml:id="b">0 9, 1 9</trace>'
        '<trace xml:id="c" continuation="middle" priorRef="#a">20 0, 30 0</trace>'
        '<trace continuation="end" priorRef="#c">40 0, 50 0</trace>'
    )
    points = read(body)[0].points
    assert_array_equal(points[:6], [(0, 0), (10, 0), (20, 0), (30, 0), (40, 0), (50, 0)])
    assert_array_equal(points[-1], (1, -9))


def test_a_trace_that_continues_nothing_is_left_where_it_stands_and_told(read: Read) -> None:
    with pytest.warns(StrokeImportWarning, match="traces that continue none of the file: left where they stand"):
        library = read('<trace>0 0, 1 0</trace><trace continuation="end" priorRef="#no">2 0, 3 0</trace>')
    assert_array_equal(library[0].points[:, 0], [0, 1, 2, 3])
