"""UNIPEN text as UCI distributes it."""

import os
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from signimit import FileFormatError
from signimit.io.formats import read_unipen

GOOD = """.INCLUDE        dene.doc

.LEXICON "0" "1" "2"
.HIERARCHY      DIGIT

.SEGMENT DIGIT   30 ? "6"
.COMMENT 6 13   38
.PEN_DOWN
 238  326
 239  328
 240  329
.PEN_UP
.DT 100

.SEGMENT DIGIT  112-113 ? "7"
.COMMENT 7 13  187
.PEN_DOWN
 0  0
 10 0
.PEN_UP
.DT 100
.PEN_DOWN
 10 20
 20 20
.PEN_UP
.DT 100
"""


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "digits.txt"
    path.write_text(text)
    return path


def test_labels_writers_points_and_times(tmp_path: Path) -> None:
    library = read_unipen(written(tmp_path, GOOD))
    assert library.labels == ("6", "7")
    assert library.writers == ("13", "13")
    assert library.source == "UNIPEN digits.txt"
    assert_allclose(library[0].points, [(238, 326), (239, 328), (240, 329)])
    assert_allclose(library[0].times, [0, 0.01, 0.02])
    assert_allclose(library[1].points, [(0, 0), (10, 0), (10, 10), (10, 20), (20, 20)])


def test_a_writer_id_names_the_writer_where_there_is_no_comment(tmp_path: Path) -> None:
    text = '.WRITER_ID ann\n.SEGMENT DIGIT 0 OK "1"\n.COMMENT a free remark\n.PEN_DOWN\n1 2\n3 4\n.PEN_UP\n'
    assert read_unipen(written(tmp_path, text)).writers == ("ann",)


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        (GOOD, "", r"UNIPEN text"),
        ("239  328", "239", r"line 10: expected two numbers, found '239'"),
        ("239  328", "239 abc", r"line 10: expected two numbers"),
        ("239  328", "239 nan", r"line 6: points: expected finite numbers"),
        (' ? "6"', "", r"line 6: expected .SEGMENT level first-last quality"),
        ("112-113", "112-114", r"line 15: expected 3 pen-down pieces of '7', found 2"),
        ('.SEGMENT DIGIT   30 ? "6"\n', "", r"line 7: expected .SEGMENT before the first .PEN_DOWN, found none"),
        (" 240  329\n.PEN_UP\n", " 240  329\n.PEN_DOWN\n", r"line 12: expected .PEN_UP before the next .PEN_DOWN"),
        (" 240  329\n.PEN_UP\n", " 240  329\n", r"line 14: expected .PEN_UP before the next .SEGMENT, found none"),
        ("112-113", "112-" + "1" * 5000, r"line 15: expected .SEGMENT level"),
        (" 238  326\n 239  328\n 240  329\n", "", r"line 6: points: expected at least 2, found none"),
        (" 20 20\n.PEN_UP\n.DT 100\n", " 20 20\n", r".PEN_UP after the last .PEN_DOWN, found the end"),
    ],
)
def test_broken_files_name_the_line(tmp_path: Path, old: str, new: str, match: str) -> None:
    assert old in GOOD
    path = written(tmp_path, GOOD.replace(old, new))
    with pytest.raises(FileFormatError, match=match) as caught:
        read_unipen(path, strict=True)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_bytes_that_are_no_text_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "digits.txt"
    path.write_bytes(b".SEGMENT\xff\xfe\x00")
    with pytest.raises(FileFormatError, match="expected text, found byte 0xff at 8"):
        read_unipen(path)


@pytest.mark.parametrize("cut", range(150, len(GOOD), 37))
def test_a_truncated_file_is_refused_or_gives_whole_digits(tmp_path: Path, cut: int) -> None:
    try:
        library = read_unipen(written(tmp_path, GOOD[:cut]))
    except FileFormatError:
        return
    assert set(library.labels) <= {"6", "7"}


def test_the_files_of_a_real_person_give_the_points_of_the_data_set() -> None:
    data = Path(os.environ.get("SIGNIMIT_DATA", Path(__file__).parents[5] / "shared" / "data"))
    if not (data / "digits_pen.npz").exists():
        pytest.skip("needs the real strokes, see SIGNIMIT_DATA")
    library = read_unipen(data / "raw" / "pendigits-orig.writer13.txt")
    known = dict(np.load(data / "digits_pen.npz"))
    numbers = np.flatnonzero(known["writer"] == 13)
    assert len(library) == len(numbers) == 250
    assert library.labels == tuple(str(label) for label in known["label"][numbers])
    for stroke, number in zip(library, numbers, strict=True):
        points = known["xy"][known["offsets"][number] : known["offsets"][number + 1]]
        if known["n_strokes"][number] == 1:
            assert_allclose(stroke.points, points)
        else:
            assert {tuple(p) for p in points.tolist()} <= {tuple(p) for p in stroke.points.tolist()}
