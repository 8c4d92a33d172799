"""The studies that compare policies."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import savemat

pytest.importorskip("tyro", reason="commands need signimit[scripts]")
pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")


def test_the_study_writes_table_trials_facts_and_a_picture_of_each_kind(run: Any, tmp_path: Path) -> None:
    options = ["--labels", "circle", "star", "--kinds", "path-following", "knn", "--sessions", 1, "--starts", 2]
    said = run("study", "policies", *options, "--out", tmp_path / "study")
    assert "| path-following | 2 | 4 | 100.0 % [" in said
    trials = list(csv.DictReader((tmp_path / "study" / "trials.csv").read_text().splitlines()))
    assert [t["label"] for t in trials] == ["circle", "circle", "star", "star"]
    facts = json.loads((tmp_path / "study" / "study.json").read_text())
    assert set(facts["kinds"]) == {"path-following", "knn"}
    for kind in facts["kinds"]:
        assert (tmp_path / "study" / f"{kind}.png").read_bytes().startswith(b"\x89PNG")


def test_lasa_prints_a_line_for_each_kind(run: Any, tmp_path: Path) -> None:
    times = np.linspace(0, 2, 100)[None]
    demos = np.empty((1, 2), dtype=object)
    for i in range(2):
        demos[0, i] = {"pos": np.array([[-30.0], [20.0 + i]]) * (1 - times / 2) ** 2, "t": times}
    savemat(tmp_path / "Line.mat", {"demos": demos, "dt": 0.02})
    said = run(
        "study", "lasa", "--folder", tmp_path, "--kinds", "path-following", "dmp", "--out", tmp_path / "lasa.csv"
    )
    assert "path-following" in said
    assert "dmp" in said
    assert len((tmp_path / "lasa.csv").read_text().splitlines()) == 3


def test_an_unknown_kind_is_refused_in_one_sentence(
    run: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--kinds", "magic", "--labels", "circle", "--sessions", 1]
    with pytest.raises(SystemExit) as stop:
        run("study", "policies", *options, "--out", tmp_path / "x")
    assert stop.value.code == 2
    assert "magic" in capsys.readouterr().err.splitlines()[-1]
    assert not (tmp_path / "x").exists()
