"""Segments of UNIPEN text: what statements say, which level is read, and which components are meant."""

import pytest

from signimit import FileFormatError, UnknownNameError
from signimit.io.formats.unipen.pen_data import Component, PenReader
from signimit.io.formats.unipen.segments import (
    Numbering,
    Segment,
    Slice,
    Span,
    choose_level,
    choose_numbering,
    find_slices,
    read_segment,
    segments_of_level,
)
from signimit.io.formats.unipen.statements import Statement, StatementReader


def segment(text: str, after: int = 0) -> Segment:
    return read_segment(Statement("SEGMENT", text, "a.dat", 1), after)


def components(sizes: list[int]) -> list[Component]:
    pen = PenReader()
    for statement in StatementReader("a.dat").read("".join(".PEN_DOWN\n" + "1 2\n" * size for size in sizes)):
        pen.read(statement)
    return pen.components


def whole(*numbers: int) -> tuple[Span, ...]:
    return tuple(Span(number, 0, number, None) for number in numbers)


@pytest.mark.parametrize(
    ("text", "level", "spans", "label"),
    [
        (' CHARACTER 0 OK "a"', "CHARACTER", whole(0), "a"),
        (' DIGIT  112-113 ? "7"\n\n', "DIGIT", (Span(112, 0, 113, None),), "7"),
        (' WORD 3-5,8 GOOD "be"', "WORD", (Span(3, 0, 5, None), Span(8, 0, 8, None)), "be"),
        (' WORD 3 - 5 , 8 bad "be"', "WORD", (Span(3, 0, 5, None), Span(8, 0, 8, None)), "be"),
        (' CHAR 2:10-4:20 ? "x"', "CHAR", (Span(2, 10, 4, 20),), "x"),
        (' CHAR 2:10-4,6-7:3 ? "x"', "CHAR", (Span(2, 10, 4, None), Span(6, 0, 7, 3)), "x"),
        (' CHAR 2:10 ? "x"', "CHAR", (Span(2, 10, 2, 10),), "x"),
        (" CHARACTER", "CHARACTER", None, ""),
        ("\tCHARACTER\t?\n", "CHARACTER", None, ""),
        (' LINE ? ? "0x7b49"', "LINE", None, "0x7b49"),
        (' CHARACTER OK "a"', "CHARACTER", None, "a"),
        (' CHARACTER "a"', "CHARACTER", None, "a"),
        (' CHARACTER 0 "a"', "CHARACTER", whole(0), "a"),
        (' CHARACTER 0"a"', "CHARACTER", whole(0), "a"),
        (" CHARACTER 0 OK a", "CHARACTER", whole(0), "a"),
        (" CHARACTER 0", "CHARACTER", whole(0), ""),
        (' CHARACTER 0 ? ""', "CHARACTER", whole(0), ""),
    ],
)
def test_a_statement_has_a_level_components_a_quality_and_a_label(
    text: str, level: str, spans: tuple[Span, ...] | None, label: str
) -> None:
    assert segment(text, 4) == Segment(level, spans, label, "a.dat: line 1", 4)


@pytest.mark.parametrize(
    ("quoted", "label"),
    [
        ('"two words"', "two words"),
        ('" "', " "),
        (r'"\""', '"'),
        (r'"\\"', "\\"),
        (r'"say \"no\" \\ or\tso\n"', 'say "no" \\ or so '),
        ('"two\nlines"', "two lines"),
        ('"""', '"'),
        ('"\\"', "\\"),
        ('"a"b"', 'a"b'),
        ('"été"', "été"),
        ('"a" and a remark', "a"),
        ('"a', "a"),
        ('"-"', "-"),
        ('".PEN_DOWN"', ".PEN_DOWN"),
    ],
)
def test_labels_are_quoted_and_escaped_or_nearly_so(quoted: str, label: str) -> None:
    assert segment(f" CHARACTER 0 ? {quoted}\n").label == label


NO_SEGMENTS = ("", ' C 1x ? "a"', ' C 5-3 ? "a"', ' C 2:9-2:3 ? "a"', ' C 2:9-2:0 ? "a"', ' C 3- ? "a"',
               ' C 1,,2 ? "a"', ' C -1 ? "a"', " C 1 OK a b", f' C {"1" * 5000} ? "a"')  # fmt: skip


@pytest.mark.parametrize("text", NO_SEGMENTS)
def test_what_is_no_segment_says_so(text: str) -> None:
    sentence = str(segment(text).error)
    assert sentence.startswith('a.dat: line 1: expected .SEGMENT level first-last quality "label", found \'.SEGMENT')
    assert len(sentence) < 160


HIERARCHY = ["PAGE", "LINE", "WORD", "CHARACTER"]


@pytest.mark.parametrize(
    ("texts", "hierarchy", "wanted", "levels"),
    [
        ([' WORD 0 ? "ab"', ' CHARACTER 0 ? "a"'], HIERARCHY, None, ["WORD", "CHARACTER"]),
        ([' CHARACTER 0 ? "a"', ' WORD 0 ? "ab"'], HIERARCHY, None, ["WORD", "CHARACTER"]),
        ([' WORD 0 ? "ab"', " CHARACTER 0"], HIERARCHY, None, ["WORD"]),
        ([" WORD 0", " CHARACTER 0"], HIERARCHY, None, ["WORD", "CHARACTER"]),
        ([' PAGE 0 ? "p"', ' WORD 0 ? "ab"', ' CHARACTER 0 ? "a"'], HIERARCHY, "WORD", ["PAGE", "WORD"]),
        ([' WORD 0 ? "ab"', ' CHARACTER 0 ? "a"'], [], None, ["WORD", "CHARACTER"]),
        ([' STROKE 0 ? "s"', ' WORD 0 ? "ab"'], HIERARCHY, None, ["STROKE", "WORD"]),
    ],
)
def test_the_innermost_level_with_labels_is_read_unless_another_is_wanted(
    texts: list[str], hierarchy: list[str], wanted: str | None, levels: list[str]
) -> None:
    assert choose_level([segment(text) for text in texts], hierarchy, wanted) == levels


def test_a_level_that_is_not_there_is_refused_with_those_that_are() -> None:
    segments = [segment(' WORD 0 ? "ab"'), segment(' CHARACTER 0 ? "a"')]
    with pytest.raises(UnknownNameError, match="Unknown level of segments 'LINE'; known are WORD, CHARACTER"):
        choose_level(segments, HIERARCHY, "LINE")


def found(texts: list[tuple[str, int]], sizes: list[int], levels: tuple[str, ...] = ("C",)) -> list[object]:
    """Slices, or the sentence that says why there are none, for segments of a text and how many components before."""
    parts = components(sizes)
    chosen = segments_of_level([segment(text, after) for text, after in texts], levels, len(parts))
    numbering = choose_numbering(chosen, parts, "a.dat")
    results: list[object] = []
    for placed in chosen:
        try:
            results.append(find_slices(placed, numbering, parts))
        except FileFormatError as error:
            results.append(str(error))
    return results


def test_components_are_counted_from_0_wherever_the_segments_stand() -> None:
    first = found([(' C 0,2 ? "a"', 0), (' C 1 ? "b"', 0)], [5, 6, 7])
    assert first == [[Slice(0, 0, 5), Slice(2, 0, 7)], [Slice(1, 0, 6)]]
    assert found([(' C 0,2 ? "a"', 3), (' C 1 ? "b"', 3)], [5, 6, 7]) == first
    assert found([(' C 1 ? "b"', 0), (' C 0 ? "a"', 1)], [5, 6]) == [[Slice(1, 0, 6)], [Slice(0, 0, 5)]]


def test_points_are_counted_from_0_too_and_the_last_is_included() -> None:
    assert found([(' C 0:2-2:3 ? "a"', 0), (' C 2:4-2:4 ? "b"', 0)], [5, 6, 7]) == [
        [Slice(0, 2, 5), Slice(1, 0, 6), Slice(2, 0, 4)],
        [Slice(2, 4, 5)],
    ]
    assert found([(' C 0:2-0:5 ? "a"', 0)], [5]) == [[Slice(0, 2, 5)]]  # one past the end
    assert found([(' C 0:2-0:6 ? "a"', 0), (' C 0:5-0:5 ? "a"', 0)], [5]) == [
        "a.dat: line 1: expected points 2 to 6 of component 0, found 5.",
        "a.dat: line 1: expected points 5 to 4 of component 0, found 5.",
    ]


def test_a_component_that_is_not_there_spoils_its_segment_only() -> None:
    assert found([(' C 0 ? "a"', 0), (' C 1-999999999 ? "b"', 0), (' C 1 ? "c"', 0)], [5, 6]) == [
        [Slice(0, 0, 5)],
        "a.dat: line 1: expected component 999999999 of 'b', found 2 components, from 0.",
        [Slice(1, 0, 6)],
    ]


def test_numbers_of_a_larger_file_mean_the_components_that_follow() -> None:
    assert found([(' C 30 ? "a"', 0), (' C 112-113 ? "b"', 1)], [5, 6, 7]) == [
        [Slice(0, 0, 5)],
        [Slice(1, 0, 6), Slice(2, 0, 7)],
    ]
    writers = [(' C 0 ? "a"', 0), (' C 2 ? "b"', 1), (' C 0 ? "a"', 2), (' C 1 ? "b"', 3)]  # two, each counted from 0
    assert found(writers, [5, 6, 7, 8]) == [[Slice(n, 0, 5 + n)] for n in range(4)]
    assert found([(' C 30 ? "a"', 0), (' C 112-114 ? "b"', 1), (' C 9:2 ? "c"', 3)], [5, 6, 7, 8]) == [
        [Slice(0, 0, 5)],
        "a.dat: line 1: expected 3 components of 'b' after .SEGMENT, found 2.",
        "a.dat: line 1: expected 1 component of 'c' after .SEGMENT, found 1.",
    ]


def test_numbers_may_begin_anew_with_each_start_set() -> None:
    texts = [(' C 0 ? "a"', 0, 0), (' C 1 ? "b"', 0, 0), (' C 0 ? "c"', 2, 2), (' C 1 ? "d"', 2, 2)]
    segments = [segment(text, after)._replace(base=base) for text, after, base in texts]
    parts = components([5, 6, 7, 8])
    chosen = segments_of_level(segments, ["C"], 4)
    numbering = choose_numbering(chosen, parts, "a.dat")
    assert numbering is not None
    assert numbering.what == "numbers of components that begin anew with each .START_SET"
    assert [find_slices(placed, numbering, parts) for placed in chosen] == [[Slice(n, 0, 5 + n)] for n in range(4)]
    through = segments_of_level([s._replace(spans=whole(n)) for n, s in enumerate(segments)], ["C"], 4)
    assert choose_numbering(through, parts, "a.dat") == Numbering("", range(4), 4)


def test_numbers_may_count_every_pen_up() -> None:
    texts = [(' C 0-3 ? "a"', 0), (' C 4:1-4:5 ? "b"', 0), (' C 6 ? "c"', 0)]
    parts = [part._replace(switch=2 * n) for n, part in enumerate(components([5, 6, 7, 8]))]
    chosen = segments_of_level([segment(text, after) for text, after in texts], ["C"], 4)
    numbering = choose_numbering(chosen, parts, "a.dat")
    assert numbering is not None
    assert numbering.what == "numbers of components that count bare .PEN_UP too"
    assert [find_slices(placed, numbering, parts) for placed in chosen] == [
        [Slice(0, 0, 5), Slice(1, 0, 6)],
        [Slice(2, 1, 6)],
        [Slice(3, 0, 8)],
    ]


def test_a_segment_without_numbers_is_what_follows_up_to_the_next_of_its_level_or_an_outer_one() -> None:
    texts = [(" P", 0), (" C", 1), (" S", 2), (" C ?", 3), (" P", 4), (" C", 5)]
    assert found(texts, [1, 2, 3, 4, 5], ("P", "C")) == [
        [Slice(1, 0, 2), Slice(2, 0, 3)],
        [Slice(3, 0, 4)],
        "a.dat: line 1: expected the components of '' after .SEGMENT, found none.",
    ]
    assert found(texts, [1, 2, 3, 4, 5], ("P",)) == [[Slice(n, 0, n + 1) for n in range(4)], [Slice(4, 0, 5)]]


def test_a_segment_that_cannot_be_understood_ends_the_one_before_it() -> None:
    first, second = found([(" C", 0), (' C 1x ? "b"', 1)], [5, 6])
    assert first == [Slice(0, 0, 5)]
    assert str(second).startswith("a.dat: line 1: expected .SEGMENT level first-last")


def test_segments_that_repeat_a_file_over_and_over_are_refused() -> None:
    with pytest.raises(
        FileFormatError, match="a component in at most 4 segments of a level, found more, on the average"
    ):
        found([(' C 0-99 ? "a"', 0)] * 100, [1] * 100)
