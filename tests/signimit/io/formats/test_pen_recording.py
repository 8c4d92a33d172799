"""Recordings become strokes: gaps bridged, clocks mended, nonsense refused."""

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from signimit import FileFormatError
from signimit.io.formats import pen_recording
from signimit.io.formats.import_report import StrokeImportWarning
from signimit.io.formats.pen_recording import (
    PenFile,
    PenRecording,
    import_pen_file,
    library_from_pen_file,
    mend_recording,
    stroke_from_recording,
)

DOWN = [np.array([(0, 0), (1, 0), (2, 0.0)]), np.array([(2, 4), (3, 4.0)])]


def recording(pieces: list[np.ndarray], stamps: Sequence[np.ndarray | None] | None = None) -> PenRecording:
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


def test_absurd_gaps_between_many_pieces_are_bounded_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pen_recording, "MOST_BRIDGED", 50)
    pieces = [np.array([(1e9 * i, 0), (1e9 * i, 1e-9), (1e9 * i, 2e-9)]) for i in range(5)]
    assert len(stroke_from_recording(recording(pieces))) == 5 * 3 + 4 * 9  # bridges of 10 steps each


def test_a_stamp_that_steps_back_keeps_the_points_and_the_duration() -> None:
    points = np.array([(0, 0), (5, 0), (9, -3), (12, -9.0)])
    mended = mend_recording(recording([points], [1302126477.123 + np.array([0, 0.016, 0.015, 0.031])]))
    assert_allclose(mended.stroke.points, points)
    assert_allclose(mended.stroke.times, [0, 0.016, 0.0235, 0.031], atol=1e-6)
    assert [(f.where, f.number, f.kind) for f in mended.findings] == [("f.txt: line 3", 1, "repaired")]


def test_without_a_usable_clock_points_and_bridges_are_evenly_paced() -> None:
    for stamps in ([np.zeros(3), np.zeros(2)], [np.array([4192.0] * 3), np.array([4192.0] * 2)]):
        mended = mend_recording(recording(DOWN, stamps))
        assert_allclose(mended.stroke.times, np.arange(8) * 0.01)
        assert [f.kind for f in mended.findings] == ["repaired"]


def test_the_even_pace_is_that_of_the_device_if_it_is_known() -> None:
    mended = mend_recording(recording(DOWN)._replace(sample_time=0.005))
    assert_allclose(mended.stroke.times, np.arange(8) * 0.005)
    assert [f.what for f in mended.findings] == ["no time stamps: points taken to be 5 ms apart"]


def test_clocks_that_begin_anew_are_put_end_to_end_with_the_bridge_at_the_mean_pace() -> None:
    mended = mend_recording(recording(DOWN, [np.array([0, 0.02, 0.04]), np.array([0, 0.02])]))
    assert_allclose(mended.stroke.points, stroke_from_recording(recording(DOWN)).points)
    assert_allclose(mended.stroke.times, np.arange(8) * 0.02)


def test_a_declared_clock_of_each_piece_is_no_repair() -> None:
    own = recording(DOWN, [np.array([0, 0.02, 0.04]), np.array([5, 5.02])])._replace(clock="own")
    mended = mend_recording(own)
    assert_allclose(mended.stroke.times, np.arange(8) * 0.02)
    assert [f.kind for f in mended.findings] == ["assumed"]


def test_pieces_are_joined_in_the_order_in_which_they_were_drawn() -> None:
    mended = mend_recording(recording([DOWN[1], DOWN[0]], [np.array([9, 10.0]), np.array([5, 6, 7.0])]))
    assert_allclose(mended.stroke.points, stroke_from_recording(recording(DOWN)).points)
    assert_allclose(mended.stroke.times, [0, 1, 2, 2.5, 3, 3.5, 4, 5])


def test_a_piece_without_stamps_takes_the_even_pace() -> None:
    mended = mend_recording(recording(DOWN, [np.array([5, 5.02, 5.04]), None]))
    assert_allclose(np.diff(mended.stroke.times)[:2], 0.02)
    assert_allclose(np.diff(mended.stroke.times)[-1], 0.01)


def test_dots_alone_are_a_drawing_if_there_are_two() -> None:
    dots = recording(
        [np.array([(0.0, 0)]), np.array([(0.0, 0)]), np.array([(3.0, 0)])], [np.array([t]) for t in (1.0, 2, 3)]
    )
    assert_allclose(stroke_from_recording(dots).times, [0, 1, 1.5, 2])


clocks = st.lists(st.sampled_from([0, 0.001, 0.008, 0.016, 0.1, -0.001, -0.02, 1e-17, 1e6]), max_size=6)
wild = st.tuples(clocks, st.sampled_from([1.0, 1e-3, 1e6, 0.0]), st.sampled_from([0.0, 1.3e9, -1.0]), st.booleans())


@given(st.lists(wild, max_size=4), st.booleans())
@settings(deadline=None, derandomize=True, max_examples=150)
def test_whatever_the_clocks_all_points_are_kept_and_times_rise_or_it_is_refused(
    pieces: list[tuple[list[float], float, float, bool]], own: bool
) -> None:
    points = [np.arange(2.0 * len(steps)).reshape(-1, 2) + 10 * i for i, (steps, *_) in enumerate(pieces)]
    stamps = [start + unit * np.cumsum(steps) if stamped else None for steps, unit, start, stamped in pieces]
    given_clock = recording(points, stamps)._replace(clock="own" if own else "shared")
    try:
        stroke = stroke_from_recording(given_clock)
    except FileFormatError:
        return
    assert stroke.times[0] == 0
    assert (np.diff(stroke.times) > 0).all()
    drawn = {tuple(point) for point in stroke.points.tolist()}
    assert {tuple(point) for piece in points for point in piece.tolist()} <= drawn


def test_a_bad_drawing_is_left_out_named_and_warned_of() -> None:
    dot, good = recording([np.array([(0.0, 1.0)])])._replace(where="f.txt: line 9"), recording(DOWN)
    pen_file = PenFile([dot, good], "a test", left_out=[FileFormatError("f.txt: line 1", "ink", "none")])
    with pytest.warns(StrokeImportWarning, match="drawings: 1 read, 0 of them repaired, 2 left out; the first: f.txt"):
        library = library_from_pen_file("f.txt", pen_file)
    assert library.labels == ("4",)
    _, report = import_pen_file("f.txt", "unipen", pen_file)
    assert [error.where for error in report.left_out] == ["f.txt: line 1", "f.txt: line 9: stroke points"]
    with pytest.raises(FileFormatError, match=r"f\.txt: line 1: expected ink"):
        library_from_pen_file("f.txt", pen_file, strict=True)


def test_nothing_left_is_an_error() -> None:
    with pytest.raises(FileFormatError, match="line 3: points: expected at least 2, found none"):
        library_from_pen_file("f.txt", PenFile([recording([])], "a test"))
    with pytest.raises(FileFormatError, match=r"f\.txt: expected strokes, found none"):
        library_from_pen_file("f.txt", PenFile([], "a test"))


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
