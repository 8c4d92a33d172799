"""Gesture logs of the $1 recogniser."""

import os
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from signimit import FileFormatError
from signimit.io.formats import StrokeImportWarning, read_dollar

GOOD = """\ufeff<?xml version="1.0" encoding="utf-8" standalone="yes"?>
<Gesture Name="circle03" Subject="2" Speed="slow" Number="3" NumPts="3" Millseconds="15">
  <Point X="102" Y="162" T="10128229" />
  <Point X="98" Y="161" T="10128234" />
  <Point X="96" Y="160" T="10128244" />
</Gesture>
"""


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "circle03.xml"
    path.write_text(text, encoding="utf-8")
    return path


def test_label_writer_points_up_and_seconds(tmp_path: Path) -> None:
    library = read_dollar(written(tmp_path, GOOD))
    assert library.labels == ("circle",)
    assert library.writers == ("2",)
    assert_allclose(library[0].points, [(102, -162), (98, -161), (96, -160)])
    assert_allclose(library[0].times, [0, 0.005, 0.015], atol=1e-9)


def test_several_strokes_are_bridged(tmp_path: Path) -> None:
    text = (
        '<Gesture Name="T~02" Subject="9"><Stroke index="1"><Point X="0" Y="0" T="0"/><Point X="2" Y="0" T="10"/>'
        '</Stroke><Stroke index="2"><Point X="2" Y="4" T="30"/><Point X="2" Y="6" T="40"/></Stroke></Gesture>'
    )
    library = read_dollar(written(tmp_path, text))
    assert library.labels == ("T",)
    assert_allclose(library[0].points, [(0, 0), (2, 0), (2, -2), (2, -4), (2, -6)])
    assert_allclose(library[0].times, [0, 0.01, 0.02, 0.03, 0.04])


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ('NumPts="3"', 'NumPts="4"', "expected 4 points as NumPts says, found 3"),
        ('Y="161"', "", "point 1: expected numbers X, Y and T"),
        ('Y="161"', 'Y="high"', "point 1: expected numbers X, Y and T"),
        ('Y="161"', 'Y="inf"', "points: expected finite numbers"),
        (
            "10128244",
            "10128217",
            "a clock that runs forward.*found 0.005 s and then -0.012 s after the first, at point 2",
        ),
        ("Gesture", "Picture", "expected a Gesture element, found 'Picture'"),
        ("</Gesture>", "", "expected well-formed XML, found no element found: line 7"),
        ('encoding="utf-8"', 'encoding="martian"', "expected .* XML, found unknown encoding|encoding that exists"),
    ],
)
def test_broken_files_give_one_sentence(tmp_path: Path, old: str, new: str, match: str) -> None:
    assert old in GOOD
    path = written(tmp_path, GOOD.replace(old, new))
    with pytest.raises(FileFormatError, match=match) as caught:
        read_dollar(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_log_whose_clock_steps_back_is_read(tmp_path: Path) -> None:
    with pytest.warns(StrokeImportWarning, match="1 of them repaired.*time stamps that step back"):
        library = read_dollar(
            written(tmp_path, GOOD.replace("10128234", "10128244").replace('10128244" />\n</', '10128243" />\n</'))
        )
    assert_allclose(library[0].points, [(102, -162), (98, -161), (96, -160)])
    assert_allclose(library[0].times, [0, 0.015, 0.0155], atol=1e-9)


def test_stamps_of_seconds_and_of_nothing_give_an_even_pace(tmp_path: Path) -> None:
    for stamps in (("0.0", "0.005", "0.015"), ("0", "0", "0"), ("-1", "-1", "-1")):
        text = GOOD
        for old, new in zip(("10128229", "10128234", "10128244"), stamps, strict=True):
            text = text.replace(old, new)
        with pytest.warns(StrokeImportWarning, match="points taken to be 10 ms apart"):
            library = read_dollar(written(tmp_path, text))
        assert_allclose(library[0].times, [0, 0.01, 0.02])


@pytest.mark.parametrize("replacement", ["", 'T=""'])
def test_points_without_stamps_are_evenly_paced(tmp_path: Path, replacement: str) -> None:
    library = read_dollar(written(tmp_path, re.sub(r'T="\d*"', replacement, GOOD)))
    assert_allclose(library[0].points, [(102, -162), (98, -161), (96, -160)])
    assert_allclose(library[0].times, [0, 0.01, 0.02])


def test_decimal_commas_are_read(tmp_path: Path) -> None:
    with pytest.warns(StrokeImportWarning, match="commas as decimal points"):
        library = read_dollar(written(tmp_path, GOOD.replace('X="102"', 'X="101,75"')))
    assert_allclose(library[0].points[0], (101.75, -162))


def test_gestures_of_one_file_are_read_one_by_one(tmp_path: Path) -> None:
    gesture = GOOD[GOOD.index("<Gesture") :]
    broken = gesture.replace('Y="161"', "")
    path = written(tmp_path, f"<Gestures>{gesture}{broken}{gesture.replace('circle', 'star')}</Gestures>")
    with pytest.warns(StrokeImportWarning, match="2 read, 0 of them repaired, 1 left out; .*drawing 1: point 1"):
        assert read_dollar(path).labels == ("circle", "star")
    with pytest.raises(FileFormatError, match=r"circle03\.xml: drawing 1: point 1: expected numbers X, Y and T"):
        read_dollar(path, strict=True)


def test_very_deep_nesting_ends(tmp_path: Path) -> None:
    gesture = GOOD[GOOD.index("<Gesture") :]
    deep = "<Gesture Name='a'>" * 20_000 + gesture + "</Gesture>" * 20_000
    with pytest.raises(FileFormatError, match="points: expected at least 2, found none"):
        read_dollar(written(tmp_path, f"<x>{deep}</x>"))


def test_a_flaw_in_a_stroke_names_it(tmp_path: Path) -> None:
    strokes = '<Stroke><Point X="0" Y="0" T="0"/></Stroke><Stroke><Point X="0" T="9"/></Stroke>'
    with pytest.raises(FileFormatError, match=r"circle03\.xml: stroke 1: point 0: expected numbers X, Y and T"):
        read_dollar(written(tmp_path, f'<Gesture Name="T">{strokes}</Gesture>'))


def test_files_of_real_people_give_the_points_of_the_data_set() -> None:
    data = Path(os.environ.get("SIGNIMIT_DATA", Path(__file__).parents[5] / "shared" / "data"))
    if not (data / "unistrokes.npz").exists():
        pytest.skip("needs the real strokes, see SIGNIMIT_DATA")
    known = dict(np.load(data / "unistrokes.npz"))
    for path in sorted((data / "raw" / "unistroke").rglob("*.xml"))[::7]:
        library = read_dollar(path)
        speed, repetition = path.parent.name, int(path.stem[-2:])
        (number,) = np.flatnonzero(
            (known["label_names"][known["label"]] == library.labels[0])
            & (known["subject"] == int(library.writers[0]))
            & (known["speed_names"][known["speed"]] == speed)
            & (known["repetition"] == repetition)
        )
        part = slice(*known["offsets"][number : number + 2])
        assert_allclose(library[0].points + np.array([0, 320]), known["xy"][part])  # that screen is 320 points high
        assert_allclose(library[0].times, known["t_ms"][part] / 1000, atol=1e-6)
