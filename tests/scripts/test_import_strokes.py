"""The import program: reads, writes a whole file, prints what it found, complains in one line."""

import subprocess
import sys
from pathlib import Path

import pytest

from signimit import StrokeLibrary
from signimit.io.formats import read_inkml

SCRIPT = Path(__file__).parents[2] / "scripts" / "import_strokes.py"
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


def run(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True, text=True, check=False)


@pytest.fixture
def digits(tmp_path: Path) -> Path:
    path = tmp_path / "digits.txt"
    path.write_text(UNIPEN)
    return path


def test_it_writes_a_library_and_prints_labels_against_writers(digits: Path, tmp_path: Path) -> None:
    out = tmp_path / "library.npz"
    done = run(digits, "--out", out, "--rename", "6", "six", "--mirror", "six", "flipped")
    assert done.returncode == 0, done.stderr
    assert [line.split() for line in done.stdout.splitlines()[:3]] == [
        ["label", "4", "13"],
        ["flipped", "1", "1"],
        ["six", "1", "1"],
    ]
    library = StrokeLibrary.load(out)
    assert library.labels == ("six", "six", "flipped", "flipped")


def test_it_keeps_the_writers_asked_for_and_writes_inkml(digits: Path, tmp_path: Path) -> None:
    out = tmp_path / "library.inkml"
    done = run(digits, "--out", out, "--writer", "4", "--label", "6")
    assert done.returncode == 0, done.stderr
    assert read_inkml(out).writers == ("4",)


def test_a_broken_file_gives_one_sentence_and_no_output_file(digits: Path, tmp_path: Path) -> None:
    digits.write_text(UNIPEN.replace("3 9", "3 nine"))
    done = run(digits, "--out", tmp_path / "library.npz")
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr == f"import_strokes: {digits}: line 11: expected two numbers, found '3 nine'.\n"
    assert [p.name for p in tmp_path.iterdir()] == ["digits.txt"]
