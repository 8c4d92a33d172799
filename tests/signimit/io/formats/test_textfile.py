"""Text in whatever encoding, and what is none."""

from pathlib import Path

import pytest

from signimit import FileFormatError
from signimit.io.formats.textfile import is_binary, read_any_text, read_text

WORDS = "dessiné à la main"


def written(tmp_path: Path, data: bytes) -> Path:
    path = tmp_path / "file"
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32"])
def test_unicode_is_read_as_it_is_with_or_without_a_mark(tmp_path: Path, encoding: str) -> None:
    path = written(tmp_path, WORDS.encode(encoding))
    assert read_any_text(path) == (WORDS, ())
    assert not is_binary(path)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])  # of Unix, of Windows, of the Macs that UNIPEN was made on
def test_lines_end_as_they_do_in_python(tmp_path: Path, end: str) -> None:
    assert (
        read_any_text(written(tmp_path, f".SEGMENT{end}.PEN_DOWN{end}1 2".encode())).text == ".SEGMENT\n.PEN_DOWN\n1 2"
    )


def test_text_of_windows_is_read_and_reported(tmp_path: Path) -> None:
    path = written(tmp_path, f"{WORDS} \N{EURO SIGN}".encode("cp1252"))
    text, findings = read_any_text(path)
    assert text == f"{WORDS} \N{EURO SIGN}"
    assert [(f.where, f.what) for f in findings] == [(str(path), "text that is not UTF-8: taken for Windows-1252")]
    with pytest.raises(FileFormatError, match="expected text, found byte 0xe9 at 6"):
        read_text(path)  # tables are held to UTF-8


@pytest.mark.parametrize(
    "data", [b"\x00\x01\x02\x03\x04", b"MZ\x90\x00\x03\x00", "\U0001f600".encode("utf-16")[:5] + b"\0"]
)
def test_what_is_no_text_is_refused(tmp_path: Path, data: bytes) -> None:
    with pytest.raises(FileFormatError, match="expected text"):
        read_any_text(written(tmp_path, data))


def test_zeros_early_on_make_a_file_binary_but_not_those_that_pad_its_end(tmp_path: Path) -> None:
    assert is_binary(written(tmp_path, b"\x89PNG\r\n\0\0more"))
    assert not is_binary(written(tmp_path, b".VERSION 1.0\n" + bytes(100)))
