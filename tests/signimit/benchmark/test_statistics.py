"""Intervals know that commands of one session share its luck."""

import numpy as np
import pytest

from signimit.benchmark.statistics import (
    STAGES,
    Estimate,
    Share,
    estimate_misfit,
    estimate_share,
    estimate_stage,
    wilson_interval,
)


def interval(found: Estimate) -> tuple[float, float, float]:
    return found.mean, found.low, found.high


def test_wilson_intervals_match_numbers_worked_by_hand() -> None:
    assert wilson_interval(20, 20) == pytest.approx((0.8389, 1.0), abs=1e-4)
    assert wilson_interval(5, 10) == pytest.approx((0.2366, 0.7634), abs=1e-4)
    assert wilson_interval(0, 0) == (0, 1)


def test_a_share_knows_its_interval() -> None:
    assert Share(36, 36).interval == pytest.approx((0.9036, 1.0), abs=1e-4)
    assert Share(0, 0).interval == (0.0, 1.0)
    assert str(Share(5, 10)) == "5 of 10 (95 % interval 0.24 to 0.76)"


def test_independent_commands_count_each() -> None:
    """Sessions that do equally well tell nothing of clusters."""
    found = estimate_share([8, 8, 8, 8, 8], [9] * 5)
    assert interval(found) == pytest.approx((40 / 45, *wilson_interval(40, 45)))
    assert (found.total, found.count) == (40, 45)


def test_sessions_that_fail_as_a_whole_count_as_one_each() -> None:
    found = estimate_share([9, 9, 0, 9, 0, 9, 9, 9, 9, 9], [9] * 10)
    assert interval(found) == pytest.approx((0.8, *wilson_interval(8, 10)))


def test_clusters_between_the_two_give_an_interval_between_them() -> None:
    mixed = estimate_share([9, 9, 9, 2, 9, 9, 9, 9, 8, 9], [9] * 10)
    narrow, wide = wilson_interval(82, 90), wilson_interval(8.2, 10)
    assert wide[0] < mixed.low < narrow[0]


def test_nothing_wrong_and_nothing_right_have_wilsons_intervals() -> None:
    assert interval(estimate_share([9] * 20, [9] * 20))[1:] == pytest.approx(wilson_interval(180, 180))
    assert interval(estimate_share([0] * 20, [9] * 20))[1:] == pytest.approx(wilson_interval(0, 180))


def test_one_session_is_one_piece_of_luck() -> None:
    assert interval(estimate_share([9], [9])) == pytest.approx((1.0, *wilson_interval(1, 1)))


def test_a_rand_index_below_zero_lies_within_its_interval() -> None:
    found = estimate_share([-0.1, -0.02], [1, 1])
    assert found.low == found.mean < 0 < found.high


def test_intervals_of_clustered_commands_hold_what_they_promise() -> None:
    """Of sessions whose chance of success varies, 95 % of the intervals hold the true share, give or take."""
    rng = np.random.default_rng(0)
    held = 0
    for _ in range(400):
        chances = rng.beta(2, 1, 20)
        found = estimate_share(rng.binomial(9, chances), [9] * 20)
        held += found.low <= 2 / 3 <= found.high
    assert 0.92 <= held / 400 <= 0.99


def test_the_misfits_interval_is_students_of_the_sessions() -> None:
    found = estimate_misfit([0.9, 1.8], [9, 9], 1.0)
    half = 12.7062 * np.sqrt(0.005 / 2)
    assert found.mean == pytest.approx(0.15)
    assert found.low == 0.0
    assert found.high == pytest.approx(0.15 + half, abs=1e-4)
    assert interval(estimate_misfit([9.0, 21.6], [9, 9], 3.0))[2] == 3.0
    assert interval(estimate_misfit([0.9], [9], 3.0))[1:] == (0.0, 3.0)


RECORDS = [
    {"obeyed": [1, 1, 1, 0], "misfit": [0.1] * 4, "read": [2, 2, 1, 2], "families": [0, 0, 1, 1], "groups": 1.0},
    {"obeyed": [1, 1, 1, 1], "misfit": [0.3] * 4, "read": [2, 2, 2, 2], "families": [1, 0, 1, 0], "groups": 0.5},
]


def test_stages_are_counted_by_hand() -> None:
    totals = {stage: (e.total, e.count) for stage in STAGES if (e := estimate_stage(stage, RECORDS, 3.0))}
    assert totals == {
        "obeyed": (7, 8),
        "misfit": (pytest.approx(1.6), 8),
        "read": (15, 16),
        "families": (3, 4),
        "groups": (1.5, 2),
    }


def test_a_stage_that_one_session_does_not_tell_is_not_scored() -> None:
    assert estimate_stage("focus", [*RECORDS], 3.0) is None
    assert estimate_stage("groups", [RECORDS[0], {"obeyed": [1]}], 3.0) is None
    assert estimate_stage("obeyed", [], 3.0) is None
