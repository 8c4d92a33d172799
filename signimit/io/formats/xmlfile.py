"""Bounded reading of XML files from anywhere; nothing in them is expanded or fetched."""

from __future__ import annotations

import os
import re
from itertools import pairwise
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, TreeBuilder

from signimit.exceptions import FileFormatError, MissingDependencyError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.textfile import DecodedText, decode_text, read_bytes

_OTHER_ENCODING = 19  # of expat's errors
_MENDABLE_ERRORS = (4, 11, 17, _OTHER_ENCODING)  # and: invalid token, undefined entity, declaration not at the start
NO_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # characters that XML cannot hold
_BARE_AMPERSAND = re.compile(r"&(?!(?:amp|lt|gt|quot|apos|#\d+|#x[0-9a-fA-F]+);)")
_ENCODING = re.compile(rb"""\s*<\?xml[^>]*?encoding\s*=\s*["']([\w.-]+)""")
_AROUND_XML = "\ufeff \t\r\n\0\x1a"  # what may stand before or after XML: marks, blanks, ends of text
_FIRST_ELEMENT = re.compile(
    r"(?>[\s\ufeff]+|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>)*+<([^\s/>!?]+)", re.DOTALL
)
_DRAWINGS = ("traceGroup", "Gesture")  # elements that stand for themselves, with all that they hold


class XmlDocument(NamedTuple):
    """An XML file's root element, what was repaired to parse it, and why a part of it was left out."""

    root: Element
    findings: tuple[Finding, ...] = ()
    left_out: tuple[FileFormatError, ...] = ()


def read_xml(path: str | os.PathLike[str]) -> XmlDocument:
    """Parse an XML file with defusedxml, in any encoding, also if it is not the one that it declares.

    Of a file that is broken somewhere, the drawings before that are kept if they stand for themselves.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If it is no well-formed XML, or declares entities.
        MissingDependencyError: If defusedxml is not installed.
    """
    return parse_xml(read_bytes(path), os.fspath(path))


def parse_xml(data: bytes, where: str) -> XmlDocument:
    """Parse bytes as `read_xml` does.

    Raises:
        FileFormatError: If they are no well-formed XML, or declare entities.
        MissingDependencyError: If defusedxml is not installed.
    """
    try:
        from defusedxml.common import DefusedXmlException
        from defusedxml.ElementTree import ParseError, fromstring
    except ImportError:
        raise MissingDependencyError("defusedxml", "strokes", "Reading XML strokes") from None
    try:
        try:
            return XmlDocument(fromstring(data))
        except (ParseError, ValueError) as error:
            mended = _mended_xml(data, where, getattr(error, "code", None))
            if mended is not None:
                try:
                    return XmlDocument(fromstring(mended.text), mended.findings)  # text's declaration is ignored
                except ParseError:
                    pass
            root = _whole_drawings(data if mended is None else mended.text)
            if root is None:
                raise error from None
            expected = "well-formed XML to the end (drawings before that are read)"
            broken = FileFormatError(where, expected, str(error))
            return XmlDocument(root, () if mended is None else mended.findings, (broken,))
    except ParseError as error:
        raise FileFormatError(where, "well-formed XML", str(error)) from None
    except DefusedXmlException as error:
        raise FileFormatError(where, "XML without entities", type(error).__name__) from None
    except (LookupError, ValueError) as error:
        raise FileFormatError(where, "XML in an encoding that exists", str(error)) from None


def _mended_xml(data: bytes, where: str, code: int | None) -> DecodedText | None:
    """Decode XML that expat refused for its encoding or for a character; none if it is something else.

    Args:
        data: The file's bytes.
        where: The file.
        code: Expat's number of the error; none if the encoding is one of several bytes a character, not Unicode.
    """
    if code is None:
        declared = _ENCODING.match(data)
        return DecodedText(data.decode(declared[1].decode())) if declared else None
    if code not in _MENDABLE_ERRORS:
        return None
    text, findings = decode_text(data, where)
    if code == _OTHER_ENCODING and not findings:
        findings = (Finding(where, "XML in another encoding than it declares: found out"),)
    text, controls = NO_XML.subn("\ufffd", text.strip(_AROUND_XML))
    text, ampersands = _BARE_AMPERSAND.subn("&amp;", text)
    if controls + ampersands:
        what = "characters and ampersands that XML does not allow: replaced"
        findings = (*findings, Finding(where, what, controls + ampersands))
    return DecodedText(text, findings)


class _OpenElements(TreeBuilder):
    """A builder of trees that knows which elements have not ended."""

    def __init__(self) -> None:
        super().__init__()
        self.root: Element | None = None
        self.open: list[Element] = []

    def start(self, tag: Any, attrs: dict[Any, Any], /) -> Element:
        element = super().start(tag, attrs)
        self.root = element if self.root is None else self.root
        self.open.append(element)
        return element

    def end(self, tag: str, /) -> Element:
        self.open.pop()
        return super().end(tag)


def _whole_drawings(broken: str | bytes) -> Element | None:
    """Return the root of broken XML without the drawing that is broken; none unless others stand before it.

    If there is something behind the root, as in logs that were appended to, that is the whole root.
    Where drawings are views of traces, a drawing that is missing would leave traces that seem to be in none.
    """
    from defusedxml.ElementTree import DefusedXMLParser, ParseError

    builder = _OpenElements()
    parser = DefusedXMLParser(target=builder)
    try:
        parser.feed(broken)
        parser.close()
    except (ParseError, ValueError):
        pass
    if not builder.open:
        return builder.root
    for parent, child in pairwise(builder.open):
        name = local_name(child)
        if name in _DRAWINGS and any(local_name(other) == name for other in parent if other is not child):
            parent.remove(child)
            root = builder.open[0]
            return None if any(local_name(element) == "traceView" for element in root.iter()) else root
    return None


def root_name(text: str) -> str:
    """Return the name, without namespace, of the first element of what may be XML, well-formed or not; or nothing."""
    found = _FIRST_ELEMENT.match(text)
    return found[1].rpartition(":")[2] if found else ""


def local_name(element: Element) -> str:
    """Return an element's name without its namespace."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
