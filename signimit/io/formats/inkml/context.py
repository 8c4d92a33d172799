"""Contexts: the trace format, device, canvas and time stamp under which a trace was written (InkML 1.1, section 5)."""

from __future__ import annotations

from datetime import UTC, datetime
from functools import cached_property
from typing import NamedTuple
from xml.etree.ElementTree import Element

from signimit.exceptions import FileFormatError
from signimit.io.formats.inkml.document import InkDocument
from signimit.io.formats.inkml.mapping import AffineMapping, read_mappings
from signimit.io.formats.inkml.trace_format import TraceFormat, read_number, read_trace_format
from signimit.io.formats.xmlfile import local_name

_REFERENCES = ("inkSource", "traceFormat", "canvas", "canvasTransform", "timestamp")
_CONTEXTS = ("context", "inkSource", "traceFormat")  # the latter two, of no standard, as contexts that say only this
_LEAST_RATE = 0.001  # Hz; a slower device declares nothing


class ContextParts(NamedTuple):
    """The elements that a context is made of, none where it says nothing, or why they cannot be found."""

    source: Element | None = None
    layout: Element | None = None
    canvas: Element | None = None
    transform: Element | None = None
    stamp: Element | None = None
    broken: FileFormatError | None = None


class Context(NamedTuple):
    """What holds for a trace.

    Attributes:
        layout: Its trace format.
        canvas: The trace format of the canvas that it is mapped onto; none if it is not.
        mappings: How it is mapped onto the canvas.
        sample_time: Seconds between points, if the device says so.
        start: What time offsets count from, s since 1970; none if unknown.
    """

    layout: TraceFormat = TraceFormat()
    canvas: TraceFormat | None = None
    mappings: tuple[AffineMapping, ...] = ()
    sample_time: float | None = None
    start: float | None = None


class Contexts:
    """The contexts of a document.

    A context that says nothing of the format, or a trace without context, has what was set last between the traces
    before it, then the only format of the document, then the standard's: channels X and Y.
    """

    def __init__(self, document: InkDocument) -> None:
        """Keep the document; contexts are read when a trace needs them."""
        self._document = document
        self._known: dict[tuple[str | None, ContextParts], Context | FileFormatError] = {}

    def of(self, reference: str | None, stream: ContextParts) -> Context:
        """Return the context of a trace.

        Args:
            reference: Its ``contextRef``, or that of a group around it.
            stream: What was set between the traces before it.

        Raises:
            FileFormatError: If the context refers to what is not there or cannot be understood.
        """
        key = reference, stream
        if key not in self._known:
            try:
                self._known[key] = self._read(reference, stream)
            except FileFormatError as error:
                self._known[key] = error
        context = self._known[key]
        if isinstance(context, FileFormatError):
            raise FileFormatError(context.where, context.expected, context.found)
        return context

    def extended(self, stream: ContextParts, element: Element) -> ContextParts:
        """Return what holds after an element between traces: a context, or a bare inkSource or traceFormat.

        Raises:
            FileFormatError: If the context refers to what is not there.
        """
        kind = local_name(element)
        if kind == "traceFormat":
            return stream._replace(layout=element)
        if kind == "inkSource":
            return stream._replace(source=element, layout=None)
        for context in self._document.chain(element, "contextRef", "context"):
            inside = {local_name(child): child for child in context}
            for name in _REFERENCES:
                if reference := context.get(f"{name}Ref"):
                    inside.setdefault(name, self._document.find(reference, (name,), f"{name}Ref"))
            if "inkSource" in inside:
                stream = stream._replace(source=inside["inkSource"], layout=None)
            stream = stream._replace(
                layout=inside.get("traceFormat", stream.layout),
                canvas=inside.get("canvas", stream.canvas),
                transform=inside.get("canvasTransform", stream.transform),
                stamp=inside.get("timestamp", stream.stamp),
            )
        return stream

    def time(self, reference: str) -> float | None:
        """Return a time stamp in s since 1970; none if there is no such stamp, or it does not say."""
        try:
            return self._read_time(self._document.find(reference, ("timestamp",), "timestamp"))
        except FileFormatError:  # a clock that counts from an unnamed moment is still a clock
            return None

    def _read(self, reference: str | None, stream: ContextParts) -> Context:
        parts = ContextParts() if reference else stream
        if reference and reference.strip() != "#DefaultContext":
            parts = self.extended(parts, self._document.find(reference, _CONTEXTS, "contextRef"))
        if parts.broken is not None:
            raise parts.broken
        if parts.source is None and parts.layout is None:
            parts = parts._replace(source=stream.source, layout=stream.layout)
        if parts.source is None and parts.layout is None:
            parts = self._only_format._replace(canvas=parts.canvas, transform=parts.transform, stamp=parts.stamp)
        transform = [] if parts.transform is None else [e for e in parts.transform if local_name(e) == "mapping"]
        return Context(
            layout=self._layout(parts.source, parts.layout),
            canvas=None if not transform else self._layout(None, parts.canvas),
            mappings=tuple(read_mappings(transform[0], self._document)) if transform else (),
            sample_time=_sample_time(parts.source),
            start=None if parts.stamp is None else self._read_time(parts.stamp),
        )

    def _layout(self, source: Element | None, holder: Element | None) -> TraceFormat:
        """Read the trace format that an element is, holds or refers to."""
        element = source if holder is None else holder
        if element is not None and local_name(element) != "traceFormat":
            held = [child for child in element if local_name(child) == "traceFormat"]
            reference = element.get("traceFormatRef")
            if held or not reference:
                element = held[0] if held else None
            else:
                element = self._document.find(reference, ("traceFormat",), "traceFormatRef")
        if element is not None and not len(element) and (reference := element.get("href")):
            element = self._document.find(reference, ("traceFormat",), "traceFormat")
        return TraceFormat() if element is None else read_trace_format(element, source)

    @cached_property
    def _only_format(self) -> ContextParts:
        """The format of a document that has only one, wherever it stands."""
        of_canvases = {child for canvas in self._document.elements("canvas") for child in canvas}
        for kind in _CONTEXTS:
            found = {}
            for element in self._document.elements(kind):
                if element in of_canvases:
                    continue
                try:
                    parts = self.extended(ContextParts(), element)
                    layout = self._layout(parts.source, parts.layout)
                except FileFormatError:  # which matters to those that refer to it
                    continue
                if parts.source is not None or parts.layout is not None:
                    found[layout] = parts
            if found:
                return next(iter(found.values())) if len(found) == 1 else ContextParts()
        return ContextParts()

    def _read_time(self, element: Element) -> float | None:
        offset = 0.0
        for stamp in self._document.chain(element, "timestampRef", "timestamp")[::-1]:
            offset += (read_number(stamp.get("timeOffset")) or 0.0) / 1000
            if (time := read_number(stamp.get("time"))) is not None:
                return time / 1000 + offset
            if text := stamp.get("timeString"):
                try:
                    moment = datetime.fromisoformat(text.strip())
                except ValueError:
                    return None
                return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp() + offset
        return None


def _sample_time(source: Element | None) -> float | None:
    """Return the seconds between points that a device declares."""
    for element in () if source is None else source:
        if local_name(element) == "sampleRate":
            rate = read_number(element.get("value"))
            return 1 / rate if rate is not None and rate > _LEAST_RATE else None
    return None
