"""Records survive a kill, and are counted by hand."""

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("sklearn", reason="the study needs scikit-learn")

from signimit.benchmark.studies.conditions import compose_study_session, study_condition
from signimit.benchmark.studies.running import ask_with_confidence, run_session, run_sessions
from signimit.benchmark.studies.tables import OURS, beaten_cells, calibrate, shares_table, tabulate
from signimit.io.safe_files import append_record, read_records
from signimit.learning import learn


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
    path, condition = tmp_path / "sessions.jsonl", study_condition(2, 2, 1)
    append_record(path, record(condition.name, 0, [1, 1, 1], [0, 0, 0]))
    assert list(run_sessions(run_session, [condition], [0], path, 1)) == []
    assert len(read_records(path)) == 1


def test_a_session_becomes_a_line_of_json() -> None:
    result = run_session(study_condition(2, 2, 1), 0)
    assert json.loads(json.dumps(result))["verdicts"][OURS] == result["verdicts"][OURS]
    assert result["demonstrations"] == len(result["commands"]) == 4


def test_rows_are_counts_with_intervals_ours_first() -> None:
    records = [record("a", s, [1, 1, int(s > 0)], [1, 0, 1]) for s in range(10)]
    ours, other = tabulate(records)
    assert ours[:7] == ("a", OURS, 10, 10, 10, 9, 9)
    assert other[:7] == ("a", "other", 10, 10, 0, 10, 0)
    assert (ours.all_low, ours.all_high) == (0.596, 0.982)
    assert shares_table([ours, other]).splitlines()[-1] == "| a | 10 | **90** [60, 98] | 0 [0, 28] |"


def test_a_cell_in_which_a_baseline_is_better_is_named() -> None:
    rows = tabulate([record("a", 0, [1, 0, 1], [1, 1, 1]), record("b", 0, [1, 1, 1], [1, 1, 1])])
    assert beaten_cells(rows) == [("a", "other", 1, 0)]


def test_every_command_has_a_confidence_and_a_verdict() -> None:
    session = compose_study_session(study_condition(2, 2, 2), 1)
    asked = ask_with_confidence(learn(session.demonstrations, policy="knn"), session)
    assert len(asked) == 4
    assert all(0 < sure <= 1 for sure, _ in asked)
    assert sum(right for _, right in asked) == 4


def test_calibration_of_four_commands_by_hand() -> None:
    found = calibrate([0.95, 0.95, 0.55, 1.0], [1, 0, 1, 1])
    np.testing.assert_allclose(found.confidence, [0.55, 2.9 / 3])
    np.testing.assert_allclose(found.accuracy, [1, 2 / 3])
    assert found.counts.tolist() == [1, 3]
    assert found.error == pytest.approx((0.45 + 3 * 0.3) / 4)
    np.testing.assert_allclose(found.coverage, [0.25, 0.5, 0.75, 1])
    np.testing.assert_allclose(found.risk, [0, 0, 1 / 3, 1 / 4])
