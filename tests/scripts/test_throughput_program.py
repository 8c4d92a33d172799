"""The throughput program writes what it measured, whole or not at all."""

from __future__ import annotations

import json
import runpy
import sys
from pathlib import Path

import pytest

from signimit_envs.timing.throughput import report
from signimit_envs.timing.throughput.batches import Agreement, BatchSpeed
from signimit_envs.timing.throughput.parts import Part
from signimit_envs.timing.throughput.vector_envs import WayToStep
from signimit_envs.timing.throughput.work import ThroughputPlan

pytest.importorskip("tyro")
PROGRAM = Path(__file__).parents[2] / "scripts" / "throughput.py"


def run(*arguments: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [str(PROGRAM), *arguments])
    runpy.run_path(str(PROGRAM), run_name="__main__")


def measured(plan: ThroughputPlan) -> report.Throughput:
    speeds = [BatchSpeed(batch, threads, 11.0, 10.5, 6.0) for batch in plan.batches for threads in plan.threads]
    parts = [Part("everything", 1.0, 0.09)]
    return report.Throughput(speeds, [Agreement("knn", 18, 1e-6, 18)], parts, [WayToStep("a loop", 1.0)])


def test_the_page_and_the_numbers_are_written_and_shown(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setattr(report, "measure_throughput", measured)
    arguments = ("--batches", "9", "64", "--threads", "0", "--out", str(tmp_path / "out"))
    run(*arguments, monkeypatch=monkeypatch)
    page = (tmp_path / "out" / "throughput.md").read_text()
    assert page in capsys.readouterr().out
    assert "| 64 | all | 11.0 x | 10.5 x | 6.0 x |" in page
    facts = json.loads((tmp_path / "out" / "throughput.json").read_text())
    assert facts["command"].startswith("sh scripts/run.sh throughput --batches 9 64")
    assert [row["batch"] for row in facts["batches"]] == [9, 64]


def test_bad_input_is_told_in_one_sentence_and_nothing_is_written(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    with pytest.raises(SystemExit) as stop:
        run("--turns", "0", "--out", str(tmp_path / "out"), monkeypatch=monkeypatch)
    assert stop.value.code == 2
    assert capsys.readouterr().err == "throughput: turns: expected at least 1, found 0.\n"
    assert not list(tmp_path.iterdir())
