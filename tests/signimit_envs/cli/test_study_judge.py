"""The study of the judge, from libraries of real people and built-in ones."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.teaching.people import synthetic_library

for package in ("tyro", "tqdm"):
    pytest.importorskip(package)


def test_the_study_prints_a_table_and_writes_it_with_its_thresholds(run: Any, tmp_path: Path) -> None:
    library = synthetic_library(("circle", "triangle up", "star"), samples=6, rng=np.random.default_rng(5))
    library.save(tmp_path / "people.npz")
    said = run("study", "judge", tmp_path / "people.npz", "--built-in", 1, "--sessions", 1, "--out", tmp_path / "out")
    assert "| built-in | own, drawn once | 3 | 100.0% |" in said
    assert "| synthetic | own, drawn once | 3 | 100.0% |" in said
    rows = list(csv.DictReader((tmp_path / "out" / "acceptance.csv").read_text().splitlines()))
    assert {row["people"] for row in rows} == {"built-in", "synthetic"}
    assert (tmp_path / "out" / "acceptance.md").read_text().strip() in said
    facts = json.loads((tmp_path / "out" / "judge.json").read_text())
    assert set(facts["chosen without"]) == {"built-in 1", "synthetic synthetic 1"}


def test_nobody_to_judge_is_told_in_a_sentence(run: Any, tmp_path: Path) -> None:
    assert "at least 1 session" in run.refusal("study", "judge", "--sessions", 0, "--out", tmp_path)
