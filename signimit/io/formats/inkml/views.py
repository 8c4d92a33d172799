"""Views: what a ``<traceView>`` refers to, from where to where (InkML 1.1, section 3.3.2)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element

from signimit.exceptions import FileFormatError
from signimit.io.formats.inkml.document import InkDocument
from signimit.io.formats.xmlfile import local_name

_VIEWED = ("trace", "traceGroup", "traceView")
_MOST_VIEWS = 10  # of all points: a small file cannot refer to one large trace a million times
_DEEPEST = 100  # numbers in a from or to


class TraceRange(NamedTuple):
    """A trace, or a part of it.

    Attributes:
        trace: The trace.
        first: Its first point, counted from 0.
        last: The point after its last; none for all that there are.
    """

    trace: Element
    first: int = 0
    last: int | None = None


Content = TraceRange | tuple["Content", ...]


class Views:
    """What the elements of a document hold."""

    def __init__(self, document: InkDocument) -> None:
        """Keep the document, and count its ink."""
        self._document = document
        self._known: dict[Element, Content | FileFormatError] = {}
        points = sum((trace.text or "").count(",") + 1 for trace in document.elements("trace"))
        self._budget = _MOST_VIEWS * (points + len(document.elements("traceView")) + 1)

    def ranges(self, element: Element) -> list[TraceRange] | FileFormatError:
        """Return the traces, or ranges of their points, that a trace, group or view holds, or why that cannot be told.

        That is if a view refers to what is not there or to itself, or there is more in views than ten times the ink.
        """
        content = self._content(element)
        if isinstance(content, FileFormatError):
            return content
        found: list[TraceRange] = []
        waiting: list[Content] = [content]
        try:
            while waiting:
                part = waiting.pop()
                if isinstance(part, TraceRange):
                    last = (part.trace.text or "").count(",") + 1 if part.last is None else part.last
                    self._spend(1 + last - part.first)
                    found.append(part)
                else:
                    self._spend(1)
                    waiting += reversed(part)
        except FileFormatError as error:
            return error
        return found

    def target(self, view: Element) -> Element:
        """Return what a view refers to."""
        return self._document.find(view.get("traceDataRef", ""), _VIEWED, "traceView")

    def _content(self, element: Element) -> Content | FileFormatError:
        """Return what an element holds, or why it cannot be told; without recursion, as documents may be deep."""
        waiting, opened = [element], set[Element]()
        while waiting:
            node = waiting[-1]
            if node in self._known:
                waiting.pop()
                continue
            try:
                parts = self._parts(node)
                unknown = [part for part in parts if part not in self._known]
                if opened.intersection(unknown) or node in unknown:
                    reference = repr(node.get("traceDataRef", "")[:60])
                    raise FileFormatError("traceView", "views that do not refer to themselves", reference)
                if unknown:
                    opened.add(node)
                    waiting += unknown
                else:
                    self._known[node] = self._joined(node, [self._known[part] for part in parts])
            except FileFormatError as error:
                self._known[node] = error
        return self._known[element]

    def _parts(self, node: Element) -> list[Element]:
        """Return the elements that a group or view consists of: its children, or what it refers to."""
        inside = [child for child in node if local_name(child) in _VIEWED]
        if not refers(node):
            return inside
        if inside:
            raise FileFormatError("traceView", "either a traceDataRef or views inside", "both")
        return [self.target(node)]

    def _joined(self, node: Element, parts: Sequence[Content | FileFormatError]) -> Content | FileFormatError:
        if local_name(node) == "trace":
            return TraceRange(node)
        contents = list[Content]()
        for part in parts:
            if isinstance(part, FileFormatError):
                return part
            contents.append(part)
        if not refers(node):
            return tuple(contents)
        return self._restricted(contents[0], _read_index(node, "from"), _read_index(node, "to"))

    def _restricted(self, content: Content, start: Sequence[int], end: Sequence[int]) -> Content:
        """Return what lies between two indices, each a number a level, the last one of a point."""
        if not start and not end:
            return content
        known = None if isinstance(content, TraceRange) and content.last is None else _length(content)
        first, last = (start[0] if start else 1), (end[0] if end else known)
        if first < 1 or (last is not None and last < first) or (known is not None and (last or 0) > known):
            expected = "from and to" + (" of what it holds" if known is None else f" between 1 and {known}")
            raise FileFormatError("traceView", expected, _index_text(start, end))
        if isinstance(content, TraceRange):
            if len(start) > 1 or len(end) > 1:
                raise FileFormatError("traceView", "one number for a point of a trace", _index_text(start, end))
            stop = None if last is None else content.first + last
            return TraceRange(content.trace, content.first + first - 1, stop)
        chosen = list(content[first - 1 : last])
        self._spend(len(chosen))
        chosen[0] = self._restricted(chosen[0], start[1:], end[1:] if len(chosen) == 1 else ())
        if len(chosen) > 1:
            chosen[-1] = self._restricted(chosen[-1], (), end[1:])
        return tuple(chosen)

    def _spend(self, points: int) -> None:
        self._budget -= points
        if self._budget < 0:
            raise FileFormatError("traceView", f"views of at most {_MOST_VIEWS} times the ink", "more")


def refers(element: Element) -> bool:
    """Whether an element is a view that refers to something."""
    return local_name(element) == "traceView" and "traceDataRef" in element.attrib


def _length(content: Content) -> int:
    if isinstance(content, TraceRange):
        return (content.last or 0) - content.first
    return len(content)


def _index_text(start: Sequence[int], end: Sequence[int]) -> str:
    return " to ".join(":".join(map(str, index[:8])) or "the end" for index in (start, end))


def _read_index(view: Element, name: str) -> tuple[int, ...]:
    text = view.get(name, "").strip()
    try:
        index = tuple(int(number) for number in text.split(":")) if text else ()
        if len(index) > _DEEPEST:
            raise ValueError
    except ValueError:
        raise FileFormatError("traceView", f"{name} as numbers with colons between", repr(text[:60])) from None
    return index
