"""Intervals of shares."""

import pytest

from signimit.intervals import wilson_interval


def test_wilson_intervals_match_numbers_worked_by_hand() -> None:
    assert wilson_interval(20, 20) == pytest.approx((0.8389, 1.0), abs=1e-4)
    assert wilson_interval(5, 10) == pytest.approx((0.2366, 0.7634), abs=1e-4)
    assert wilson_interval(0, 0) == (0, 1)
