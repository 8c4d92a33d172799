"""XML in whatever encoding, with flaws and without."""

from pathlib import Path

import pytest

from signimit import FileFormatError
from signimit.io.formats import StrokeImportWarning, read_strokes
from signimit.io.formats.xmlfile import read_xml, root_name

WORDS = "dessiné à la main"
XML = f"<ink><annotation>{WORDS}</annotation></ink>"
DECLARED = '<?xml version="1.0" encoding="{}"?>\n' + XML


def written(tmp_path: Path, data: bytes) -> Path:
    path = tmp_path / "file"
    path.write_bytes(data)
    return path


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
    root, findings, _ = read_xml(written(tmp_path, data))
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
    root, findings, _ = read_xml(written(tmp_path, data))
    assert root[0].text == WORDS
    assert [what in f.what for f in findings] == [True]


@pytest.mark.parametrize(
    ("name", "read"),
    [("R&D", "R&D"), ("a & b", "a & b"), ("&eacute;", "&eacute;"), ("a\x02b", "a\ufffdb"), ("&amp;&", "&&")],
)
def test_a_bad_character_does_not_cost_the_file(tmp_path: Path, name: str, read: str) -> None:
    root, findings, _ = read_xml(written(tmp_path, f"<ink><annotation>{name}</annotation></ink>".encode()))
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


GROUP = '<traceGroup><annotation type="label">{}</annotation><trace>0 0, {} 1</trace></traceGroup>'
GESTURE = '<Gesture Name="{}"><Point X="0" Y="0" T="0"/><Point X="{}" Y="1" T="20"/></Gesture>'


@pytest.mark.parametrize(
    ("text", "labels"),
    [
        (f"<ink>{GROUP.format('a', 1)}{GROUP.format('b', 2)}{GROUP.format('c', 3)[:-20]}", ["a", "b"]),  # cut off
        (f"<ink>{GROUP.format('a', 1)}{GROUP.format('b', '2</trace')}{GROUP.format('c', 3)}</ink>", ["a"]),
        (
            f"<ink><traceGroup>{GROUP.format('a', 1)}{GROUP.format('b', 2)}<traceGroup><trace>0 0</traceGroup>",
            ["a", "b"],
        ),
        (f"<Gestures>{GESTURE.format('a', 1)}{GESTURE.format('b', 2)[:40]}", ["a"]),
        (f"{GESTURE.format('a', 1)}\n<?xml version='1.0'?>{GESTURE.format('b', 2)}", ["a"]),  # appended to
        (f"<ink>{GROUP.format('a', 1)}</ink> written by hand", ["a"]),
        (f"<!-- \xe9 --><Gestures>{GESTURE.format('a', 1)}{GESTURE.format('b', 2)[:40]}", ["a"]),
    ],
)
def test_drawings_before_the_flaw_of_a_broken_file_are_kept(tmp_path: Path, text: str, labels: list[str]) -> None:
    path = tmp_path / "broken.xml"
    path.write_text(text, encoding="latin-1")
    with pytest.warns(
        StrokeImportWarning, match=r"1 left out; the first: .*broken\.xml: expected well-formed XML to the"
    ):
        assert read_strokes(path).labels == tuple(labels)
    with pytest.raises(FileFormatError, match=r"broken\.xml: expected well-formed XML to the end"):
        read_strokes(path, strict=True)


@pytest.mark.parametrize(
    "text",
    [
        "<ink><trace>0 0, 1 1</trace><trace>1 1, 2",  # one drawing, not whole
        f"<ink>{GROUP.format('a', 1)[:-20]}",
        f"{GESTURE.format('a', 1)[:-20]}",
        "<ink><trace xml:id='a'>0 0, 1 1</trace><trace xml:id='b'>3 3, 4 4</trace><traceGroup><traceView "
        "traceDataRef='#a'/></traceGroup><traceGroup><traceView traceDat",  # trace b would seem to be in no group
    ],
)
def test_what_is_not_whole_is_not_taken_for_a_drawing(tmp_path: Path, text: str) -> None:
    path = tmp_path / "broken.xml"
    path.write_text(text)
    with pytest.raises(FileFormatError, match="expected well-formed XML, found"):
        read_strokes(path)
