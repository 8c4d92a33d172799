"""Clocks of pens: what is jitter, what is no clock, and in which order pieces were drawn."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from signimit import InvalidInputError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.pen_clock import MAX_STEP_BACK, piece_times, place_pieces, relative_seconds, spread_ties

EVEN = "points taken to be 10 ms apart"


def times(*pieces: list[float] | None, own: bool = False) -> tuple[list[list[float]] | None, list[str]]:
    """Stamps of pieces, s, as they are understood, and what was found."""
    stamps = [None if piece is None else np.array(piece) for piece in pieces]
    counts = [2 if piece is None else len(piece) for piece in pieces]
    found = piece_times(stamps, counts, own, 0.01, "f")
    understood = None if found.stamps is None else [piece.tolist() for piece in found.stamps]
    return understood, [finding.what for finding in found.findings]


def test_stamps_since_1970_are_made_relative_before_they_are_multiplied() -> None:
    pieces = relative_seconds([np.array([1302126477123, 1302126477139]), None, np.array([1302126477155])], 0.001)
    assert pieces[0] is not None
    assert pieces[2] is not None
    assert_array_equal(pieces[0], [0, 0.016])  # 1302126477.139 - 1302126477.123 is 0.01599...
    assert pieces[1] is None
    assert_array_equal(pieces[2], [0.032])


def test_a_clock_that_steps_back_a_little_is_lifted_and_the_stamps_are_counted() -> None:
    found = piece_times([np.array([5, 5.016, 5.015, 5.014, 5.031])], [5], False, 0.01, "f.xml")
    assert found.stamps is not None
    assert_allclose(found.stamps[0], [0, 0.016, 0.016, 0.016, 0.031])
    assert found.findings == [
        Finding("f.xml", "time stamps that step back by 16 ms or less: lifted to the one before", 2, "repaired")
    ]


def test_a_clock_that_steps_back_far_is_refused_with_numbers_that_differ_and_the_remedy() -> None:
    stamps = 1302126477.123 + np.array([0, 0.016, 0.016 - MAX_STEP_BACK - 0.001, 0.031])
    expected = (
        r"or at most 16 ms back \(or no time stamps at all\), found 0.016 s and then -0.001 s after the first, at"
    )
    with pytest.raises(InvalidInputError, match=expected):
        piece_times([stamps], [4], False, 0.01, "f")
    assert piece_times([stamps + np.array([0, 0, 0.001, 0])], [4], False, 0.01, "f").stamps is not None


@pytest.mark.parametrize("shift", [0, 1302126477.0, -7.5])
def test_jitter_is_jitter_wherever_the_clock_starts(shift: float) -> None:
    understood, _ = times([shift + t for t in (0, 0.02, 0.019, 0.04)])
    assert understood is not None
    assert_allclose(understood[0], [0, 0.02, 0.02, 0.04], atol=1e-6)


@pytest.mark.parametrize(
    ("clock", "why"),
    [
        (np.zeros(60), "a clock that stands still"),
        (np.full(60, 4192.0), "a clock that stands still"),
        (np.arange(60) * 0.0167e-3, "a clock too fast for a hand, as of seconds read as milliseconds"),
        (np.array([0, 0.001, 0.002]), "a clock too fast for a hand, as of seconds read as milliseconds"),
        (np.arange(60) * 0.001, "a clock too fast for a hand, as of seconds read as milliseconds"),  # it counts points
        (np.arange(60) * 16.7, "a clock too slow for a hand, as of nanoseconds read as milliseconds"),  # microseconds
        (np.arange(60) * 16700.0, "a clock too slow for a hand, as of nanoseconds read as milliseconds"),
        (
            np.array([0, *(1.3e9 + 0.01 * np.arange(59))]),
            "a clock too slow for a hand, as of nanoseconds read as milli",
        ),
    ],
)
def test_what_is_no_clock_gives_an_even_pace_and_says_so(clock: np.ndarray, why: str) -> None:
    understood, found = times(clock.tolist())
    assert understood is None
    assert len(found) == 1
    assert found[0].startswith(why)
    assert found[0].endswith(EVEN)


@pytest.mark.parametrize(
    "clock",
    [
        np.arange(3) * 0.008,  # a flick at 120 Hz
        np.arange(150) * 0.001,  # a mouse at 1 kHz
        np.floor(np.arange(60) * 0.5) * 0.015625,  # a coarse clock
        np.arange(100) * 1.0,  # somebody who draws a point a second
        np.arange(20_000) * 0.01,  # a page of writing
    ],
)
def test_hands_that_are_fast_or_slow_keep_their_clock(clock: np.ndarray) -> None:
    understood, found = times(clock.tolist())
    assert understood == [clock.tolist()]
    assert found == []


def test_no_stamps_at_all_are_an_assumption_not_a_repair() -> None:
    found = piece_times([None, None], [2, 3], False, 0.008, "f")
    assert found.stamps is None
    assert found.findings == [Finding("f", "no time stamps: points taken to be 8 ms apart", 1, "assumed")]


def test_as_many_stamps_as_points() -> None:
    with pytest.raises(InvalidInputError, match="as many as points, 3, found 2"):
        piece_times([np.array([0, 0.02])], [3], False, 0.01, "f")


def test_pieces_on_one_clock_come_in_the_order_they_were_drawn() -> None:
    found = piece_times([np.array([9, 9.1]), np.array([8, 8.1]), np.array([8.5, 8.6])], [2, 2, 2], False, 0.01, "f")
    assert found.order == [1, 2, 0]
    assert found.stamps is not None
    assert_allclose(np.concatenate(found.stamps), [-1, -0.9, -0.5, -0.4, 0, 0.1])
    assert not found.own
    assert [f.what for f in found.findings] == ["pieces that were out of order: put in the order of their clock"]


def test_pieces_that_all_start_at_the_same_time_have_clocks_of_their_own() -> None:
    found = piece_times([np.array([0, 0.04]), np.array([0, 0.02])], [2, 2], False, 0.01, "f")
    assert found.own
    assert found.order == [0, 1]


def test_only_pieces_that_overlap_are_shifted() -> None:
    stamps = [np.array([0, 0.1]), np.array([0.05, 0.2]), np.array([0.24, 0.3]), np.array([9, 9.1])]
    placed, found = place_pieces(stamps, own=False, gaps=[0.01, 0.02, 0.03], where="f")
    assert_allclose(np.concatenate(placed), [0, 0.1, 0.11, 0.26, 0.28, 0.34, 9, 9.1])
    assert [(f.what, f.number) for f in found] == [
        ("pieces whose clock begins anew or overlaps: put behind the one before", 2)
    ]


def test_a_piece_that_begins_a_little_early_is_lifted_not_shifted() -> None:
    placed, found = place_pieces([np.array([0, 0.1]), np.array([0.099, 0.2])], own=False, gaps=[1.0], where="f")
    assert_allclose(np.concatenate(placed), [0, 0.1, 0.1, 0.2])
    assert [f.number for f in found] == [1]


def test_pieces_with_clocks_of_their_own_are_all_shifted() -> None:
    placed, _ = place_pieces([np.array([0, 0.1]), np.array([5, 5.1])], own=True, gaps=[0.02], where="f")
    assert_allclose(np.concatenate(placed), [0, 0.1, 0.12, 0.22])


def test_equal_stamps_share_the_time_to_the_next() -> None:
    assert_allclose(spread_ties(np.array([0, 0, 0.03, 0.05, 0.05])), [0, 0.015, 0.03, 0.05, 0.0505])


def test_stamps_that_differ_by_rounding_are_equal() -> None:
    stamps = np.array([0, 0.1, 0.1 + 1e-17, 0.1 + 5e-10, 0.3])
    assert_allclose(spread_ties(stamps), [0, 0.1, 0.1 + 0.2 / 3, 0.1 + 0.4 / 3, 0.3])


@given(st.lists(st.integers(0, 20), min_size=2, max_size=40))
@settings(deadline=None, derandomize=True, max_examples=60)
def test_mended_stamps_rise_and_stay_between_their_neighbours(ticks: list[int]) -> None:
    stamps = np.sort(np.array(ticks, dtype=float))
    mended = spread_ties(stamps)
    assert (np.diff(mended) > 0).all()
    assert (mended >= stamps).all()
    assert (mended < stamps + 21).all()


def test_ties_of_a_clock_that_runs_backwards_are_refused_with_numbers_that_differ() -> None:
    with pytest.raises(InvalidInputError, match="a clock that runs forward, found 2 s then 1 s"):
        spread_ties(np.array([0, 2, 1.0]))
    with pytest.raises(InvalidInputError, match=r"found 1302126477\.139 s then 1302126477\.138 s"):
        spread_ties(np.array([1302126477.139, 1302126477.138]))
