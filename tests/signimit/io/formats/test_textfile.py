"""Text and XML in whatever encoding, and what is none."""

from pathlib import Path

import pytest

from signimit import FileFormatError
from signimit.io.formats.textfile import is_binary, read_any_text, read_text, read_xml, root_name

WORDS = "dessiné à la main"
XML = f"<ink><annotation>{WORDS}</annotation></ink>"
DECLARED = '<?xml version="1.0" encoding="{}"?>\n' + XML


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


@pytest.mark.parametrize(
    "data",
    [
        XML.encode(),
        DECLARED.format("UTF-8").encode("utf-8-sig"),
        DECLARED.format("UTF-16").encode("utf-16"),
        DECLARED.format("UTF-16").encode("utf-16-le"),
        DECLARED.format("UTF-32").encode("utf-32"),
        DECLARED.format("ISO-8859-1").encode("latin-1"),
        DECLARED.format("windows-1252").encode("cp1252"),
        DECLARED.format("UTF-8").encode() + b"\r\n\x1a\0\0",
        b"\xef\xbb\xbf\r\n" + DECLARED.format("UTF-8").encode(),
    ],
)
def test_xml_in_a_sound_encoding_has_no_findings(tmp_path: Path, data: bytes) -> None:
    root, findings = read_xml(written(tmp_path, data))
    assert root[0].text == WORDS
    assert findings == ()


@pytest.mark.parametrize(
    ("data", "what"),
    [
        (XML.encode("latin-1"), "text that is not UTF-8"),
        (DECLARED.format("UTF-8").encode("latin-1"), "text that is not UTF-8"),
        (DECLARED.format("utf-16").encode(), "another encoding than it declares"),  # as .NET writes strings
        (DECLARED.format("utf-8").encode("utf-16"), "another encoding than it declares"),
    ],
)
def test_xml_in_another_encoding_than_it_says_is_read_and_reported(tmp_path: Path, data: bytes, what: str) -> None:
    root, findings = read_xml(written(tmp_path, data))
    assert root[0].text == WORDS
    assert [what in f.what for f in findings] == [True]


@pytest.mark.parametrize(
    ("name", "read"),
    [("R&D", "R&D"), ("a & b", "a & b"), ("&eacute;", "&eacute;"), ("a\x02b", "a\ufffdb"), ("&amp;&", "&&")],
)
def test_a_bad_character_does_not_cost_the_file(tmp_path: Path, name: str, read: str) -> None:
    root, findings = read_xml(written(tmp_path, f"<ink><annotation>{name}</annotation></ink>".encode()))
    assert root[0].text == read
    assert [(f.what, f.number) for f in findings] == [
        ("characters and ampersands that XML does not allow: replaced", 1)
    ]


def test_xml_in_encodings_of_several_bytes_a_character_is_read(tmp_path: Path) -> None:
    text = '<?xml version="1.0" encoding="Shift_JIS"?><ink>日本</ink>'
    assert read_xml(written(tmp_path, text.encode("shift_jis"))).root.text == "日本"


@pytest.mark.parametrize(
    ("data", "match"),
    [
        (XML.encode()[:-3], "expected well-formed XML, found unclosed token|no element found"),
        (b"<ink><trace></ink>", "expected well-formed XML, found mismatched tag"),
        (b"<ink>1 < 2 & 3</ink>", "expected well-formed XML, found not well-formed"),
        (b'<?xml version="1.0" encoding="martian"?><ink/>', "found unknown encoding"),
        (b'<?xml version="1.0" encoding="Shift_JIS"?><ink>\xff\xff</ink>', "expected XML in an encoding that exists"),
        (b'<!DOCTYPE ink [<!ENTITY a "\xe9">]><ink>&a;</ink>', "expected XML without entities"),
    ],
)
def test_broken_xml_is_refused_in_one_sentence(tmp_path: Path, data: bytes, match: str) -> None:
    with pytest.raises(FileFormatError, match=match):
        read_xml(written(tmp_path, data))


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("<ink/>", "ink"),
        (
            '\ufeff\n<?xml version="1.0"?>\n<!-- <svg> -->\n<!DOCTYPE ink [ <!ELEMENT a ANY> ]>\n<x:ink xmlns:x="y">',
            "ink",
        ),
        ("<Gesture Name='cut off", "Gesture"),
        (f"<!-- {'licence ' * 10_000} --><ink>", "ink"),
        ("<!-- never closed <ink>" * 5000, ""),
        ("about <ink> and <Gesture>", ""),
        ("", ""),
    ],
)
def test_the_first_element_is_found_however_late_it_stands(text: str, name: str) -> None:
    assert root_name(text) == name
