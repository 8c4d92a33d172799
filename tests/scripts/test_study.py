"""The study's program, on a session that somebody else has run."""

import json
import runpy
import sys
from pathlib import Path

import pytest

for package in ("tyro", "tqdm", "matplotlib", "sklearn"):
    pytest.importorskip(package)

SCRIPT = Path(__file__).parents[2] / "scripts" / "study.py"
CELL = "synthetic 2x2x1 plain"


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> None:
    monkeypatch.setattr(sys, "argv", ["study.py", *arguments])
    runpy.run_path(str(SCRIPT), run_name="__main__")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    record = {
        "cell": CELL, "seed": 0, "demonstrations": 4, "verdicts": {"paper": [1, 0, 1], "joint": [1, 1, 1]},
        "commands": [[0.9, 1], [0.6, 0]], "seconds": 0.1,
    }  # fmt: skip
    (tmp_path / "sessions.jsonl").write_text(json.dumps(record) + "\n")
    return tmp_path


def test_tables_and_figures_come_out_of_the_records(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run(monkeypatch, "cells", "--sessions", "1", "--only", CELL, "--out", str(folder))
    assert "| synthetic 2x2x1 plain | 1 | **100** [21, 100] | 0 |" in capsys.readouterr().out
    assert json.loads((folder / "cells.json").read_text())["beaten"] == []
    assert {"cells.csv", "cells.md", "cells.png"} <= {f.name for f in folder.iterdir()}
    run(monkeypatch, "calibration", "--out", str(folder))
    assert json.loads((folder / "calibration.json").read_text())["all"]["expected calibration error"] == 0.35


def test_reading_of_signs_is_written_beside_how_it_was_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(monkeypatch, "signs", "--sessions", "1", "--out", str(tmp_path))
    lines = (tmp_path / "signs.csv").read_text().splitlines()
    assert len(lines) == 1 + 8 * 3
    assert json.loads((tmp_path / "signs.json").read_text())["people"] == "synthetic"


def test_what_cannot_be_run_is_told_in_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for arguments, sentence in ((["cells", "--sessions", "0"], "cells: expected"), (["calibration"], "sessions; run")):
        with pytest.raises(SystemExit) as stop:
            run(monkeypatch, *arguments, "--out", str(tmp_path))
        assert stop.value.code == 2
        assert sentence in capsys.readouterr().err
