"""`study paper`, on one session and one factor."""

import csv
import json
from pathlib import Path
from typing import Any

import pytest

for package in ("tyro", "tqdm", "matplotlib"):
    pytest.importorskip(package)


def test_levels_are_written_with_counts_intervals_and_seeds(run: Any, tmp_path: Path, monkeypatch: Any) -> None:
    from signimit_envs.cli import study_paper

    monkeypatch.setattr(study_paper, "CONTRASTS", (2.0, 8.0))
    monkeypatch.setattr(study_paper, "SPREADS", (0.1, 0.5))
    said = run("study", "paper", "--sessions", "1", "--only", "speed of", "--workers", "1", "--out", tmp_path)
    assert "| speed of the hand | constant | " in said
    facts = json.loads((tmp_path / "study.json").read_text())
    assert facts["seeds"] == [0, 0]
    assert facts["people"] == ["built-in"]
    assert facts["command"].startswith("python -m signimit study paper --sessions 1")
    levels = list(csv.DictReader((tmp_path / "levels.csv").read_text().splitlines()))
    assert [row["value"] for row in levels] == ["mean of the outputs", "constant"]
    assert all(float(row["right_low"]) <= float(row["right"]) <= float(row["right_high"]) for row in levels)
    assert len((tmp_path / "gamma.csv").read_text().splitlines()) == 1 + 4


def test_a_factor_that_there_is_not_is_told_in_a_sentence(run: Any, tmp_path: Path) -> None:
    assert "part of the name of a factor" in run.refusal("study", "paper", "--only", "weather", "--out", tmp_path)
