"""Strokes read from files and whole folders, and the table of what is in a library."""

import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from signimit import FileFormatError, MissingDependencyError, Stroke, StrokeLibrary, UnknownNameError
from signimit.io.formats import (
    StrokeImportWarning,
    detect_format,
    import_strokes,
    inventory_table,
    read_strokes,
    write_inkml,
)
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


def test_one_path_needs_no_list(folder: Path) -> None:
    assert read_strokes(folder / "b.txt").labels == ("6",)
    assert read_strokes(str(folder / "deep")).labels == ("star",)


def test_every_file_of_a_folder_is_accounted_for(folder: Path) -> None:
    (folder / "broken.inkml").write_text("<ink><trace>0 0, 1")
    (folder / "dots.txt").write_text(UNIPEN + UNIPEN.replace("3 4\n", ""))
    (folder / "jitter.xml").write_text(DOLLAR.replace("</G", '<Point X="4" Y="0" T="9"/></G'))
    (folder / "lost.xml").symlink_to(folder / "nowhere")
    (folder / "full_disk.xml").touch()
    os.mkfifo(folder / "pipe")
    library, report = import_strokes(folder)
    assert library.labels == ("6", "1", "1", "star", "6", "star")
    assert {str(file.path.relative_to(folder)): file.status for file in report.files} == {
        ".hidden.txt": "hidden",
        "README.md": "not a drawing",
        "b.txt": "read",
        "broken.inkml": "left out",
        "c.inkml": "read",
        "d.npz": "read",
        "deep/star01.xml": "read",
        "dots.txt": "left out",
        "foreign.npz": "not a drawing",
        "full_disk.xml": "empty",
        "jitter.xml": "repaired",
        "lost.xml": "left out",
        "pipe": "not a drawing",
    }
    lines = report.table().splitlines()
    assert [line.split() for line in lines[:4]] == [
        ["files", "drawings"],
        ["read", "4", "5"],
        ["repaired", "1", "1"],
        ["left", "out", "3", "3"],
    ]
    assert (
        f"left out: {folder / 'lost.xml'}: expected a file that can be read, found No such file or directory." in lines
    )


def test_marks_far_into_a_file_and_utf_16_are_not_passed_over(tmp_path: Path) -> None:
    (tmp_path / "a.dat").write_text(f".VERSION 1.0\n.COMMENT {'words ' * 2000}\n{UNIPEN}")
    (tmp_path / "b.xml").write_text(f"<!-- {'licence ' * 2000} -->{DOLLAR}")
    (tmp_path / "c.xml").write_text(DOLLAR, encoding="utf-16")
    (tmp_path / "README.txt").write_text("each file has a <Gesture, or a <ink, or a .SEGMENT\n")
    assert read_strokes(tmp_path).labels == ("6", "star", "star")


def test_a_broken_drawing_stops_nothing_unless_strict(folder: Path) -> None:
    (folder / "broken.xml").write_text(DOLLAR[:50])
    with pytest.warns(StrokeImportWarning, match=r"drawings: 4 read, 0 of them repaired, 1 left out; the first: .*xml"):
        assert len(read_strokes(folder)) == 4
    for paths in (folder, [folder / "b.txt", folder / "broken.xml"]):
        with pytest.raises(FileFormatError, match=r"broken\.xml: expected well-formed XML"):
            read_strokes(paths, strict=True)
    with pytest.warns(StrokeImportWarning, match="1 left out"):
        assert read_strokes([folder / "b.txt", folder / "README.md"]).labels == ("6",)


def test_a_file_that_another_one_includes_is_read_once(tmp_path: Path) -> None:
    segment, pen_data = UNIPEN.splitlines(keepends=True)[0], "".join(UNIPEN.splitlines(keepends=True)[2:])
    (tmp_path / "b.dat").write_text(f".VERSION 1.0\n.COORD X Y\n{segment}.INCLUDE a.dat\n")
    (tmp_path / "a.dat").write_text(pen_data)
    library, report = import_strokes(tmp_path)
    assert library.labels == ("6",)
    assert [file.status for file in report.files] == ["read with another", "read"]


def test_a_library_of_many_files_names_a_few_of_them(tmp_path: Path) -> None:
    for number in range(8):
        (tmp_path / f"{number}.txt").write_text(UNIPEN)
    assert read_strokes(tmp_path).source.endswith("UNIPEN 3.txt + UNIPEN 4.txt + 3 more")


def test_files_and_folders_mix(folder: Path) -> None:
    assert read_strokes([folder / "b.txt", folder / "deep"]).labels == ("6", "star")


def test_what_cannot_be_read_is_said(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"README.md: expected strokes as unipen, dollar, inkml, library"):
        read_strokes([folder / "README.md"])
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileFormatError, match="empty: expected files with strokes, found none"):
        read_strokes([tmp_path / "empty"])
    for name in ("a.xml", "b.xml"):
        (tmp_path / "empty" / name).write_text("<Gesture>")
    found = (
        r"empty: expected files with strokes, found none \(drawings: 0 read, 0 of them repaired, 2 left out; .*a\.xml"
    )
    with pytest.raises(FileFormatError, match=found):
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


def test_the_program_of_the_docs_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = Path(__file__).parents[4] / "docs" / "strokes.md"
    if not page.is_file():
        pytest.skip("the docs are not beside these tests")
    monkeypatch.chdir(tmp_path)
    for block in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL):
        exec(block, {})
    assert capsys.readouterr().out.splitlines() == [
        "StrokeLibrary(1 stroke, 1 label, 1 writer, source='$1 gesture logs')",
        "arc01.xml repaired ['time stamps that step back by 16 ms or less: lifted to the one before']",
        "dot01.xml left out [] dot01.xml: stroke points: expected at least 2 points, found 1.",
    ]


def test_labels_are_rows_and_writers_columns_in_the_order_people_count() -> None:
    stroke = Stroke(np.array([(0, 0), (1, 1.0)]), np.array([0, 1.0]))
    library = StrokeLibrary((stroke,) * 4, ("star", "4", "star", "star"), ("13", "2", "2", "2"))
    assert inventory_table(library) == "label  2  13\n    4  1   0\n star  2   1"
