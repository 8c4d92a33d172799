"""What is timed, in which order, and what becomes of the times; the clock is a fake one."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from signimit import InvalidInputError
from signimit_envs.timing import measuring
from signimit_envs.timing.measuring import Table, Timing, result_facts, result_page, time_in_turns


class Clock:
    """Stands still unless it is told that time passes; computing takes half of it."""

    def __init__(self) -> None:
        self.now = 0.0

    def read(self) -> tuple[float, float]:
        return self.now, self.now / 2

    def spend(self, seconds: float) -> None:
        self.now += seconds


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(measuring, "read_clock", clock.read)
    return clock


def test_ways_are_run_in_turns_and_prepared_before_each() -> None:
    did: list[object] = []
    ways = {"ours": lambda: did.append("ours"), "plain": lambda: did.append("plain")}
    times = time_in_turns(ways, 3, {"plain": did.append})
    assert did == ["ours", 0, "plain", "ours", 1, "plain", "ours", 2, "plain"]
    assert {name: taken.shape for name, taken in times.items()} == {"ours": (3, 2), "plain": (3, 2)}
    assert all((taken >= 0).all() for taken in times.values())


def test_preparing_is_not_timed(clock: Clock) -> None:
    (taken,) = time_in_turns({"a": lambda: clock.spend(2.0)}, 2, {"a": lambda turn: clock.spend(100.0)}).values()
    np.testing.assert_array_equal(taken, [[2.0, 1.0], [2.0, 1.0]])


def test_the_ratio_is_the_median_over_turns_and_times_are_the_least(clock: Clock) -> None:
    ours, plain = iter([3.0, 8.0, 5.0]), iter([2.0, 2.0, 1.0])  # ratios 1.5, 4, 5
    times = time_in_turns({"ours": lambda: clock.spend(next(ours)), "plain": lambda: clock.spend(next(plain))}, 3)
    assert Timing.of("work", times["ours"], times["plain"], limit=2.0) == ("work", 3.0, 1.0, 4.0, 2.0)
    assert Timing.of("work", times["ours"], times["plain"], pieces=2)[1:4] == (1.5, 0.5, 4.0)
    assert Timing.of("work", times["ours"]) == ("work", 3.0, None, None, None)


def test_something_must_be_timed() -> None:
    with pytest.raises(InvalidInputError, match="turns: expected at least 1, found 0"):
        time_in_turns({}, 0)


def test_a_result_says_how_it_was_measured() -> None:
    tables = [Table("first", "Some text.", [Timing("Δ", 0.25, 1.0, 0.25, 0.5), Timing("rest", 0.125)])]
    facts = json.loads(json.dumps(result_facts("timing core", {"turns": 3}, tables), allow_nan=False))
    assert facts["command"] == "timing core"
    assert facts["plan"] == {"turns": 3}
    assert facts["processors"] >= 1
    assert {"mujoco", "mink", "gymnasium", "numpy", "python"} <= set(facts["versions"])
    assert facts["first"][0] == {"work": "Δ", "seconds": 0.25, "plain": 1.0, "ratio": 0.25, "limit": 0.5}
    page = result_page("Core", facts, tables)
    assert page.startswith("# Core\n\nMade by `timing core` on ")
    assert "## First\n\nSome text.\n\n| work | seconds | plain | ratio | limit |\n| --- |" in page
    assert re.findall(r"^\| (?:Δ|rest) .*$", page, re.MULTILINE) == [
        "| Δ | 0.25 | 1 | 0.25 | 0.5 |",
        "| rest | 0.125 |  |  |  |",
    ]
