"""The study of the judge counts what it should, and chooses thresholds on other people."""

from __future__ import annotations

import numpy as np
import pytest

from signimit.benchmark.studies.judge import (
    COVERAGES,
    OWN,
    SPOILT,
    STRANGERS,
    TOLERANCES,
    Trial,
    acceptance_table,
    built_in_people,
    choose_thresholds,
    count_accepted,
    leave_groups_out,
    people_of,
    run_judge,
    tabulate_acceptance,
)
from signimit.evaluation import COVERED, TOLERANCE
from signimit.exceptions import InvalidInputError
from signimit.teaching.people import synthetic_library

MOVEMENTS = ("circle", "triangle up", "triangle down", "zigzag")


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    """Return the trials of two built-in people."""
    return [
        trial
        for number, library in enumerate(built_in_people(2, seed=0))
        for trial in run_judge(library, f"person {number}", MOVEMENTS, 2, np.random.default_rng(number))
    ]


def test_own_redrawings_are_accepted_and_the_rest_is_not(trials: list[Trial]) -> None:
    rows = {row.kind: row.share for row in tabulate_acceptance("built-in", trials, leave_groups_out(trials))}
    assert set(SPOILT) < set(rows)
    for kind, share in rows.items():
        if kind.startswith(OWN):
            assert share.count == share.total == 12
        elif "circle" not in kind and "quarters" not in kind:
            assert share.count == 0, kind


def trial(kind: str, misfit: float, coverage: float, right: bool = True, group: str = "a") -> Trial:
    return Trial(
        group, kind, "circle", right, np.array([misfit, 9.0]), np.array([coverage, 1.0]), np.array([True, False])
    )


def test_a_trial_is_accepted_by_a_drawing_that_fits_within_both_thresholds() -> None:
    assert trial(OWN, TOLERANCE, COVERED).accepted()
    assert not trial(OWN, TOLERANCE + 0.01, COVERED).accepted()
    assert not trial(OWN, TOLERANCE, COVERED - 0.01).accepted()
    assert not trial(OWN, 0.0, 1.0, right=False).accepted()


def test_counts_are_those_of_every_pair_of_thresholds(trials: list[Trial]) -> None:
    counts = count_accepted(trials)
    for i, j in ((0, 0), (5, 8), (-1, -1)):
        accepted = [t for t in trials if t.accepted(TOLERANCES[i], COVERAGES[j])]
        assert counts.own[i, j] == sum(t.own for t in accepted)
        assert counts.others[i, j] == sum(not t.own for t in accepted)
    assert counts.redrawings == sum(t.kind.startswith(OWN) for t in trials)


def test_thresholds_accept_what_people_redraw_and_refuse_what_they_can() -> None:
    shown = [trial(OWN, 0.2, 0.93), trial("half", 0.21, 0.93), trial("other", 0.2, 0.92)]
    tolerance, covered = choose_thresholds([count_accepted(shown)])
    assert (tolerance, covered) == (0.2, 0.93)
    far = [trial(OWN, 9.0, 1.0, group="b")]
    assert leave_groups_out(shown + far)["b"] == (0.2, 0.93)


def test_people_are_judged_alone_and_strangers_together() -> None:
    often = synthetic_library(MOVEMENTS, writers=2, samples=6, rng=np.random.default_rng(0))
    assert list(people_of(often, MOVEMENTS)) == ["synthetic 1", "synthetic 2"]
    seldom = synthetic_library(MOVEMENTS, writers=6, samples=1, rng=np.random.default_rng(0))
    together = people_of(seldom, MOVEMENTS)
    assert list(together) == [STRANGERS]
    found = list(run_judge(together[STRANGERS], STRANGERS, MOVEMENTS, 1, np.random.default_rng(0), redrawn=False))
    assert all(t.accepted() for t in found if t.own)


def test_the_table_has_a_line_for_each_kind_with_its_interval(trials: list[Trial]) -> None:
    rows = tabulate_acceptance("built-in", trials, leave_groups_out(trials))
    table = acceptance_table(rows).splitlines()
    assert len(table) == 2 + len(rows)
    assert table[2].startswith("| built-in | own, drawn once | 12 | 100.0% | 75.8% to 100.0% | ")


def test_too_few_drawings_or_people_are_told() -> None:
    library = synthetic_library(MOVEMENTS, samples=3, rng=np.random.default_rng(0))
    with pytest.raises(InvalidInputError, match="3 movements drawn 6 times each"):
        list(run_judge(library, "p", MOVEMENTS, 1, np.random.default_rng(0)))
    with pytest.raises(InvalidInputError, match="at least 2 people"):
        leave_groups_out([trial(OWN, 0.1, 1.0)])
