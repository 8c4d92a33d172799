"""W3C InkML in and out."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from signimit import FileFormatError, InvalidInputError, Stroke, StrokeLibrary
from signimit.io.formats import read_inkml, write_inkml
from signimit.teaching.people import synthetic_library

HEAD = '<?xml version="1.0"?>\n<ink xmlns="http://www.w3.org/2003/InkML">\n'
TIMED = '<traceFormat><channel name="T" units="ms"/><channel name="X"/><channel name="Y"/></traceFormat>'
BOMB = (
    '<?xml version="1.0"?><!DOCTYPE ink [<!ENTITY a "1 2, 3 4,"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">'
    '<!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;">]><ink xmlns="http://www.w3.org/2003/InkML"><trace>&c;1 2</trace></ink>'
)
FETCH = (
    '<?xml version="1.0"?><!DOCTYPE ink [<!ENTITY x SYSTEM "file:///etc/hostname">]>'
    '<ink xmlns="http://www.w3.org/2003/InkML"><trace>&x;</trace></ink>'
)


def written(folder: Path, body: str, whole: bool = False) -> Path:
    path = folder / "house.inkml"
    path.write_text(body if whole else f"{HEAD}{body}</ink>")
    return path


def test_bare_traces_are_one_drawing_with_y_turned_up(tmp_path: Path) -> None:
    library = read_inkml(written(tmp_path, "<trace>0 0, 1 0, 2 0</trace><trace>2 2, 3 2</trace>"))
    assert library.labels == ("house",)
    assert library.writers == ("unknown",)
    assert_allclose(library[0].points, [(0, 0), (1, 0), (2, 0), (2, -1), (2, -2), (3, -2)])
    assert_allclose(library[0].times, np.arange(6) * 0.01)


def test_channels_are_found_by_name_and_time_by_its_unit(tmp_path: Path) -> None:
    library = read_inkml(written(tmp_path, f"{TIMED}<trace>100 1 2, 150 3 4,160 5 7</trace>"))
    assert_allclose(library[0].points, [(1, -2), (3, -4), (5, -7)])
    assert_allclose(library[0].times, [0, 0.05, 0.06])


def test_groups_are_drawings_and_annotations_are_inherited(tmp_path: Path) -> None:
    body = (
        '<annotation type="writer">ann</annotation><traceGroup><annotation type="truth">A</annotation>'
        '<traceGroup><annotation type="truth"> x </annotation><trace>0 0,1 1</trace></traceGroup>'
        '<traceGroup><annotation type="writer">bob</annotation><trace>0 0,1 2</trace></traceGroup></traceGroup>'
    )
    library = read_inkml(written(tmp_path, body))
    assert library.labels == ("x", "A")
    assert library.writers == ("ann", "bob")


def test_views_refer_to_traces_and_pen_up_traces_are_left_out(tmp_path: Path) -> None:
    body = (
        '<trace id="0">0 0,1 0</trace><trace id="1" type="penUp">1 0,5 5</trace><trace xml:id="2">5 5,6 6</trace>'
        '<traceGroup><annotation type="label">y</annotation><traceView traceDataRef="#2"/></traceGroup>'
        '<traceGroup><annotation type="label">z</annotation><traceView traceDataRef="0"/>'
        '<traceView traceDataRef="1"/></traceGroup>'
    )
    library = read_inkml(written(tmp_path, body))
    assert library.labels == ("y", "z")
    assert_allclose(library[0].points, [(5, -5), (6, -6)])
    assert_allclose(library[1].points, [(0, 0), (1, 0)])


def test_explicit_values_and_no_namespace_are_understood(tmp_path: Path) -> None:
    library = read_inkml(written(tmp_path, "<ink><trace>!1 !2, 3 4</trace></ink>", whole=True))
    assert_allclose(library[0].points, [(1, -2), (3, -4)])


@pytest.mark.parametrize(
    ("body", "match"),
    [
        ("<trace>1 2, 3</trace>", "drawing 0: trace 0: point 1: expected a value for each of X, Y, found '3'"),
        ("<trace>0 0,1 1</trace><trace id='t'>1 2, 3 4 5</trace>", "drawing 0: trace t: point 1: expected a value"),
        ("<traceGroup><annotation type='label'>a</annotation><trace>1</trace></traceGroup>", "drawing 0 'a': trace 0:"),
        ("<trace></trace>", "points: expected at least 2, found none"),
        ("", "house.inkml: expected traces, or views of them, outside definitions, found none"),
        (f"{TIMED}<trace>20 0 0, 1 1 1, 30 2 2</trace>", "a clock that runs forward"),
        (TIMED.replace('"X"', '"F"') + "<trace>2 0 0, 1 1 1</trace>", "expected channels X and Y, found T, F, Y"),
        ("<traceFormat>" + "<channel/>" * 101 + "</traceFormat><trace>1 2</trace>", "at most 100 channels, found 101"),
    ],
)
def test_what_is_not_understood_gives_one_sentence(tmp_path: Path, body: str, match: str) -> None:
    path = written(tmp_path, body)
    with pytest.raises(FileFormatError, match=match) as caught:
        read_inkml(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("whole", "match"),
    [
        (BOMB, "expected XML without entities, found EntitiesForbidden"),
        (FETCH, "expected XML without entities, found EntitiesForbidden"),
        ("<svg/>", "expected an ink element, found 'svg'"),
        (f"{HEAD}<trace>1 2, 3", "expected well-formed XML"),
        ("", "expected well-formed XML"),
        ("\x00\x01", "expected well-formed XML"),
    ],
)
def test_hostile_and_truncated_files_are_refused(tmp_path: Path, whole: str, match: str) -> None:
    with pytest.raises(FileFormatError, match=match):
        read_inkml(written(tmp_path, whole, whole=True))


def test_very_deep_nesting_ends(tmp_path: Path) -> None:
    body = "<traceGroup>" * 50_000 + "<trace>0 0, 1 1</trace>" + "</traceGroup>" * 50_000
    assert len(read_inkml(written(tmp_path, body))) == 1


def test_a_library_comes_back_to_the_last_bit(tmp_path: Path) -> None:
    library = synthetic_library(["8", "star"], writers=2, samples=2, rng=np.random.default_rng(0))
    write_inkml(tmp_path / "out.inkml", library)
    again = read_inkml(tmp_path / "out.inkml")
    assert again.labels == library.labels
    assert again.writers == library.writers
    for stroke, same in zip(library, again, strict=True):
        assert_array_equal(same.points, stroke.points)
        assert_array_equal(same.times, stroke.times)


names = st.text(st.characters(min_codepoint=33, max_codepoint=0x2FF, exclude_categories=("Cc", "Cs")), min_size=1)


@given(label=names, writer=names, number=st.floats(-1e90, 1e90))
@settings(deadline=None, derandomize=True, max_examples=25)
def test_any_name_and_number_comes_back(
    tmp_path_factory: pytest.TempPathFactory, label: str, writer: str, number: float
) -> None:
    stroke = Stroke(np.array([(0.0, 1.0), (1.5, number)]), np.array([0, 0.25]))
    path = tmp_path_factory.mktemp("ink") / "one.inkml"
    write_inkml(path, StrokeLibrary((stroke,), (label,), (writer,)))
    again = read_inkml(path)
    assert (again.labels, again.writers) == ((label.strip(),), (writer.strip(),))
    assert_array_equal(again[0].points, stroke.points)


@pytest.mark.parametrize("label", ["a\x00b", "bell\x07"])
def test_labels_that_xml_cannot_hold_are_refused(tmp_path: Path, label: str) -> None:
    stroke = Stroke(np.array([(0.0, 1.0), (1.5, 2.0)]), np.array([0, 0.25]))
    with pytest.raises(InvalidInputError, match="label: expected characters that XML can hold, found"):
        write_inkml(tmp_path / "one.inkml", StrokeLibrary((stroke,), (label,), ("ann",)))
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_left_when_writing_fails(tmp_path: Path) -> None:
    library = synthetic_library(["8"], samples=1, rng=np.random.default_rng(0))
    with pytest.raises(FileNotFoundError):
        write_inkml(tmp_path / "missing" / "out.inkml", library)
    assert list(tmp_path.iterdir()) == []
