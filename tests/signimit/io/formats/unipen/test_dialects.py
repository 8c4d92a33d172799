"""UNIPEN text as it is found: UCI's pendigits, lipitk, and contributions to train_r01_v07."""

import os
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from signimit import FileFormatError
from signimit.io.formats import import_strokes
from signimit.io.formats.import_report import StrokeImportWarning
from signimit.io.formats.unipen import parse_unipen, read_unipen

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
        ("112-113", "112-114", r"line 15: expected 3 components of '7' after .SEGMENT, found 2"),
        ("112-113", "112-" + "1" * 5000, r"line 15: expected .SEGMENT level"),
        (" 238  326\n 239  328\n 240  329\n", "", r"line 6: expected 1 component of '6' after .SEGMENT, found none"),
        (" 20 20\n.PEN_UP\n.DT 100\n", " 20 20\n", r".PEN_UP after the last .PEN_DOWN, found the end"),
    ],
)
def test_strictness_names_the_line_of_the_first_flaw(tmp_path: Path, old: str, new: str, match: str) -> None:
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
        pen_file = parse_unipen(GOOD[:cut], tmp_path / "digits.txt")
    except FileFormatError:
        return
    sizes = {(recording.label, *map(len, recording.pieces)) for recording in pen_file.recordings}
    assert sizes <= {("6", 3), ("7", 2, 2)}


@pytest.mark.parametrize(
    "text",
    [
        GOOD.replace(" 240  329\n.PEN_UP\n", " 240  329\n"),
        GOOD.replace(" 240  329\n.PEN_UP\n", " 240  329\n.PEN_DOWN\n"),
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("DIGIT  112-113", "DIGIT\t112 - 113").replace(" ? ", " BAD "),
        GOOD.replace(".COMMENT 6 13   38", ".WRITER_ID 13\n.COMMENT Ren\xe9 wrote it\n5 o'clock"),
        GOOD.replace("30 ?", "0 ?").replace("112-113", "1-2"),
    ],
)
def test_what_means_the_same_reads_the_same(tmp_path: Path, text: str) -> None:
    path = tmp_path / "digits.txt"
    path.write_bytes(text.encode())
    library, expected = read_unipen(path), read_unipen(written(tmp_path, GOOD))
    assert (library.labels, library.writers) == (expected.labels, expected.writers)
    for stroke, other in zip(library, expected, strict=True):
        assert_allclose(stroke.points, other.points)
        assert_allclose(stroke.times, other.times)


def test_accents_of_another_encoding_are_read(tmp_path: Path) -> None:
    path = tmp_path / "digits.txt"
    path.write_bytes(GOOD.replace(".LEXICON", ".WRITER_ID Ren\xe9\n.LEXICON").encode("latin-1"))
    with pytest.warns(StrokeImportWarning, match="drawings: 2 read"):
        assert read_unipen(path).labels == ("6", "7")


def test_a_bad_drawing_is_left_out_and_named(tmp_path: Path) -> None:
    path = written(tmp_path, GOOD.replace("239  328", "239"))
    with pytest.warns(StrokeImportWarning, match=r"line 10: expected two numbers, found '239'"):
        assert read_unipen(path).labels == ("7",)


LIPITK = """.VERSION 1.0 0
.HIERARCHY CHARACTER
.COORD X Y T
.SEGMENT CHARACTER
.X_POINTS_PER_INCH 2500
.Y_POINTS_PER_INCH 2500
.POINTS_PER_SECOND 1200

.WRITER_ID 4
.SEX MALE
.COUNTRY
.WRITER_INFO
 WriterName:SOMEBODY
 WritingSetup:TABLETPC
.PEN_DOWN
10 10 8000
20 10 0
30 10 8020
.PEN_UP
.PEN_DOWN
50 10 8100
60 10 8110
.PEN_UP
"""


def test_lipitk_writes_one_segment_without_label_and_few_stamps(tmp_path: Path) -> None:
    path = written(tmp_path, LIPITK)
    (recording,) = parse_unipen(LIPITK, path).recordings
    assert (recording.label, recording.writer, recording.where) == ("digits", "4", f"{path}: line 4")
    library = read_unipen(path)
    assert library[0].points.tolist() == [[10, 10], [20, 10], [30, 10], [40, 10], [50, 10], [60, 10]]
    assert_allclose(library[0].times, [0, 0.01, 0.02, 0.06, 0.1, 0.11])
    labels = [
        parse_unipen(LIPITK, f"usr0/{name}.txt").recordings[0].label for name in ("000004t01", "4t12", "at01", "t01")
    ]
    assert labels == ["000004", "4", "at01", "t01"]


def test_pendigits_are_read_by_place_and_it_is_said(tmp_path: Path) -> None:
    findings = parse_unipen(GOOD, tmp_path / "digits.txt").findings
    assert [(f.what, f.kind) for f in findings] == [
        (".INCLUDE of a file that is not there", "assumed"),
        ("numbers of components of a larger file: segments taken to be what follows them", "assumed"),
    ]


def test_a_tablet_that_never_says_pen_up_and_stamps_every_point(tmp_path: Path) -> None:
    data = (
        ".WRITER_ID\tg1\n.DATE\t10 00 93\n.SKILL\t?\n.PEN_DOWN\n0 0 0\n.PEN_DOWN\n14 19 4000\n15 19 4005\n16 20 4010\n"
    )
    data += ".PEN_DOWN\n17 21 4030\n18 21 4035\n"
    header = ".VERSION \t1.0\n.X_POINTS_PER_MM\t10\n.Y_POINTS_PER_MM\t10\n.POINTS_PER_SECOND\t200\n.COORD\tX Y T\n"
    text = header + ".HIERARCHY WORD\n\n" + data + '.SEGMENT WORD 1-2 ? "we"\n'
    (stroke,) = read_unipen(written(tmp_path, text))
    assert stroke.points.tolist() == [[14, 19], [15, 19], [16, 20], [17, 21], [18, 21]]
    assert_allclose(stroke.times, [0, 0.005, 0.01, 0.03, 0.035])


def test_a_recording_that_goes_on_with_the_pen_up_and_from_word_to_word(tmp_path: Path) -> None:
    words = (
        '.COMMENT\n   Recording started at 15:28\n.COMMENT number W001\n.SEGMENT WORD 0-2 BAD "ab"\n'
        '.SEGMENT CHAR 0:0-1:1 BAD "a"\n.SEGMENT CHAR 2:0-2:1 BAD "b"\n.PEN_DOWN\n 0  -9\n 1  -9\n.PEN_UP\n 2  -9\n'
        ' 3  -9\n.PEN_DOWN\n 4  -9\n 5  -8\n.COMMENT number W002\n.SEGMENT WORD 3 OK "c"\n'
        '.SEGMENT CHAR 3:1-3:3 OK "c"\n'
        ".PEN_DOWN\n 9  0\n 9  1\n 8  1\n 8  2\n"
    )
    text = ".COORD                      X Y\n.START_SET\n.HIERARCHY WORD CHAR\n.DATE 02 13 95\n" + words
    library = read_unipen(written(tmp_path, text))
    assert library.labels == ("a", "b", "c")
    assert [stroke.points.tolist() for stroke in library] == [
        [[0, -9], [1, -9]],
        [[4, -9], [5, -8]],
        [[9, 1], [8, 1], [8, 2]],
    ]
    assert read_unipen(tmp_path / "digits.txt", level="WORD").labels == ("ab", "c")


def test_train_r01_v07_is_read_as_it_is_distributed(tmp_path: Path) -> None:
    for path, text in {
        "data/1a/apb/apb02/app0237.dat": ".VERSION 1.0\n.INCLUDE apb/app.doc\n.INCLUDE apb/data/apb02/app0237.dat\n"
        '.SEGMENT CHARACTER 0-1 ? "4"\n.SEGMENT CHARACTER 3 ? "\\""\n',
        "include/apb/app.doc": ".VERSION 1.0\n\n.COORD Y X\n\n.HIERARCHY TEXT CHARACTER\n.POINTS_PER_SECOND 60\n",
        "include/apb/data/apb02/app0237.dat": "\n.WRITER_ID Bill\n.STYLE PRINTED\n"
        + "".join(f".PEN_DOWN\n\t0\t{n}\n\t0\t{n + 0.5}\n.PEN_UP\n" for n in range(4)),
    }.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    library, report = import_strokes([tmp_path])
    assert (library.labels, library.writers) == (("4", '"'), ("Bill", "Bill"))
    assert library[0].points.tolist() == [[0, 0], [0.5, 0], [1, 0], [1.5, 0]]
    assert_allclose(library[0].times, np.arange(4) / 60)
    assert [file.status for file in report.files] == ["read", "read with another", "read with another"]


def test_the_files_of_a_real_person_give_the_points_of_the_data_set() -> None:
    data = Path(os.environ.get("SIGNIMIT_DATA", Path(__file__).parents[6] / "shared" / "data"))
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
