"""The studies, on a session that was run before."""

import json
from pathlib import Path
from typing import Any

import pytest

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
    assert "| synthetic 2x2x1 plain | 1 | **100** [21, 100] | 0 |" in said
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


@pytest.mark.parametrize(
    ("arguments", "sentence"), [(["cells", "--sessions", "0"], "cells: expected"), (["calibration"], "sessions; run")]
)
def test_what_cannot_be_run_is_told_in_a_sentence(
    run: Any, tmp_path: Path, arguments: list[str], sentence: str
) -> None:
    assert sentence in run.refusal("study", *arguments, "--out", tmp_path)
