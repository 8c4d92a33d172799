"""Bounded reading of text files from anywhere, in whatever encoding."""

from __future__ import annotations

import codecs
import os
from pathlib import Path
from typing import NamedTuple

from signimit.exceptions import FileFormatError
from signimit.io.formats.import_report import Finding

MAX_BYTES = 256 * 2**20
_BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),  # before UTF-16, whose mark it begins with
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
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
