"""Bounded reading of text and XML files from anywhere; nothing in them is expanded or fetched."""

from __future__ import annotations

import codecs
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from signimit.exceptions import FileFormatError, MissingDependencyError
from signimit.io.formats.import_report import Finding

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

MAX_BYTES = 256 * 2**20
_BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),  # before UTF-16, whose mark it begins with
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_OTHER_ENCODING = 19  # of expat's errors
_MENDABLE_ERRORS = (4, 11, 17, _OTHER_ENCODING)  # and: invalid token, undefined entity, declaration not at the start
NO_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # characters that XML cannot hold
_BARE_AMPERSAND = re.compile(r"&(?!(?:amp|lt|gt|quot|apos|#\d+|#x[0-9a-fA-F]+);)")
_ENCODING = re.compile(rb"""\s*<\?xml[^>]*?encoding\s*=\s*["']([\w.-]+)""")
_AROUND_XML = "\ufeff \t\r\n\0\x1a"  # what may stand before or after XML: marks, blanks, ends of text
_FIRST_ELEMENT = re.compile(
    r"(?>[\s\ufeff]+|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>)*+<([^\s/>!?]+)", re.DOTALL
)


def read_bytes(path: str | os.PathLike[str]) -> bytes:
    """Read a file of sane size.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If it is larger than 256 MiB.
    """
    size = Path(path).stat().st_size
    if size > MAX_BYTES:
        raise FileFormatError(os.fspath(path), f"at most {MAX_BYTES} bytes", f"{size}")
    return Path(path).read_bytes()


def read_text(path: str | os.PathLike[str]) -> str:
    """Read a text file.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If it is not text.
    """
    try:
        return read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileFormatError(
            os.fspath(path), "text", f"byte {error.object[error.start]:#x} at {error.start}"
        ) from None


def is_binary(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file holds zero bytes early on, but for those that pad its end, and is no UTF-16 or UTF-32.

    Raises:
        OSError: If it cannot be read.
    """
    with open(path, "rb") as file:
        head = file.read(4096)
    return b"\0" in head.rstrip(b"\0") and _encoding(head) == "utf-8"


def _encoding(data: bytes) -> str:
    """Tell the encoding of what may be text by its byte order mark, or by the zeros of its first character."""
    marked = next((name for mark, name in _BYTE_ORDER_MARKS if data.startswith(mark)), None)
    if marked or len(data) < 2 or (data[0] == 0) == (data[1] == 0):
        return marked or "utf-8"
    return "utf-16-le" if data[1] == 0 else "utf-16-be"


class DecodedText(NamedTuple):
    """A text file's text, and what was repaired to decode it."""

    text: str
    findings: tuple[Finding, ...] = ()


class XmlDocument(NamedTuple):
    """An XML file's root element, and what was repaired to parse it."""

    root: Element
    findings: tuple[Finding, ...] = ()


def read_any_text(path: str | os.PathLike[str]) -> DecodedText:
    r"""Read a text file in UTF-8, UTF-16 or UTF-32; one that is in none of them is taken for Windows-1252.

    Lines end with ``\n``, however they do in the file.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If it is larger than 256 MiB, or not text.
    """
    return decode_text(read_bytes(path), os.fspath(path))


def decode_text(data: bytes, where: str) -> DecodedText:
    """Decode bytes as `read_any_text` does.

    Raises:
        FileFormatError: If they are not text.
    """
    encoding, findings = _encoding(data), tuple[Finding, ...]()
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        if encoding != "utf-8" or b"\0" in data:
            wrong = f"byte {error.object[error.start]:#x} at {error.start}"
            raise FileFormatError(where, "text", wrong) from None
        text = data.decode("cp1252", "replace")
        findings = (Finding(where, "text that is not UTF-8: taken for Windows-1252"),)
    return DecodedText(text.replace("\r\n", "\n").replace("\r", "\n"), findings)


def read_xml(path: str | os.PathLike[str]) -> XmlDocument:
    """Parse an XML file with defusedxml, in any encoding, also if it is not the one that it declares.

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
            if mended is None:
                raise
            try:
                return XmlDocument(fromstring(mended.text), mended.findings)  # of text, it ignores the declaration
            except ParseError:
                raise error from None
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


def root_name(text: str) -> str:
    """Return the name, without namespace, of the first element of what may be XML, well-formed or not; or nothing."""
    found = _FIRST_ELEMENT.match(text)
    return found[1].rpartition(":")[2] if found else ""


def local_name(element: Element) -> str:
    """Return an element's name without its namespace."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
