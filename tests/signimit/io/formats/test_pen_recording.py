"""Recordings become strokes: gaps bridged, clocks mended, nonsense refused."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from signimit import FileFormatError, InvalidInputError
from signimit.io.formats.pen_clock import spread_ties
from signimit.io.formats.pen_recording import PenRecording, stroke_from_recording

DOWN = [np.array([(0, 0), (1, 0), (2, 0.0)]), np.array([(2, 4), (3, 4.0)])]


def recording(pieces: list[np.ndarray], stamps: list[np.ndarray] | None = None) -> PenRecording:
    return PenRecording(pieces, stamps, "4", "ann", "f.txt: line 3")


def test_a_pen_up_gap_is_bridged_by_a_straight_line_of_the_median_step() -> None:
    stroke = stroke_from_recording(recording(DOWN))
    assert_allclose(stroke.points, [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (2, 3), (2, 4), (3, 4)])
    assert_allclose(stroke.times, np.arange(8) * 0.01)


def test_with_stamps_the_bridge_takes_the_time_the_pen_was_up() -> None:
    stroke = stroke_from_recording(recording(DOWN, [np.array([5, 6, 7.0]), np.array([9, 10.0])]))
    assert_allclose(stroke.times, [0, 1, 2, 2.5, 3, 3.5, 4, 5])


def test_pieces_that_touch_or_are_empty_need_no_bridge() -> None:
    pieces = [np.zeros((0, 2)), np.array([(0, 0), (1, 0.0)]), np.array([(1, 0), (1, 1.0)])]
    assert len(stroke_from_recording(recording(pieces))) == 4


def test_a_bridge_over_an_absurd_gap_is_bounded() -> None:
    pieces = [np.array([(0, 0), (1e-9, 0), (2e-9, 0)]), np.array([(1e9, 0), (1e9, 1e-9), (1e9, 2e-9)])]
    assert len(stroke_from_recording(recording(pieces))) < 2000


def test_equal_stamps_share_the_time_to_the_next() -> None:
    assert_allclose(spread_ties(np.array([0, 0, 0.03, 0.05, 0.05])), [0, 0.015, 0.03, 0.05, 0.0505])


@given(st.lists(st.integers(0, 20), min_size=2, max_size=40))
@settings(deadline=None, derandomize=True, max_examples=60)
def test_mended_stamps_rise_and_stay_between_their_neighbours(ticks: list[int]) -> None:
    stamps = np.sort(np.array(ticks, dtype=float))
    mended = spread_ties(stamps)
    assert (np.diff(mended) > 0).all()
    assert (mended >= stamps).all()
    assert (mended < stamps + 21).all()


def test_a_clock_that_runs_backwards_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="a clock that runs forward, found 2 s then 1 s"):
        spread_ties(np.array([0, 2, 1.0]))


@pytest.mark.parametrize(
    ("pieces", "match"),
    [
        ([], "at least 2, found none"),
        ([np.zeros((5, 2))], "points that move"),
        ([np.array([(0.0, 1.0)])], "at least 2 points, found 1"),
        ([np.array([(0, 0), (np.nan, 1)])], "finite numbers, found nan"),
    ],
)
def test_what_is_no_stroke_is_refused_with_its_place(pieces: list[np.ndarray], match: str) -> None:
    with pytest.raises(FileFormatError, match=f"f.txt: line 3: .*{match}"):
        stroke_from_recording(recording(pieces))
