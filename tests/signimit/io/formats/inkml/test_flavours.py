"""Documents as the programs and data sets of the field write them, shortened."""

from pathlib import Path

import pytest
from numpy.testing import assert_allclose, assert_array_equal

from signimit.io.formats import StrokeImportWarning, read_inkml

WORD = """<inkml:ink xmlns:inkml="http://www.w3.org/2003/InkML"><inkml:definitions>
<inkml:context xml:id="ctx0"><inkml:inkSource xml:id="inkSrc0"><inkml:traceFormat>
<inkml:channel name="X" type="integer" min="-2.14748E9" max="2.14748E9" units="cm"/>
<inkml:channel name="Y" type="integer" min="-2.14748E9" max="2.14748E9" units="cm"/>
<inkml:channel name="F" type="integer" max="32767" units="dev"/>
<inkml:channel name="OA" type="integer" max="360" units="deg"/></inkml:traceFormat><inkml:channelProperties>
<inkml:channelProperty channel="X" name="resolution" value="1000" units="1/cm"/>
<inkml:channelProperty channel="Y" name="resolution" value="1000" units="1/cm"/>
<inkml:channelProperty channel="F" name="resolution" value="0" units="1/dev"/>
</inkml:channelProperties></inkml:inkSource><inkml:timestamp xml:id="ts0" timeString="2024-05-17T14:40:01.152"/>
</inkml:context><inkml:brush xml:id="br0"><inkml:brushProperty name="width" value="0.035" units="cm"/></inkml:brush>
{}</inkml:definitions>{}</inkml:ink>"""
OTHER = """<inkml:context xml:id="ctx1"><inkml:inkSource xml:id="inkSrc1"><inkml:traceFormat>
<inkml:channel name="X" type="integer" units="cm"/><inkml:channel name="Y" type="integer" units="cm"/>
</inkml:traceFormat><inkml:channelProperties>
<inkml:channelProperty channel="X" name="resolution" value="100" units="1/cm"/>
<inkml:channelProperty channel="Y" name="resolution" value="100" units="1/cm"/>
</inkml:channelProperties></inkml:inkSource></inkml:context>"""


def write(folder: Path, text: str) -> Path:
    path = folder / "page.inkml"
    path.write_text(text, encoding="utf-8")
    return path


def test_word_writes_second_differences_and_hides_the_pen_s_angles(tmp_path: Path) -> None:
    """By hand, X: 2561, -29 -> 2532, -27 -> 2505, -52 -> 2453; Y: 1, 35 -> 36, 37 -> 73, 79 -> 152."""
    trace = """<inkml:trace contextRef="#ctx0" brushRef="#br0">2561 1 23239 0,'-29'35'903'0,"2"2"-1"0,-25
        42 1 0</inkml:trace>"""
    library = read_inkml(write(tmp_path, WORD.format("", trace)), strict=True)
    assert_array_equal(library[0].points, [(2561, -1), (2532, -36), (2505, -73), (2453, -152)])


def test_onenote_changes_its_context_and_says_when_traces_began(tmp_path: Path) -> None:
    """The second trace is counted in 0.1 mm instead of 0.01 mm."""
    traces = """<inkml:trace contextRef="#ctx0" brushRef="#br0">100 200 9 0,'10'0'0'0,"0"10"0"0</inkml:trace>
        <inkml:trace contextRef="#ctx1" brushRef="#br0" timeOffset="250.4">12 22,'1'0,"0"1</inkml:trace>"""
    library = read_inkml(write(tmp_path, WORD.format(OTHER, traces)), strict=True)
    assert_allclose(library[0].points[:3], [(100, -200), (110, -200), (120, -210)])
    assert_allclose(library[0].points[-3:], [(120, -220), (130, -220), (140, -230)])
    assert_allclose(library[0].times[[0, 1, 2, -3, -2, -1]], [0, 0.01, 0.02, 0.2504, 0.2604, 0.2704])


def test_inkmljs_labels_words_by_their_recognised_text(tmp_path: Path) -> None:
    word = """<inkml:traceGroup><inkml:annotationXML><emma:emma xmlns:emma="http://www.w3.org/2003/04/emma">
        <emma:interpretation id="i" emma:mode="ink"><msink:context xmlns:msink="urn:ms" type="inkWord"/>
        </emma:interpretation><emma:one-of><emma:interpretation><emma:literal>{}</emma:literal></emma:interpretation>
        <emma:interpretation><emma:literal>no</emma:literal></emma:interpretation></emma:one-of></emma:emma>
        </inkml:annotationXML><inkml:trace contextRef="#ctx0">1 2 3 4,'1'1'0'0</inkml:trace></inkml:traceGroup>"""
    line = f"<inkml:traceGroup>{word.format('This')}{word.format('is')}</inkml:traceGroup>"
    library = read_inkml(write(tmp_path, WORD.format("", line)), strict=True)
    assert library.labels == ("This", "is")
    assert_array_equal(library[1].points, [(1, -2), (2, -3)])


def test_crohme_numbers_traces_and_groups_each_for_themselves(tmp_path: Path) -> None:
    text = """<ink xmlns="http://www.w3.org/2003/InkML"><traceFormat><channel name="X" type="decimal"/>
        <channel name="Y" type="decimal"/></traceFormat><annotation type="truth">$1+x$</annotation>
        <annotation type="writer">w7</annotation><annotationXML type="truth" encoding="Content-MathML">
        <math xmlns="http://www.w3.org/1998/Math/MathML"><mi xml:id="A_0">x</mi></math></annotationXML>
        <trace id="0">\n1 1, 1 9\n</trace><trace id="1">3 5, 5 5</trace><trace id="2">4 4, 4 6</trace>
        <trace id="3">8 8, 9 9</trace>
        <traceGroup xml:id="3"><annotation type="truth">Segmentation</annotation>
        <traceGroup xml:id="0"><annotation type="truth">1</annotation><traceView traceDataRef="0"/>
        <annotationXML href="A_0"/></traceGroup><traceGroup xml:id="1"><annotation type="truth">+</annotation>
        <traceView traceDataRef="1"/><traceView traceDataRef="2"/></traceGroup></traceGroup></ink>"""
    library = read_inkml(write(tmp_path, text), strict=True)
    assert library.labels == ("$1+x$", "1", "+")  # what is in no group keeps the name of the whole
    assert library.writers == ("w7",) * 3
    assert_array_equal(library[0].points, [(8, -8), (9, -9)])
    assert_array_equal(library[1].points, [(1, -1), (1, -9)])


def test_iamondo_has_a_tree_of_views_and_a_clock_in_seconds(tmp_path: Path) -> None:
    text = """<ink xmlns="http://www.w3.org/2003/InkML"><definitions><context xml:id="c0"><inkSource xml:id="s">
        <traceFormat><channel name="X" type="decimal"/><channel name="Y" type="decimal"/>
        <channel name="T" type="decimal" units="s"/><channel name="F" type="decimal"/></traceFormat></inkSource>
        </context></definitions><trace xml:id="t1" contextRef="#c0">10 20 3.5 7,'1'2'0.01'0,"0"1"0"0</trace>
        <trace xml:id="t2" contextRef="#c0">50 20 5 7,'1'2'0.01'0,*"1"0*</trace>
        <traceView xml:id="d"><annotation type="type">Document</annotation><traceView>
        <annotation type="type">Textline</annotation><annotation type="transcription">ab c</annotation>
        <traceView><annotation type="type">Word</annotation><annotation type="transcription">ab</annotation>
        <traceView traceDataRef="#t1"/></traceView><traceView><annotation type="type">Word</annotation>
        <annotation type="transcription">c</annotation><traceView traceDataRef="#t2"/></traceView></traceView>
        </traceView></ink>"""
    library = read_inkml(write(tmp_path, text), strict=True)
    assert library.labels == ("ab", "c")
    assert_array_equal(library[0].points, [(10, -20), (11, -22), (12, -25)])
    assert_array_equal(library[1].points, [(50, -20), (51, -22), (52, -25)])
    assert_allclose(library[0].times, [0, 0.01, 0.02])


def test_one_bad_drawing_of_a_page_is_left_out_by_name(tmp_path: Path) -> None:
    groups = "".join(
        f"<traceGroup><annotation type='label'>{name}</annotation><trace>{data}</trace></traceGroup>"
        for name, data in (("a", "0 0, 1 1"), ("b", "0 0, 1 x"), ("c", "5 5"), ("d", "0 0, 2 1"))
    )
    path = write(tmp_path, f"<ink>{groups}</ink>")
    with pytest.warns(
        StrokeImportWarning, match=r"2 left out; the first: .*drawing 1 'b': trace 0: point 1: expected a v"
    ):
        assert read_inkml(path).labels == ("a", "d")
