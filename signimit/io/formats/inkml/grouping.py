"""Which traces make up a drawing: trace groups, and trees of views on traces (InkML 1.1, sections 3.2 and 3.3)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple
from xml.etree.ElementTree import Element

from signimit.exceptions import FileFormatError
from signimit.io.formats.inkml.context import ContextParts, Contexts
from signimit.io.formats.inkml.document import InkDocument, read_annotation, read_label
from signimit.io.formats.inkml.views import TraceRange, Views, refers
from signimit.io.formats.xmlfile import local_name

_NOT_DRAWN = ("definitions", "context", "inkSource", "traceFormat", "annotationXML")
_MOST_VIEWS_OF_VIEWS = 10  # through which a label is looked for


class Place(NamedTuple):
    """What an element has from the elements around it.

    Attributes:
        container: The group or view that holds it.
        label: The nearest label below the root; none if there is none.
        labelled: The element that has this label.
        writer: The nearest writer below the root.
        context: The nearest ``contextRef``.
        stream: What was set between the traces before it.
        drawn: Whether it is part of the ink; what stands in definitions is not.
    """

    container: Element
    label: str | None = None
    labelled: Element | None = None
    writer: str | None = None
    context: str | None = None
    stream: ContextParts = ContextParts()
    drawn: bool = True


@dataclass
class Drawing:
    """Traces that belong together.

    Attributes:
        label: What it is; none if the file does not say.
        writer: Who drew it; none if the file does not say.
        parts: The traces, or ranges of their points, or why they cannot be told.
    """

    label: str | None
    writer: str | None
    parts: list[list[TraceRange] | FileFormatError] = field(default_factory=list)


def find_places(document: InkDocument, contexts: Contexts) -> dict[Element, Place]:
    """Return what every trace, group and view has from the elements around it, in the order of the file."""
    places: dict[Element, Place] = {}
    outer = Place(document.root)
    for child in document.root:
        kind = local_name(child)
        if kind in ("context", "inkSource", "traceFormat"):
            try:
                outer = outer._replace(stream=contexts.extended(outer.stream, child))
            except FileFormatError as error:
                outer = outer._replace(stream=ContextParts(broken=error))
        _place_tree(child, outer._replace(drawn=kind not in _NOT_DRAWN), places)
    return places


def _place_tree(element: Element, outer: Place, places: dict[Element, Place]) -> None:
    waiting = [(element, outer)]
    while waiting:
        node, place = waiting.pop()
        if local_name(node) not in ("trace", "traceGroup", "traceView"):  # e.g. a page, of no standard
            inner = place._replace(drawn=place.drawn and local_name(node) not in _NOT_DRAWN)
        else:
            if (label := read_label(node)) is not None:
                place = place._replace(label=label, labelled=node)
            writer = read_annotation(node, ("writer",)) or place.writer
            place = place._replace(writer=writer, context=node.get("contextRef") or place.context)
            places[node] = place
            inner = place._replace(container=node)
        waiting += [(child, inner) for child in reversed(node)]


def find_drawings(document: InkDocument, places: Mapping[Element, Place]) -> list[Drawing]:
    """Return the drawings of a document, in the order of their first traces.

    The traces and views that a group or view holds itself are one drawing, except that a view with a label of its own,
    or, where nothing around it has a label, of what it refers to, is another. Views at the root are a drawing each, and
    traces outside groups are one. Ink that is viewed belongs to its views and not to where it is stored, except where
    that has a label and the views have others.
    """
    views = Views(document)
    leaves = {
        element: place
        for element, place in places.items()
        if place.drawn and (local_name(element) == "trace" or refers(element))
    }
    held = {leaf: views.ranges(leaf) for leaf in leaves}
    viewed: dict[Element, bool] = {}  # whether under the label that it has where it is stored
    for leaf, ranges in held.items():
        if refers(leaf) and not isinstance(ranges, FileFormatError):
            place = leaves[leaf]
            leaves[leaf] = _borrow(place, leaf, views, places)
            for part in ranges:
                viewed[part.trace] = viewed.get(part.trace, False) or place.label is None
    drawings: dict[tuple[Element, Element | None], Drawing] = {}
    for leaf, place in leaves.items():
        if leaf in viewed and (viewed[leaf] or place.label is None):
            continue
        own = leaf if refers(leaf) and place.container is document.root else None
        if place.labelled is not places.get(place.container, place).labelled:
            own = place.labelled
        drawing = drawings.setdefault((place.container, own), Drawing(place.label, place.writer))
        drawing.parts.append(held[leaf])
    return list(drawings.values())


def _borrow(place: Place, view: Element, views: Views, places: Mapping[Element, Place]) -> Place:
    """Return the place of a view with the label and the writer of what it refers to, where it has none itself."""
    for _ in range(_MOST_VIEWS_OF_VIEWS):
        if not refers(view):
            break
        view = views.target(view)
        stored = places[view]
        if place.label is None:
            place = place._replace(label=stored.label, labelled=stored.labelled)
        place = place._replace(writer=place.writer or stored.writer)
    return place
