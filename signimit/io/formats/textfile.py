"""Bounded reading of text and XML files from anywhere; nothing in them is expanded or fetched."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from signimit.exceptions import FileFormatError, MissingDependencyError

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

MAX_BYTES = 256 * 2**20


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


def read_xml(path: str | os.PathLike[str]) -> Element:
    """Parse an XML file with defusedxml and return its root.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If it is no well-formed XML, or declares entities.
        MissingDependencyError: If defusedxml is not installed.
    """
    try:
        from defusedxml.common import DefusedXmlException
        from defusedxml.ElementTree import ParseError, fromstring
    except ImportError:
        raise MissingDependencyError("defusedxml", "strokes", "Reading XML strokes") from None
    where = os.fspath(path)
    try:
        root: Element = fromstring(read_bytes(path))
    except ParseError as error:
        raise FileFormatError(where, "well-formed XML", str(error)) from None
    except DefusedXmlException as error:
        raise FileFormatError(where, "XML without entities", type(error).__name__) from None
    except (LookupError, ValueError) as error:
        raise FileFormatError(where, "XML in an encoding that exists", str(error)) from None
    return root


def local_name(element: Element) -> str:
    """Return an element's name without its namespace."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
