"""The studies, on a session that was run before."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.judge import CRITERION, judge_hash
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library

for package in ("tyro", "tqdm", "matplotlib", "sklearn"):
    pytest.importorskip(package)

CELL = "synthetic 2x2x1 plain"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    record = {
        "cell": CELL, "seed": 0, "demonstrations": 4, "verdicts": {"paper": [1, 0, 1], "joint": [1, 1, 1]},
        "commands": [[0.9, 1], [0.6, 0]], "seconds": 0.1,
    }  # fmt: skip
    (tmp_path / "sessions.jsonl").write_text(json.dumps(record) + "\n")
    return tmp_path


def test_tables_and_figures_come_out_of_the_records(run: Any, folder: Path) -> None:
    said = run("study", "cells", "--sessions", "1", "--only", CELL, "--out", folder)
    assert "| synthetic 2x2x1 plain | 1 | **100** [21, 100] | 0 [0, 79] |" in said
    facts = json.loads((folder / "cells.json").read_text())
    assert facts["beaten"] == []
    assert facts["command"].startswith("python -m signimit study cells --sessions 1 --only 'synthetic ")
    assert {"cells.csv", "cells.md", "cells.png"} <= {f.name for f in folder.iterdir()}
    run("study", "calibration", "--out", folder)
    assert json.loads((folder / "calibration.json").read_text())["all"]["expected calibration error"] == 0.35


def test_reading_of_signs_is_written_beside_how_it_was_measured(run: Any, tmp_path: Path) -> None:
    run("study", "signs", "--sessions", "1", "--out", tmp_path)
    lines = (tmp_path / "signs.csv").read_text().splitlines()
    assert len(lines) == 1 + 8 * 3
    assert json.loads((tmp_path / "signs.json").read_text())["people"] == "synthetic"


def test_real_people_take_part_from_files_as_they_are_shared(run: Any, tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    for name, labels in (("signs", PAPER_LANGUAGE.signs), ("movements", PAPER_LANGUAGE.movements)):
        synthetic_library(labels, samples=10, rng=rng).save(tmp_path / f"{name}.npz")
    files = "--signs", tmp_path / "signs.npz", "--movements", tmp_path / "movements.npz"
    said = run("study", "real-people", *files, "--workers", 1, "--out", tmp_path / "out")
    assert CRITERION in said
    assert "| all | `joint` | 1 | 1 of 1: 100.0 % [20.7, 100.0] |" in said
    facts = json.loads((tmp_path / "out" / "people.json").read_text())
    assert (facts["signer"], facts["mover"], facts["judge"]) == (1, 1, judge_hash())
    assert (tmp_path / "out" / "people.md").read_text().strip() in said
    assert len((tmp_path / "out" / "people.csv").read_text().splitlines()) == 1 + 3 * 2


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["cells", "--sessions", "0"], "cells: expected"),
        (["cells", "--workers", "-1"], "workers: expected 1 or more"),
        (["cells", "--only", "nothing"], "--only: expected part of the name of a cell (synthetic 2x2x1 plain; "),
        (["calibration"], "sessions; run"),
    ],
)
def test_what_cannot_be_run_is_told_in_a_sentence(
    run: Any, tmp_path: Path, arguments: list[str], sentence: str
) -> None:
    assert sentence in run.refusal("study", *arguments, "--out", tmp_path)
