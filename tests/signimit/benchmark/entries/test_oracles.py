"""Oracles are told what they are told, and infer the rest."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from signimit.benchmark.entries import refer_to
from signimit.benchmark.running import SessionTask, run_task
from signimit.benchmark.scoring import adjusted_rand_index
from signimit.benchmark.shipped_sessions import get_session
from signimit.benchmark.splits import get_split
from signimit.grouping import canonical_labels
from signimit.teaching.sessions import Session


def test_who_knows_everything_says_so_and_obeys(paper_session: Session) -> None:
    record = run_task(SessionTask(refer_to("oracle"), "paper", 0))
    assert record["obeyed"] == [1] * 9
    assert record["read"] == [2] * 9


def test_who_is_told_the_groups_or_foci_has_them_right(paper_session: Session, observed: Any) -> None:
    labels = canonical_labels(paper_session.truth.movement)
    assert np.array_equal(observed("oracle-grouping", paper_session).understanding.labels, labels)
    assert np.array_equal(observed("oracle-focus", paper_session).understanding.focus, paper_session.truth.focus)


def test_being_told_the_groups_mends_what_the_paper_gets_wrong(observed: Any) -> None:
    session = next(s for s in _paper_sessions() if _ari(observed("paper-path", s), s) < 1)
    assert _ari(observed("oracle-grouping", session), session) == 1
    told = run_task(SessionTask(refer_to("oracle-grouping"), "paper", session.seed))
    alone = run_task(SessionTask(refer_to("paper-path"), "paper", session.seed))
    assert sum(told["obeyed"]) > sum(alone["obeyed"])


def _paper_sessions() -> Iterator[Session]:
    return (get_session(get_split("paper"), seed) for seed in range(10))


def _ari(entry: Any, session: Session) -> float:
    return adjusted_rand_index(entry.understanding.labels, session.truth.movement)
