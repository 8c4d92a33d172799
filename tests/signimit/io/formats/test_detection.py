"""What a file is, told by what it holds."""

from pathlib import Path

import numpy as np
import pytest

from signimit.io.archive import write_archive
from signimit.io.formats import detect_format
from signimit.io.formats.detection import is_library
from signimit.teaching.people import synthetic_library

UNIPEN = '.SEGMENT DIGIT 0 ? "6"\n.PEN_DOWN\n1 2\n3 4\n.PEN_UP\n'
DOLLAR = '<Gesture Name="star01"><Point X="0" Y="0" T="0"/><Point X="2" Y="0" T="10"/></Gesture>'
INKML = "<ink><trace>0 0, 1 1</trace></ink>"
LONG = "words " * 5000  # beyond any first block


@pytest.mark.parametrize(
    ("name", "content", "format"),
    [
        ("a.dat", UNIPEN, "unipen"),
        ("a.dat", f".VERSION 1.0\n.COMMENT {LONG}\n{UNIPEN}", "unipen"),
        ("a.xml", f"<!-- {LONG} -->{DOLLAR}", "dollar"),
        ("a.xml", f"<!-- {LONG} -->{INKML}", "inkml"),
        ("a.txt", DOLLAR, "dollar"),
        ("a.xml", f"<Gestures>{DOLLAR}{DOLLAR}</Gestures>", "dollar"),
        ("a.xml", DOLLAR[:30], "dollar"),  # cut off: broken, but no other thing
        ("a.xml", f'<x:ink xmlns:x="http://www.w3.org/2003/InkML">{INKML}</x:ink>', "inkml"),
        ("a.InkML", "", "inkml"),
        ("a.xml", "<?xml version='1.0'?><Gesture Na", "dollar"),  # cut off before the first point
        ("README", "<Gesture> is the first element of a log, <ink> that of InkML.\n", None),
        ("README", "<ink> holds <trace> elements of numbers.\n", None),
        ("empty.txt", "<ink></ink>", "inkml"),  # well-formed, if without ink
        ("README.md", f"# Files\nThey hold `<Gesture>` or <ink> and .SEGMENT:\n\n{UNIPEN}", None),
        ("README.md", f"# Files\n```xml\n{DOLLAR}\n```\n", None),
        ("index.html", f"<html><body><pre>{DOLLAR}<br></pre></body></html>", None),  # not well-formed
        ("picture.svg", '<svg xmlns="http://www.w3.org/2000/svg"><ink/></svg>', None),
        (
            "touch.gml",
            '<GestureMarkupLanguage><Gesture id="tap"><Point X="1"/></Gesture></GestureMarkupLanguage>',
            None,
        ),
        ("page.1", ".TH PEN 1\n.SH NAME\npen\n", None),
        ("empty.txt", "", None),
    ],
)
def test_a_file_is_what_it_holds(tmp_path: Path, name: str, content: str, format: str | None) -> None:
    path = tmp_path / name
    for encoding in ("utf-8", "utf-16"):
        path.write_text(content, encoding=encoding)
        assert detect_format(path) == format


def test_libraries_are_told_from_other_archives_and_known_if_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "library.npz"
    synthetic_library(["1"], samples=1, rng=np.random.default_rng(0)).save(path)
    assert is_library(path)
    path.write_bytes(path.read_bytes()[:200])
    assert detect_format(path) == "library"
    write_archive(path, "stroke library", 99, {})
    assert detect_format(path) == "library"
    no_text = np.array([0x110000], np.uint32).view("U1")  # beyond Unicode
    write_archive(path, "stroke library", 1, {"labels": no_text})
    assert detect_format(path) == "library"
    np.savez(path, xy=np.zeros(3))
    assert detect_format(path) is None
    write_archive(path, "demonstrations", 1, {})
    assert detect_format(path) is None


def test_pictures_are_nothing(tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    path.write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)))
    assert detect_format(path) is None
