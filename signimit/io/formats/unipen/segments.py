"""Segments of UNIPEN text: what is written about components, at the levels of a hierarchy."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from signimit.exceptions import FileFormatError, UnknownNameError
from signimit.io.formats.unipen.pen_data import Component
from signimit.io.formats.unipen.statements import Statement

QUALITIES = ("?", "OK", "BAD", "GOOD", "ACCEPT", "REJECT")
LONGEST_LABEL = 1000  # characters
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
        base: How many of them stand before the last ``.START_SET``.
        error: Why it cannot be understood.
    """

    level: str
    spans: tuple[Span, ...] | None
    label: str
    where: str
    after: int
    base: int = 0
    error: FileFormatError | None = None


def read_segment(statement: Statement, after: int, base: int = 0) -> Segment:
    """Read a statement such as ``.SEGMENT WORD 3-5,8:0-8:20 OK "house"``; all but the level may be missing.

    Args:
        statement: The statement.
        after: How many components stand before it.
        base: How many of them stand before the last ``.START_SET``.
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
    segment = Segment(level, spans, label, statement.where, after, base)
    backwards = any(s.last < s.first or (s.last == s.first and _end(s) < s.first_point) for s in spans or ())
    if level and len(words) <= (not quote) and len(spans or ()) == len(parts) and not backwards:
        if len(label) <= LONGEST_LABEL:
            return segment
        error = FileFormatError(statement.where, f"a label of at most {LONGEST_LABEL} characters", f"{len(label)}")
        return segment._replace(label="", spans=None, error=error)
    found_text = repr(f".SEGMENT{statement.body[:80]}".strip()[:60])
    error = FileFormatError(statement.where, '.SEGMENT level first-last quality "label"', found_text)
    return segment._replace(spans=None, error=error)


def _end(span: Span) -> int:
    return span.first_point if span.last_point is None else span.last_point


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
    declared = dict.fromkeys(hierarchy)
    ranked = [level for level in present if level not in declared] + [x for x in declared if x in present]
    if wanted is None:
        labelled = {segment.level for segment in segments if segment.label}
        wanted = next((level for level in reversed(ranked) if level in labelled), ranked[-1])
    if wanted not in ranked:
        raise UnknownNameError("level of segments", wanted, ranked)
    return ranked[: ranked.index(wanted) + 1]


class Placed(NamedTuple):
    """A segment and the components that stand between it and the next one of its level, or of an outer one."""

    segment: Segment
    following: range


def segments_of_level(segments: Sequence[Segment], levels: Sequence[str], count: int) -> list[Placed]:
    """Return the segments of the last of the levels, and those of no level, with what follows each.

    Args:
        segments: All segments of a file.
        levels: Levels from the outermost to the one that is wanted.
        count: How many components the file has.
    """
    bounds = set(levels)
    bounding = [segment for segment in segments if segment.level in bounds or segment.error]
    ends = [*(segment.after for segment in bounding[1:]), count]
    placed = [Placed(s, range(s.after, end)) for s, end in zip(bounding, ends, strict=True)]
    return [p for p in placed if p.segment.level in ("", levels[-1])]


class Numbering(NamedTuple):
    """What the numbers in segments count.

    Attributes:
        what: In words; empty for that of the reference library.
        numbers: Number of each component, rising.
        end: First number that does not exist.
        from_set: Whether they begin anew with each ``.START_SET``.
    """

    what: str
    numbers: Sequence[int]
    end: int
    from_set: bool = False

    def find_components(self, segment: Segment) -> list[range]:
        """Return which components each span of a segment is about.

        Raises:
            FileFormatError: If it names one that does not exist.
        """
        found, base = [], segment.base if self.from_set else 0
        for span in segment.spans or ():
            first, last = base + span.first, base + span.last
            if last >= self.end:
                exist = f"{len(self.numbers)} components, from 0"
                raise FileFormatError(segment.where, f"component {last} of {segment.label!r}", exist)
            found.append(range(bisect_left(self.numbers, first), bisect_right(self.numbers, last)))
        return found


def choose_numbering(placed: Sequence[Placed], components: Sequence[Component], path: str) -> Numbering | None:
    """Find out what the numbers in segments count; none if the segments are about the components that follow them.

    The reference library counts components with points through the file and what it includes, from 0. Others count
    bare ``.PEN_UP`` too, or begin anew with each ``.START_SET``. Excerpts of larger files, such as UCI's pendigits,
    keep the numbers of the whole: there, a segment is about what follows it. It is the first of these that most
    segments fit: those whose components exist and are in no segment before, or are as many as follow.

    Args:
        placed: The segments of a level.
        components: All components of the file.
        path: The file, for errors.

    Raises:
        FileFormatError: If the segments repeat more components than they can mean.
    """
    count, switches = len(components), [component.switch for component in components]
    best, best_score = Numbering("", range(count), count), -1
    for numbering in (
        best,
        Numbering("numbers of components that count bare .PEN_UP too", switches, switches[-1] + 2),
        Numbering("numbers of components that begin anew with each .START_SET", range(count), count, True),
    ):
        score, taken, named = 0, set[int](), 0
        for segment, _ in placed:
            try:
                ranges = numbering.find_components(segment)
            except FileFormatError:
                continue
            named += sum(map(len, ranges))
            if named > MOST_SHARING * count + 1000:
                found = "more, on the average"
                raise FileFormatError(path, f"a component in at most {MOST_SHARING} segments of a level", found)
            numbers = {n for each in ranges for n in each}
            score += bool(numbers) and (not _is_whole(segment) or taken.isdisjoint(numbers))
            taken |= numbers
        if score > best_score:
            best, best_score = numbering, score
    in_place = sum(_is_whole(segment) and _size(segment) == len(following) for segment, following in placed)
    return None if in_place > best_score else best


def find_slices(placed: Placed, numbering: Numbering | None, components: Sequence[Component]) -> list[Slice]:
    """Find the points of a segment.

    Raises:
        FileFormatError: If they do not exist, or the segment cannot be understood.
    """
    segment, following = placed
    if segment.error:
        raise segment.error
    size = _size(segment)
    if segment.spans is None or numbering is None:
        if not following or (segment.spans and not (_is_whole(segment) and size == len(following))):
            expected = f"{size or 'the'} component{'s' * (size != 1)} of {segment.label!r} after .SEGMENT"
            raise FileFormatError(segment.where, expected, f"{len(following) or 'none'}")
        return [Slice(n, 0, len(components[n].points)) for n in following]
    slices = []
    for span, numbers in zip(segment.spans, numbering.find_components(segment), strict=True):
        for n in numbers:
            count = len(components[n].points)
            start = span.first_point if n == numbers[0] else 0
            stop = count if n < numbers[-1] or span.last_point in (None, count) else (span.last_point or 0) + 1
            if components[n].error is None and not start < stop <= count:
                raise FileFormatError(segment.where, f"points {start} to {stop - 1} of component {n}", f"{count}")
            slices.append(Slice(n, start, stop))
    return slices


def _size(segment: Segment) -> int:
    """Return how many components a segment names."""
    return sum(span.last - span.first + 1 for span in segment.spans or ())


def _is_whole(segment: Segment) -> bool:
    """Tell whether a segment names components, and no points in them."""
    return bool(segment.spans) and all(not s.first_point and s.last_point is None for s in segment.spans or ())
