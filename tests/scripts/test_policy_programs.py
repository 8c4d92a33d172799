"""The programs that compare policies."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

pytest.importorskip("tyro")
pytest.importorskip("matplotlib")
SCRIPTS = Path(__file__).parents[2] / "scripts"


def run(script: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(SCRIPTS / script), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_the_study_writes_table_trials_facts_and_a_picture_of_each_kind(tmp_path: Path) -> None:
    options = [
        "--labels",
        "circle",
        "star",
        "--kinds",
        "path-following",
        "knn",
        "--sessions",
        1,
        "--starts",
        2,
    ]
    done = run("policies.py", *options, "--out", tmp_path / "study")
    assert done.returncode == 0, done.stderr
    assert "| path-following | 100.0 %" in done.stdout
    trials = list(csv.DictReader((tmp_path / "study" / "trials.csv").read_text().splitlines()))
    assert [t["label"] for t in trials] == ["circle", "circle", "star", "star"]
    facts = json.loads((tmp_path / "study" / "study.json").read_text())
    assert set(facts["kinds"]) == {"path-following", "knn"}
    for kind in facts["kinds"]:
        assert (tmp_path / "study" / f"{kind}.png").read_bytes().startswith(b"\x89PNG")


def test_lasa_prints_a_line_for_each_kind(tmp_path: Path) -> None:
    times = np.linspace(0, 2, 100)[None]
    demos = np.empty((1, 2), dtype=object)
    for i in range(2):
        demos[0, i] = {"pos": np.array([[-30.0], [20.0 + i]]) * (1 - times / 2) ** 2, "t": times}
    savemat(tmp_path / "Line.mat", {"demos": demos, "dt": 0.02})
    done = run("lasa.py", "--folder", tmp_path, "--kinds", "path-following", "dmp", "--out", tmp_path / "lasa.csv")
    assert done.returncode == 0, done.stderr
    assert "path-following" in done.stdout
    assert "dmp" in done.stdout
    assert len((tmp_path / "lasa.csv").read_text().splitlines()) == 3


def test_an_unknown_kind_is_refused_in_one_sentence(tmp_path: Path) -> None:
    done = run("policies.py", "--kinds", "magic", "--labels", "circle", "--sessions", 1, "--out", tmp_path / "x")
    assert done.returncode == 2
    assert "magic" in done.stderr.splitlines()[-1]
    assert not (tmp_path / "x").exists()
