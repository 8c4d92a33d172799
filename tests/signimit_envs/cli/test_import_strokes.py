"""The import program: reads, writes a whole file, prints what it found, complains in one line."""

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("tyro", reason="commands need signimit[scripts]")

from signimit import StrokeLibrary
from signimit.io.formats import read_inkml

UNIPEN = """.SEGMENT DIGIT 0 ? "6"
.COMMENT 6 13 38
.PEN_DOWN
1 2
3 4
.PEN_UP
.SEGMENT DIGIT 1 ? "6"
.COMMENT 6 4 39
.PEN_DOWN
1 2
3 9
.PEN_UP
"""


@pytest.fixture
def digits(tmp_path: Path) -> Path:
    path = tmp_path / "digits.txt"
    path.write_text(UNIPEN)
    return path


def test_it_writes_a_library_and_prints_labels_against_writers(run: Any, digits: Path, tmp_path: Path) -> None:
    out = tmp_path / "library.npz"
    said = run("import-strokes", digits, "--out", out, "--rename", "6", "six", "--mirror", "six", "flipped")
    assert [line.split() for line in said.splitlines()[:3]] == [
        ["label", "4", "13"],
        ["flipped", "1", "1"],
        ["six", "1", "1"],
    ]
    library = StrokeLibrary.load(out)
    assert library.labels == ("six", "six", "flipped", "flipped")


def test_it_keeps_the_writers_asked_for_and_writes_inkml(run: Any, digits: Path, tmp_path: Path) -> None:
    out = tmp_path / "library.inkml"
    run("import-strokes", digits, "--out", out, "--writer", "4", "--label", "6")
    assert read_inkml(out).writers == ("4",)


def test_a_bad_drawing_is_left_out_named_and_told_by_the_exit_code(run: Any, digits: Path, tmp_path: Path) -> None:
    digits.write_text(UNIPEN.replace("3 9", "3 nine"))
    out = tmp_path / "library.npz"
    said = run.incomplete("import-strokes", digits, "--out", out)
    assert f"left out: {digits}: line 11: expected two numbers, found '3 nine'.\n" in said
    assert StrokeLibrary.load(out).writers == ("13",)


def test_strict_gives_one_sentence_and_no_output_file(run: Any, digits: Path, tmp_path: Path) -> None:
    digits.write_text(UNIPEN.replace("3 9", "3 nine"))
    said = run.refusal("import-strokes", digits, "--strict", "--out", tmp_path / "library.npz")
    assert said == f"import-strokes: {digits}: line 11: expected two numbers, found '3 nine'.\n"
    assert [p.name for p in tmp_path.iterdir()] == ["digits.txt"]


def test_a_file_with_no_drawing_gives_one_sentence_and_no_output_file(run: Any, digits: Path, tmp_path: Path) -> None:
    digits.write_text(UNIPEN.replace("3 9", "3 nine").replace("3 4", "3 for"))
    said = run.refusal("import-strokes", digits, "--out", tmp_path / "library.npz")
    assert said.startswith(f"import-strokes: {digits}: expected files with strokes, found none (drawings: 0 read, 0 of")
    assert said.endswith(f"2 left out; the first: {digits}: line 5: expected two numbers, found '3 for').\n")
    assert [p.name for p in tmp_path.iterdir()] == ["digits.txt"]


def test_the_table_says_what_became_of_every_file_and_what_was_assumed(run: Any, digits: Path, tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("about these files: .SEGMENT\n")
    said = run("import-strokes", tmp_path, "--out", tmp_path / "library.npz").splitlines()
    rows = {line[:13].strip(): line.split()[-2:] for line in said if line[:13].strip() in ("read", "not a drawing")}
    assert rows == {"read": ["1", "2"], "not a drawing": ["1", "0"]}
    assert "assumed: no time stamps: points taken to be 10 ms apart (2 in 2 places)" in said


def test_the_suffix_decides_in_any_case_and_an_unknown_one_is_refused(run: Any, digits: Path, tmp_path: Path) -> None:
    run("import-strokes", digits, "--out", tmp_path / "a.InkML")
    assert len(read_inkml(tmp_path / "a.InkML")) == 2
    run("import-strokes", digits, "--out", tmp_path / "a.NPZ")
    assert len(StrokeLibrary.load(tmp_path / "a.NPZ")) == 2
    said = run.refusal("import-strokes", digits, "--out", tmp_path / "q.csv")
    assert said == "import-strokes: Unknown suffix of --out '.csv'; known are .npz, .inkml.\n"
    assert not (tmp_path / "q.csv").exists()
