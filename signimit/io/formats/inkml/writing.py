"""Writing InkML: one trace group for each stroke of a library."""

from __future__ import annotations

import os
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from signimit.exceptions import InvalidInputError
from signimit.io.formats.xmlfile import NO_XML
from signimit.io.safe_files import replaced_file
from signimit.strokes import Stroke, StrokeLibrary

_CHANNELS = (
    {"name": "X", "type": "decimal"},
    {"name": "Y", "type": "decimal", "orientation": "-ve"},
    {"name": "T", "type": "decimal", "units": "s"},
)


def write_inkml(path: str | os.PathLike[str], library: StrokeLibrary) -> None:
    """Write a library, whole or not at all: one trace group for each stroke, with its label and writer.

    Numbers are written so that `read_inkml` gives the same library back to the last bit, times from 0.

    Raises:
        InvalidInputError: If a label or writer has characters that XML cannot hold.
    """
    ink = Element("ink", {"xmlns": "http://www.w3.org/2003/InkML"})
    channels = SubElement(ink, "traceFormat")
    for channel in _CHANNELS:
        SubElement(channels, "channel", channel)
    _annotate(ink, "source", library.source)
    for stroke, label, writer in zip(library.strokes, library.labels, library.writers, strict=True):
        group = SubElement(ink, "traceGroup")
        _annotate(group, "label", label)
        _annotate(group, "writer", writer)
        SubElement(group, "trace").text = _trace(stroke)
    indent(ink)
    with replaced_file(path) as file:
        file.write(tostring(ink, encoding="utf-8", xml_declaration=True))


def _annotate(element: Element, kind: str, text: str) -> None:
    if found := NO_XML.search(text):
        raise InvalidInputError(kind, "characters that XML can hold", repr(found[0]))
    SubElement(element, "annotation", {"type": kind}).text = text


def _trace(stroke: Stroke) -> str:
    rows = zip(stroke.points.tolist(), stroke.times.tolist(), strict=True)
    return ", ".join(f"{x!r} {y!r} {t!r}" for (x, y), t in rows)
