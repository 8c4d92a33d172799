"""Assumptions are scaled one at a time, each is explained, and only sound demonstrations count."""

import numpy as np
import pytest

from signimit.benchmark.studies import assumptions as study
from signimit.benchmark.studies.assumptions import (
    ABLATIONS,
    ALL,
    FULL,
    KINDS,
    PAPER,
    ablation_table,
    assumption_conditions,
    assumption_settings,
    assumptions_table,
    describe_assumptions,
    run_settings,
    tabulate_settings,
)
from signimit.benchmark.studies.conditions import Recordings, study_condition
from signimit.io.safe_files import Record
from signimit.learners.joint.objective import PEOPLE, Assumptions
from signimit.teaching.people import synthetic_library


def test_every_assumption_is_halved_and_doubled_alone() -> None:
    settings = assumption_settings()
    assert len(settings) == len(ABLATIONS) + 2 * len(Assumptions._fields)
    for name, value in PEOPLE._asdict().items():
        for factor in (0.5, 2.0):
            changed = settings[f"{name} x {factor:g}"]._asdict()
            assert changed.pop(name) == factor * value
            assert changed.items() < PEOPLE._asdict().items()


def test_every_assumption_is_described() -> None:
    described = describe_assumptions()
    assert tuple(described) == Assumptions._fields
    assert all(described.values())
    assert described["slope"] == "Nats that a unit of dissimilarity counts"
    assert not any("  " in said for said in described.values())


def test_kinds_are_of_synthetic_people_and_of_real_ones_where_there_are_any() -> None:
    library = synthetic_library(("circle",), samples=1, rng=np.random.default_rng(0))
    names = [c.name for c in assumption_conditions(Recordings(library, library))]
    assert len(set(names)) == len(names) == 2 * len(KINDS)
    assert sum(name.startswith("real ") for name in names) == len(assumption_conditions()) == len(KINDS)


WRONG = study_condition(2, 3, 2, "1 wrong")


@pytest.fixture(scope="module")
def wrong() -> Record:
    return run_settings(WRONG, 0)


def test_a_wrong_answer_is_seen_through_and_does_not_count(wrong: Record) -> None:
    assert wrong["scores"][FULL] == (1, wrong["asked"])
    assert wrong["asked"] == 2 * 6
    assert wrong["scores"].keys() == {*assumption_settings(), PAPER}


def test_settings_that_come_to_other_conclusions_do_not_share_a_score(
    monkeypatch: pytest.MonkeyPatch, wrong: Record
) -> None:
    chosen = ("without words", "movement_price x 2")
    for name in chosen:
        monkeypatch.setattr(study, "assumption_settings", lambda name=name: {name: assumption_settings()[name]})
        assert run_settings(WRONG, 0)["scores"][name] == wrong["scores"][name]
    assert wrong["scores"]["without words"] != wrong["scores"][FULL]


def records() -> list[Record]:
    names = (*assumption_settings(), PAPER)
    scores = {name: (1, 4) for name in names}
    return [
        {"cell": "one", "seed": 0, "asked": 4, "scores": scores},
        {"cell": "one", "seed": 1, "asked": 4, "scores": scores | {"slope x 2": (0, 3), PAPER: (0, 2)}},
        {"cell": "other", "seed": 0, "asked": 8, "scores": {name: (1, 8) for name in names}},
    ]


def test_sessions_and_words_are_counted_by_kind_and_in_all() -> None:
    rows = {(row.cell, row.setting): row for row in tabulate_settings(records())}
    one, both = rows["one", PAPER], rows[ALL, PAPER]
    assert (one.sessions, one.right, one.words, one.read) == (2, 1, 8, 6)
    assert (both.sessions, both.right, both.words, both.read) == (3, 2, 16, 14)
    assert one.low < 0.5 < one.high
    assert one.read_low < 0.75 < one.read_high
    assert rows["other", FULL].right == 1


def test_tables_have_a_line_for_each_kind_and_each_assumption() -> None:
    rows = tabulate_settings(records())
    lines = ablation_table(rows).splitlines()
    assert (
        lines[0]
        == "| sessions | n | full model | without mistakes | without words | without imbalance price | the paper |"
    )
    assert [line.split(" | ")[:2] for line in lines[2:]] == [["| one", "2"], ["| other", "1"], ["| all", "3"]]
    assert lines[2].endswith("| 50.0 [9, 91]; 75.0 [26, 96] |")
    table = assumptions_table(rows)
    assert table.startswith("n = 3 sessions, 16 words\n")
    assert "| `slope` | 0.7 | Nats that a unit of dissimilarity counts | 100.0 [44, 100]; 100.0 [" in table
    assert sum(line.startswith("| `") for line in table.splitlines()) == len(Assumptions._fields)
