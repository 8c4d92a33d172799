"""Records survive a kill, and are counted by hand."""

import json
from pathlib import Path

import pytest

pytest.importorskip("sklearn", reason="the study needs scikit-learn")

from signimit.benchmark.studies.cells import Cell
from signimit.benchmark.studies.records import OURS, append_record, read_records, run_session, run_sessions
from signimit.benchmark.studies.tables import beaten_cells, markdown, tabulate


def record(cell: str, seed: int, ours: list[int], theirs: list[int]) -> dict[str, object]:
    return {"cell": cell, "seed": seed, "verdicts": {"other": theirs, OURS: ours}}


def test_a_line_torn_by_a_kill_is_cut_off_and_the_rest_kept(tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "sessions.jsonl"
    append_record(path, record("a", 0, [1, 1, 1], [0, 0, 0]))
    with path.open("a") as file:
        file.write('{"cell": "a", "se')
    assert [r["seed"] for r in read_records(path)] == [0]
    append_record(path, record("a", 1, [1, 1, 1], [0, 0, 0]))
    assert [r["seed"] for r in read_records(path)] == [0, 1]


def test_what_was_run_is_not_run_again(tmp_path: Path) -> None:
    path, cell = tmp_path / "sessions.jsonl", Cell(movements=2, objects=2, repetitions=1)
    append_record(path, record(cell.name, 0, [1, 1, 1], [0, 0, 0]))
    assert list(run_sessions(run_session, [cell], [0], path, None, 1)) == []
    assert len(read_records(path)) == 1


def test_a_session_becomes_a_line_of_json() -> None:
    result = run_session(Cell(movements=2, objects=2, repetitions=1), 0, None)
    assert json.loads(json.dumps(result))["verdicts"][OURS] == result["verdicts"][OURS]
    assert result["demonstrations"] == len(result["commands"]) == 4


def test_rows_are_counts_with_intervals_ours_first() -> None:
    records = [record("a", s, [1, 1, int(s > 0)], [1, 0, 1]) for s in range(10)]
    ours, other = tabulate(records)
    assert ours[:7] == ("a", OURS, 10, 10, 10, 9, 9)
    assert other[:7] == ("a", "other", 10, 10, 0, 10, 0)
    assert (ours.all_low, ours.all_high) == (0.596, 0.982)
    assert markdown([ours, other]).splitlines()[-1] == "| a | 10 | **90** [60, 98] | 0 |"


def test_a_cell_in_which_a_baseline_is_better_is_named() -> None:
    rows = tabulate([record("a", 0, [1, 0, 1], [1, 1, 1]), record("b", 0, [1, 1, 1], [1, 1, 1])])
    assert beaten_cells(rows) == [("a", "other", 1, 0)]
