"""What is timed is the same work in every way; no time is asked about here."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from signimit import InvalidInputError
from signimit_envs.timing.throughput.batches import compare_paths, measure_batches
from signimit_envs.timing.throughput.parts import REST, WHOLE, Part, measure_parts
from signimit_envs.timing.throughput.report import Throughput, markdown, report
from signimit_envs.timing.throughput.vector_envs import WayToStep, measure_vector_envs
from signimit_envs.timing.throughput.work import ThroughputPlan, Work, compose_work

PLAN = ThroughputPlan(batches=(1, 4), threads=(1, 2), parts_of=4, seconds=1.0, turns=1)


@pytest.fixture(scope="module")
def work() -> Work:
    return compose_work(12)


@pytest.fixture(scope="module")
def measured(work: Work) -> Throughput:
    return Throughput(
        measure_batches(work, PLAN),
        [compare_paths(work.first(3), 4.0)],
        measure_parts(work.first(4), 1.0, turns=1),
        [WayToStep("a loop", 1.0), WayToStep("together", 1.25)],
    )


def test_there_is_as_much_work_as_asked_for_each_in_its_own_scene(work: Work) -> None:
    assert len(work.policies) == len(work.scenes) == 12
    assert len({hand.tobytes() for hand in work.hands}) == 12
    assert len({policy.place.tobytes() for policy in work.policies}) == 12


def test_the_same_seed_is_the_same_work(work: Work) -> None:
    again = compose_work(12)
    np.testing.assert_array_equal(again.hands, work.hands)
    for one, other in zip(again.policies, work.policies, strict=True):
        np.testing.assert_array_equal(one(work.hands), other(work.hands))


def test_both_ways_agree(measured: Throughput) -> None:
    (agreement,) = measured.agreements
    assert agreement.kind == "path-following"
    assert agreement.reproductions == agreement.same_verdicts == 3
    assert agreement.largest_gap <= 0.5e-3


def test_every_batch_is_timed_with_every_number_of_threads(measured: Throughput) -> None:
    assert [(row.batch, row.threads) for row in measured.batches] == [(1, 1), (1, 2), (4, 1), (4, 2)]
    assert all(0 < row.lowest <= row.faster and row.computing > 0 for row in measured.batches)


def test_all_ways_to_step_environments_are_compared_with_the_loop() -> None:
    first, *others = measure_vector_envs(1, 0.1, turns=1)
    assert first == WayToStep("a loop over `gym.make(...)`", 1.0)
    assert {"`SyncVectorEnv`", "`AsyncVectorEnv`"} < {way.name for way in others}
    assert all(way.time > 0 for way in others)


def test_parts_and_rest_are_the_whole(measured: Throughput) -> None:
    whole, *parts = measured.parts
    assert (whole.name, whole.alone, parts[-1].name) == (WHOLE, 1.0, REST)
    assert sum(part.alone for part in parts) == pytest.approx(1.0)
    assert sum(part.together or 0.0 for part in parts) == pytest.approx(whole.together)
    assert [part.name for part in parts if part.together is None] == ["judge"]


def test_the_page_has_a_row_for_everything_measured(measured: Throughput) -> None:
    page = markdown(measured, PLAN, "throughput --turns 1")
    assert "Made by `throughput --turns 1`" in page
    for row in measured.batches:
        assert f"| {row.batch} | {row.threads} | {row.faster:.1f} x |" in page
    for part in measured.parts:
        assert f"| {part.name} | {100 * part.alone:.1f} |" in page
    assert "| together | 1.25 |" in page
    assert "| path-following | 3 of 3 | 0.0000 mm |" in page


def test_all_processors_are_called_so(measured: Throughput) -> None:
    fast = measured._replace(batches=[measured.batches[0]._replace(threads=0)], parts=[Part(WHOLE, 1.0, None)])
    page = markdown(fast, PLAN, "throughput")
    assert "| 1 | all |" in page
    assert f"| {WHOLE} | 100.0 |  |" in page


def test_the_report_is_json_and_says_how_it_was_made(measured: Throughput) -> None:
    facts = json.loads(json.dumps(report(measured, PLAN, "throughput"), allow_nan=False))
    assert facts["command"] == "throughput"
    assert {"mujoco", "mink", "gymnasium", "numpy", "python"} <= set(facts["versions"])
    assert [row["batch"] for row in facts["batches"]] == [1, 1, 4, 4]
    assert facts["agreements"][0]["reproductions"] == 3


@pytest.mark.parametrize(
    "wrong",
    [
        {"batches": ()},
        {"batches": (9, 0)},
        {"threads": (-1,)},
        {"parts_of": 0},
        {"envs": 0},
        {"turns": 0},
        {"seconds": 0.5},
        {"seconds": float("nan")},
    ],
)
def test_a_plan_without_anything_to_measure_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(InvalidInputError, match=next(iter(wrong))):
        ThroughputPlan(**wrong)
