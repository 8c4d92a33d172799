"""Strokes read from files and whole folders, and the table of what is in a library."""

import sys
from pathlib import Path

import numpy as np
import pytest

from signimit import FileFormatError, MissingDependencyError, Stroke, StrokeLibrary, UnknownNameError
from signimit.io.formats import detect_format, inventory_table, read_strokes, write_inkml
from signimit.teaching.people import synthetic_library

UNIPEN = '.SEGMENT DIGIT 0 ? "6"\n.COMMENT 6 13 38\n.PEN_DOWN\n1 2\n3 4\n.PEN_UP\n'
DOLLAR = '<Gesture Name="star01" Subject="2"><Point X="0" Y="0" T="0"/><Point X="2" Y="0" T="10"/></Gesture>'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "deep").mkdir()
    (tmp_path / "b.txt").write_text(UNIPEN)
    (tmp_path / "deep" / "star01.xml").write_text(DOLLAR)
    (tmp_path / "README.md").write_text("about these files")
    (tmp_path / ".hidden.txt").write_text(UNIPEN)
    library = synthetic_library(["1"], samples=1, rng=np.random.default_rng(0))
    write_inkml(tmp_path / "c.inkml", library)
    library.save(tmp_path / "d.npz")
    np.savez(tmp_path / "foreign.npz", xy=np.zeros(3))
    return tmp_path


def test_a_folder_gives_all_it_holds_in_alphabetical_order(folder: Path) -> None:
    library = read_strokes([folder])
    assert library.labels == ("6", "1", "1", "star")
    assert library.writers == ("13", "synthetic 1", "synthetic 1", "2")
    assert library.source == "UNIPEN b.txt + InkML c.inkml + synthetic + $1 gesture logs"


def test_formats_are_told_by_content(folder: Path) -> None:
    files = ("b.txt", "deep/star01.xml", "c.inkml", "d.npz", "README.md", "foreign.npz")
    kinds = [detect_format(folder / name) for name in files]
    assert kinds == ["unipen", "dollar", "inkml", "library", None, None]


def test_a_format_named_leaves_the_others_of_a_folder(folder: Path) -> None:
    assert read_strokes([folder], "dollar").labels == ("star",)


def test_files_and_folders_mix(folder: Path) -> None:
    assert read_strokes([folder / "b.txt", folder / "deep"]).labels == ("6", "star")


def test_what_cannot_be_read_is_said(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"README.md: expected strokes as unipen, dollar, inkml, library"):
        read_strokes([folder / "README.md"])
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileFormatError, match="empty: expected files with strokes, found none"):
        read_strokes([tmp_path / "empty"])
    with pytest.raises(FileFormatError, match="no path: expected files with strokes, found none"):
        read_strokes([])
    with pytest.raises(FileNotFoundError):
        read_strokes([folder / "nowhere"])
    with pytest.raises(UnknownNameError, match="Unknown stroke format 'jpeg'; known are auto, unipen"):
        read_strokes([folder], "jpeg")


def test_xml_without_defusedxml_says_what_to_install(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.split(".")[0] == "defusedxml"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "defusedxml", None)
    with pytest.raises(MissingDependencyError, match=r"needs defusedxml: .*pip install 'signimit\[strokes\]'"):
        read_strokes([folder / "c.inkml"])
    assert read_strokes([folder / "b.txt"]).labels == ("6",)


def test_labels_are_rows_and_writers_columns_in_the_order_people_count() -> None:
    stroke = Stroke(np.array([(0, 0), (1, 1.0)]), np.array([0, 1.0]))
    library = StrokeLibrary((stroke,) * 4, ("star", "4", "star", "star"), ("13", "2", "2", "2"))
    assert inventory_table(library) == "label  2  13\n    4  1   0\n star  2   1"
