"""Damaged files give strokes or one sentence, whatever the damage."""

import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from signimit import SignimitError, StrokeLibrary
from signimit.io.formats import StrokeImportWarning, read_dollar, read_inkml, read_unipen

UNIPEN = b'.SEGMENT D 0-1 ? "6"\n.COMMENT 6 13 38\n.PEN_DOWN\n1 2\n3 4\n.PEN_UP\n.PEN_DOWN\n9 2\n8 4\n.PEN_UP\n'
UNIPEN_LEVELS = (
    b".VERSION 1.0\n.HIERARCHY WORD C\n.COORD Y X T\n.X_POINTS_PER_MM 5\n.Y_POINTS_PER_INCH 99\n.INCLUDE file\n"
    b'.SEGMENT WORD 0-2 ? "ab"\n.SEGMENT C 0:1-2,2:0 OK "\\"a"\n.POINTS_PER_SECOND 50\n.DT 30\n'
    b".PEN_DOWN\n1 2 9\n3 4 0\n5 4 20\n.PEN_UP\n6 4 30\n.PEN_DOWN 7 8 40 9 9 50\n.PEN_UP\n"
)
DOLLAR = (
    b'<Gesture Name="star01" Subject="2" NumPts="2"><Point X="0" Y="0" T="0"/><Point X="2" Y="0" T="10"/></Gesture>'
)
INKML = (
    b'<ink xmlns="http://www.w3.org/2003/InkML"><traceFormat><channel name="X"/><channel name="Y"/></traceFormat>'
    b'<trace id="a">1 2, 3 4, 5 7</trace><traceGroup><traceView traceDataRef="#a"/></traceGroup></ink>'
)
TOKENS = (b"1e400", b"-1e308", b"1e-320", b"nan", b"<", b'"', b",", b"\x00", b"\xff", b"&a;", b" ", b"\n", b"9" * 400)


def damaged(whole: bytes, rng: np.random.Generator) -> bytes:
    for _ in range(rng.integers(1, 4)):
        i, token = int(rng.integers(len(whole))), TOKENS[rng.integers(len(TOKENS))]
        cut = int(rng.integers(0, 12))
        whole = whole[:i] + (token if rng.random() < 0.7 else b"") + whole[i + cut :] or b" "
    return whole


@pytest.mark.parametrize(
    ("read", "whole"),
    [(read_unipen, UNIPEN), (read_unipen, UNIPEN_LEVELS), (read_dollar, DOLLAR), (read_inkml, INKML)],
    ids=["UCI", "UNIPEN", "dollar", "InkML"],
)
def test_damaged_files_give_strokes_or_one_sentence(
    tmp_path: Path, read: Callable[[Path], StrokeLibrary], whole: bytes
) -> None:
    rng, path = np.random.default_rng(0), tmp_path / "file"
    path.write_bytes(whole)
    sentences = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StrokeImportWarning)
        assert len(read(path)) == 1
        for _ in range(300):
            path.write_bytes(damaged(whole, rng))
            try:
                read(path)
            except SignimitError as error:
                sentences.append(str(error))
    assert len(sentences) > 100
    assert all("\n" not in sentence for sentence in sentences)
