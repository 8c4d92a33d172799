"""`study assumptions`, on one session of one kind."""

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from signimit.learners.joint.objective import PEOPLE

for package in ("tyro", "tqdm", "matplotlib", "sklearn"):
    pytest.importorskip(package)


def test_both_tables_are_printed_and_written_with_how_they_were_made(run: Any, tmp_path: Path) -> None:
    said = run(
        "study", "assumptions", "--sessions", 1, "--only", "3x3x1 plain", "--workers", 1, "--out", tmp_path / "out"
    )
    for name in ("assumptions.md", "ablations.md"):
        assert (tmp_path / "out" / name).read_text().strip() in said
    rows = list(csv.DictReader((tmp_path / "out" / "settings.csv").read_text().splitlines()))
    assert {row["cell"] for row in rows} == {"synthetic 3x3x1 plain", "all"}
    assert {(row["sessions"], row["words"]) for row in rows} == {("1", "18")}
    facts = json.loads((tmp_path / "out" / "assumptions.json").read_text())
    assert facts["command"].startswith("python -m signimit study assumptions --sessions 1 --only '3x3x1 plain'")
    assert facts["assumptions"] == PEOPLE._asdict()
    assert (facts["seeds"], facts["people"]) == ([0, 0], ["synthetic"])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--sessions", "0"], "assumptions: expected at least 1 session"),
        (["--workers", "-1"], "assumptions: expected at least 1 session and no fewer than 0 workers"),
        (["--signs", "digits.npz"], "assumptions: expected libraries of signs and of movements, or neither"),
        (["--only", "weather"], "--only: expected part of the name of a cell (synthetic 3x3x2 plain; "),
    ],
)
def test_what_cannot_be_run_is_told_in_a_sentence(
    run: Any, tmp_path: Path, arguments: list[str], sentence: str
) -> None:
    assert sentence in run.refusal("study", "assumptions", *arguments, "--out", tmp_path / "out")
    assert not (tmp_path / "out").exists()
