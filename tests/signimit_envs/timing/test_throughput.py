"""What is timed is the same work in every way; the times are not looked at."""

from __future__ import annotations

import numpy as np
import pytest

from signimit_envs.timing.throughput import (
    REST,
    WHOLE,
    Part,
    Work,
    compare_paths,
    compose_work,
    measure_batches,
    measure_parts,
)


@pytest.fixture(scope="module")
def work() -> Work:
    return compose_work(12)


def test_there_is_as_much_work_as_asked_for_each_in_its_own_scene(work: Work) -> None:
    assert len(work.policies) == len(work.commands) == 12
    assert len({hand.tobytes() for hand in work.hands}) == 12
    assert len({policy.place.tobytes() for policy in work.policies}) == 12


def test_the_same_seed_is_the_same_work(work: Work) -> None:
    again = compose_work(12)
    np.testing.assert_array_equal(again.hands, work.hands)
    for one, other in zip(again.policies, work.policies, strict=True):
        np.testing.assert_array_equal(one(work.hands), other(work.hands))


def test_both_ways_agree(work: Work) -> None:
    agreement = compare_paths(work.first(3), 4.0)
    assert agreement.kind == "path-following"
    assert agreement.reproductions == agreement.same_verdicts == 3
    assert agreement.largest_gap <= 0.5e-3


def test_every_batch_is_timed_with_every_number_of_threads(work: Work) -> None:
    rows = measure_batches(work, batches=(1, 4), threads=(1, 2), seconds=1.0, turns=1)
    assert [(row.batch, row.threads) for row in rows] == [(1, 1), (1, 2), (4, 1), (4, 2)]
    assert all(0 < row.lowest <= row.faster and row.computing > 0 for row in rows)


def test_a_batch_is_rated_by_reproductions_and_not_by_calls(work: Work, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where every call takes 2 s by the clock and 1 s of computing, nine alone take as long as four at once."""
    readings = iter(np.arange(100.0))
    monkeypatch.setattr("signimit_envs.timing.measuring.read_clock", lambda: (2 * (now := next(readings)), now))
    rows = measure_batches(work, batches=(4,), threads=(1,), seconds=1.0, turns=1)
    ((batch, threads, *ratios),) = rows
    assert (batch, threads) == (4, 1)
    assert ratios == pytest.approx([4 / 9] * 3)


def test_parts_and_rest_are_the_whole(work: Work) -> None:
    whole, *parts = measure_parts(work.first(4), 1.0, turns=1)
    assert (whole.name, whole.alone, parts[-1].name) == (WHOLE, 1.0, REST)
    assert sum(part.alone for part in parts) == pytest.approx(1.0)
    assert sum(part.together or 0.0 for part in parts) == pytest.approx(whole.together)
    assert [part.name for part in parts if part.together is None] == ["judge"]
    assert all(isinstance(part, Part) for part in parts)
