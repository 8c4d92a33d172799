"""The throughput program writes what it measured, whole or not at all."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from signimit_envs.timing.throughput import report
from signimit_envs.timing.throughput.batches import Agreement, BatchSpeed
from signimit_envs.timing.throughput.parts import Part
from signimit_envs.timing.throughput.vector_envs import WayToStep
from signimit_envs.timing.throughput.work import ThroughputPlan

pytest.importorskip("tyro")


def measured(plan: ThroughputPlan) -> report.Throughput:
    speeds = [BatchSpeed(batch, threads, 11.0, 10.5, 6.0) for batch in plan.batches for threads in plan.threads]
    parts = [Part("everything", 1.0, 0.09)]
    return report.Throughput(speeds, [Agreement("knn", 18, 1e-6, 18)], parts, [WayToStep("a loop", 1.0)])


def test_the_page_and_the_numbers_are_written_and_shown(
    run: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("signimit_envs.cli.throughput.measure_throughput", measured)
    said = run("throughput", "--batches", "9", "64", "--threads", "0", "--out", tmp_path / "out")
    page = (tmp_path / "out" / "throughput.md").read_text()
    assert page in said
    assert "| 64 | all | 11.0 x | 10.5 x | 6.0 x |" in page
    facts = json.loads((tmp_path / "out" / "throughput.json").read_text())
    assert facts["command"].startswith("python -m signimit throughput --batches 9 64")
    assert [row["batch"] for row in facts["batches"]] == [9, 64]


def test_bad_input_is_told_in_one_sentence_and_nothing_is_written(run: Any, tmp_path: Path) -> None:
    said = run.refusal("throughput", "--turns", "0", "--out", tmp_path / "out")
    assert said == "throughput: turns: expected at least 1, found 0.\n"
    assert not list(tmp_path.iterdir())
