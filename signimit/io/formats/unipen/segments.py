"""Segments of UNIPEN text: what is written about components, at the levels of a hierarchy."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from signimit.exceptions import FileFormatError, UnknownNameError
from signimit.io.formats.unipen.pen_data import Component
from signimit.io.formats.unipen.statements import Statement

QUALITIES = ("?", "OK", "BAD", "GOOD", "ACCEPT", "REJECT")
MOST_SHARING = 4  # drawings of one level that a component may be in, on the average
_SPAN = re.compile(r"(\d{1,9})(?::(\d{1,9}))?(?:-(\d{1,9})(?::(\d{1,9}))?)?")
_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_GLUE = re.compile(r"\s*([,:-])\s*")


class Span(NamedTuple):
    """Components from one to another, both included, e.g. ``2:10-4:20``.

    Attributes:
        first: Number of the first component.
        first_point: Its first point.
        last: Number of the last component.
        last_point: Its last point; none if it is the last one that there is.
    """

    first: int
    first_point: int
    last: int
    last_point: int | None


class Slice(NamedTuple):
    """Points of one component, from ``start`` to before ``stop``."""

    component: int
    start: int
    stop: int


class Segment(NamedTuple):
    """A ``.SEGMENT`` statement.

    Attributes:
        level: Level of the hierarchy.
        spans: Which components it is about; none if it does not say, and is about those that follow.
        label: What they are; empty if it does not say.
        where: File and line.
        after: How many components stand before it.
        error: Why it cannot be understood.
    """

    level: str
    spans: tuple[Span, ...] | None
    label: str
    where: str
    after: int
    error: FileFormatError | None = None


def read_segment(statement: Statement, after: int) -> Segment:
    """Read a statement such as ``.SEGMENT WORD 3-5,8:0-8:20 OK "house"``; all but the level may be missing.

    Args:
        statement: The statement.
        after: How many components stand before it.
    """
    head, quote, tail = statement.body.partition('"')
    level, *rest = head.split(maxsplit=1) or [""]
    words = _GLUE.sub(r"\1", "".join(rest)).split()
    parts, spans = words.pop(0).split(",") if words and words[0][0].isdigit() else [], None
    if parts:
        spans = tuple(_span(*found.groups()) for part in parts if (found := _SPAN.fullmatch(part)))
    elif words and words[0] == "?":
        del words[0]
    if words and words[0].upper() in QUALITIES:
        del words[0]
    label = _read_label(quote + tail) if quote else "".join(words[:1])
    segment = Segment(level, spans, label, statement.where, after)
    backwards = any((s.last, s.last_point or s.first_point) < (s.first, s.first_point) for s in spans or ())
    if level and len(words) <= (not quote) and len(spans or ()) == len(parts) and not backwards:
        return segment
    found_text = repr(f".SEGMENT{statement.body}".strip()[:60])
    error = FileFormatError(statement.where, '.SEGMENT level first-last quality "label"', found_text)
    return segment._replace(spans=None, error=error)


def _span(first: str, first_point: str | None, last: str | None, last_point: str | None) -> Span:
    if last is None:
        last, last_point = first, first_point
    return Span(int(first), int(first_point or 0), int(last), None if last_point is None else int(last_point))


def _read_label(text: str) -> str:
    """Return a label without its quotes and escapes; all white space in it is a space, as the standard has it."""
    found = _QUOTED.match(text)
    if found and '"' not in text[found.end() :]:
        label = found[1]
    else:  # quotes or backslashes that should have been escaped, such as in \"\"\" and \"\\\"
        line = text.partition("\n")[0].rstrip()
        label = line[1:-1] if len(line) > 1 and line.endswith('"') else line[1:].rpartition('"')[0] or line[1:]
    label = re.sub(r"\\(.)", lambda escape: {"n": " ", "t": " "}.get(escape[1], escape[1]), label, flags=re.DOTALL)
    return re.sub(r"\s", " ", label)


def choose_level(segments: Sequence[Segment], hierarchy: Sequence[str], wanted: str | None) -> list[str]:
    """Return the levels from the outermost to the one that drawings are made of.

    That is the wanted one, else the innermost with labels, else the innermost. Levels that the hierarchy does not
    name are outside of those that it does, in the order in which they come.

    Raises:
        UnknownNameError: If no segment is of the wanted level.
    """
    present = dict.fromkeys(segment.level for segment in segments)
    ranked = [level for level in present if level not in hierarchy] + [x for x in hierarchy if x in present]
    if wanted is None:
        labelled = {segment.level for segment in segments if segment.label}
        wanted = next((level for level in reversed(ranked) if level in labelled), ranked[-1])
    if wanted not in ranked:
        raise UnknownNameError("level of segments", wanted, ranked)
    return ranked[: ranked.index(wanted) + 1]


def find_slices(
    segments: Sequence[Segment], levels: Sequence[str], components: Sequence[Component], path: str
) -> list[tuple[Segment, list[Slice] | FileFormatError]]:
    """Find the points of each segment of the last of the levels, or what is wrong with it.

    Components are counted from 0 through the file and what it includes. Excerpts of larger files, such as UCI's
    pendigits, keep the numbers of the whole: there, a segment is about the components that follow it. That is taken to
    be so if more segments are followed by just as many components as they name than name some that exist and that no
    segment before them has named.

    Raises:
        FileFormatError: If the segments repeat more components than they can mean.
    """
    bounding = [segment for segment in segments if segment.level in levels or segment.error]
    ends = [*(segment.after for segment in bounding[1:]), len(components)]
    chosen = [
        (s, range(s.after, end)) for s, end in zip(bounding, ends, strict=True) if s.level == levels[-1] or not s.level
    ]
    existing = [s for s, _ in chosen if s.spans and all(span.last < len(components) for span in s.spans)]
    if sum(map(_size, existing)) > MOST_SHARING * len(components) + 1000:
        raise FileFormatError(
            path, f"a component in at most {MOST_SHARING} segments of a level", "more, on the average"
        )
    by_place = sum(_is_whole(segment) and _size(segment) == len(following) for segment, following in chosen)
    by_number, taken = 0, set[int]()
    for segment in existing:
        named = {n for span in segment.spans or () for n in range(span.first, span.last + 1)}
        by_number += not _is_whole(segment) or taken.isdisjoint(named)
        taken |= named
    found: list[tuple[Segment, list[Slice] | FileFormatError]] = []
    for segment, following in chosen:
        in_place = segment.spans is None or by_place > by_number
        try:
            if segment.error:
                raise segment.error
            slices = _following(segment, following, components) if in_place else _numbered(segment, components)
            found.append((segment, slices))
        except FileFormatError as error:
            found.append((segment, error))
    return found


def _size(segment: Segment) -> int:
    """Return how many components a segment names."""
    return sum(span.last - span.first + 1 for span in segment.spans or ())


def _is_whole(segment: Segment) -> bool:
    """Tell whether a segment names components, and no points in them."""
    return bool(segment.spans) and all(not s.first_point and s.last_point is None for s in segment.spans or ())


def _following(segment: Segment, following: range, components: Sequence[Component]) -> list[Slice]:
    size = _size(segment)
    if not following or (segment.spans and not (_is_whole(segment) and size == len(following))):
        expected = f"{size or 'the'} component{'s' * (size != 1)} of {segment.label!r} after .SEGMENT"
        raise FileFormatError(segment.where, expected, f"{len(following) or 'none'}")
    return [Slice(n, 0, len(components[n].points)) for n in following]


def _numbered(segment: Segment, components: Sequence[Component]) -> list[Slice]:
    slices = []
    for span in segment.spans or ():
        if span.last >= len(components):
            raise FileFormatError(
                segment.where, f"component {span.last} of {segment.label!r}", f"{len(components)} components, from 0"
            )
        for n in range(span.first, span.last + 1):
            count = len(components[n].points)
            start = span.first_point if n == span.first else 0
            stop = count if n < span.last or span.last_point in (None, count) else (span.last_point or 0) + 1
            if components[n].error is None and not start < stop <= count:
                raise FileFormatError(segment.where, f"points {start} to {stop - 1} of component {n}", f"{count}")
            slices.append(Slice(n, start, stop))
    return slices
