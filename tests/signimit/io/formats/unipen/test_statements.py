"""Statements of UNIPEN text, what they include, and what tells such text from others."""

from itertools import pairwise
from pathlib import Path

import pytest

from signimit import FileFormatError
from signimit.io.formats.unipen import statements
from signimit.io.formats.unipen.statements import Statement, StatementReader, is_unipen


def read_all(path: Path) -> tuple[list[Statement], StatementReader]:
    reader = StatementReader(str(path))
    return list(reader.read(path.read_text())), reader


def written(folder: Path, **texts: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / f"{name}.dat").write_text(text)
    return folder / "a.dat"


def test_a_statement_goes_up_to_the_next_keyword_in_the_first_column(tmp_path: Path) -> None:
    text = "junk\n.COMMENT one\n  .PEN_DOWN is not one\n.5 nor is this\n.lower nor this\n.PEN_DOWN\n1 2\n.PEN_UP"
    path = written(tmp_path, a=text)
    assert read_all(path)[0] == [
        Statement("COMMENT", " one\n  .PEN_DOWN is not one\n.5 nor is this\n.lower nor this\n", str(path), 2),
        Statement("PEN_DOWN", "\n1 2\n", str(path), 6),
        Statement("PEN_UP", "", str(path), 8),
    ]
    assert read_all(path)[0][1].where == f"{path}: line 6"


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_lines_end_as_on_any_system(tmp_path: Path, end: str) -> None:
    text = ".PEN_DOWN\n1 2\n.PEN_UP\n"
    reader = StatementReader(str(tmp_path / "a.dat"))
    assert list(reader.read(text.replace("\n", end))) == list(reader.read(text))


def test_an_included_file_stands_where_it_is_named(tmp_path: Path) -> None:
    path = written(tmp_path, a=".VERSION 1.0\n.INCLUDE deep/b.dat\n.PEN_UP\n")
    written(tmp_path / "deep", b='.COORD X Y\n.INCLUDE "c.dat" \n\n# a remark\n', c=".PEN_DOWN\n1 2\n")
    found, reader = read_all(path)
    assert [(s.keyword, Path(s.path).name, s.line) for s in found] == [
        ("VERSION", "a.dat", 1),
        ("COORD", "b.dat", 1),
        ("PEN_DOWN", "c.dat", 1),
        ("PEN_UP", "a.dat", 3),
    ]
    assert [included.name for included in reader.included] == ["b.dat", "c.dat"]
    assert reader.findings == []


def test_an_included_file_may_name_others_from_the_folder_of_the_first(tmp_path: Path) -> None:
    path = written(tmp_path, a=".INCLUDE deep\\b.dat\n", c=".PEN_UP\n")
    written(tmp_path / "deep", b=".INCLUDE c.dat\n")
    assert [s.keyword for s in read_all(path)[0]] == ["PEN_UP"]


def test_the_include_folder_of_train_r01_v07_is_found(tmp_path: Path) -> None:
    path = written(tmp_path / "data" / "1a" / "kai", a=".INCLUDE kai/kai0.dat\n")
    written(tmp_path / "include" / "kai", kai0=".COORD X Y\n")
    assert [s.keyword for s in read_all(path)[0]] == ["COORD"]


OUTSIDE = ("../secret.dat", "in/../../secret.dat", "{0}/secret.dat", "link.dat", "links/secret.dat", "C:\\secret.dat",
           "\\\\host\\secret.dat", "", "a\0b", "x" * 5000)  # fmt: skip


@pytest.mark.parametrize("name", OUTSIDE)
def test_nothing_outside_the_folder_is_read(tmp_path: Path, name: str) -> None:
    written(tmp_path, secret=".PEN_DOWN\n1 2\n")
    path = written(tmp_path / "in", a=f".INCLUDE {name.format(tmp_path)}\n.PEN_UP\n")
    (tmp_path / "in" / "link.dat").symlink_to(tmp_path / "secret.dat")
    (tmp_path / "in" / "links").symlink_to(tmp_path)
    found, reader = read_all(path)
    assert [s.keyword for s in found] == ["PEN_UP"]
    assert reader.included == []
    assert [(f.where, f.what, f.kind) for f in reader.findings] == [
        (f"{path}: line 1", ".INCLUDE of a file outside the folder, which is not read", "repaired")
    ]


def test_a_file_that_is_not_there_is_noted(tmp_path: Path) -> None:
    reader = read_all(written(tmp_path, a=".INCLUDE dene.doc\n"))[1]
    assert [(f.what, f.kind) for f in reader.findings] == [(".INCLUDE of a file that is not there", "assumed")]


def test_files_that_include_each_other_are_read_once(tmp_path: Path) -> None:
    path = written(tmp_path, a=".INCLUDE b.dat\n.PEN_UP\n", b=".PEN_DOWN\n1 2\n.INCLUDE a.dat\n.INCLUDE b.dat\n")
    found, reader = read_all(path)
    assert [s.keyword for s in found] == ["PEN_DOWN", "PEN_UP"]
    assert [f.what for f in reader.findings] == [".INCLUDE of a file by itself, which is passed over"] * 2


def test_what_would_never_end_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    names = [f"f{i}" for i in range(30)]
    chain = {name: f".INCLUDE {after}.dat\n" for name, after in zip(names, [*names[1:], "end"], strict=True)}
    path = written(tmp_path, a=".INCLUDE f0.dat\n", end=".PEN_UP\n", **chain)
    with pytest.raises(FileFormatError, match="files that include each other 20 deep, found deeper"):
        read_all(path)
    doubling = {name: f".INCLUDE {after}.dat\n" * 2 for name, after in pairwise(names[:13])}
    with pytest.raises(
        FileFormatError, match=r"at most 1000 .INCLUDE statements, with those of included files, found more"
    ):
        read_all(written(tmp_path, f12=".PEN_UP\n", **doubling))
    monkeypatch.setattr(statements, "MAX_BYTES", 100)
    with pytest.raises(FileFormatError, match="at most 100 characters, with those of included files"):
        read_all(written(tmp_path, a=".INCLUDE b.dat\n" * 3, b=".PEN_UP\n" * 6))
    monkeypatch.setattr(statements, "MOST_STATEMENTS", 5)
    with pytest.raises(FileFormatError, match="at most 5 statements"):
        read_all(written(tmp_path, a=".PEN_UP\n" * 6))


UNIPEN = '.VERSION 1.0\n.COORD X Y\n.SEGMENT CHARACTER 0 OK "a"\n.PEN_DOWN\n1 2\n3 4\n.PEN_UP\n'


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        (UNIPEN, True),
        ("\n\n" + UNIPEN, True),
        (UNIPEN.replace("\n", "\r\n"), True),
        (".COMMENT " + "word " * 5000 + "\n" + UNIPEN, True),
        (".PEN_DOWN\n1 2\n3 4\n", True),
        ('.INCLUDE data/x.dat\n.SEGMENT WORD 0-3 ? "word"\n', True),
        ("", False),
        ("These files begin with .VERSION and have\n" + UNIPEN, False),
        ("# Format\n\n```\n" + UNIPEN + "```\n", False),
        (".VERSION 1.0\n.COORD X Y\n.HIERARCHY WORD\n", False),
        (".SUFFIXES: .c .o\n.SEGMENT\n", False),
    ],
)
def test_unipen_begins_with_a_keyword_and_has_something_drawn(text: str, is_one: bool) -> None:
    assert is_unipen(text) is is_one
