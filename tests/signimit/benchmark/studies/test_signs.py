"""Signs read on their own, by three distances."""

import numpy as np
import pytest

pytest.importorskip("sklearn", reason="the study needs scikit-learn")

from signimit import InvalidInputError
from signimit.benchmark.studies import signs
from signimit.benchmark.studies.signs import METHODS, Quiz, run_quizzes
from signimit.teaching.people import synthetic_library


@pytest.fixture(autouse=True)
def one_kind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(signs, "QUIZZES", (Quiz(("1", "2", "3"), shown=2, crowd=False),))


def test_every_method_is_asked_the_same_signs_and_ours_reads_those_of_tidy_people() -> None:
    rows = list(run_quizzes(None, quizzes=4))
    assert [row.method for row in rows] == list(METHODS)
    assert {row.asked for row in rows} == {12}
    assert {row.people for row in rows} == {"synthetic"}
    assert rows[0].right == 12
    assert all(row.low <= row.right / row.asked <= row.high for row in rows)


def test_the_same_quizzes_come_out_the_same() -> None:
    assert list(run_quizzes(None, quizzes=2)) == list(run_quizzes(None, quizzes=2))


def test_signs_that_mean_nothing_are_read_at_random(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is asked must not be what was shown: one stroke with three labels is read rightly once in three."""
    stroke = synthetic_library(("1",), rng=np.random.default_rng(0), samples=4)
    alike = sum((stroke for _ in range(11)), stroke)
    labels = tuple(label for label in (*"123789",) for _ in range(8))
    mixed = type(stroke)(alike.strokes[:48], labels, ("Ann",) * 48, "one stroke, many labels")
    row = next(iter(run_quizzes(mixed, quizzes=20)))
    assert row.right == pytest.approx(20, abs=12)


def test_nobody_with_enough_signs_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    few = synthetic_library((*"123789",), rng=np.random.default_rng(0), samples=2)
    with pytest.raises(InvalidInputError, match="everybody: expected at least 3 strokes each of"):
        list(run_quizzes(few, quizzes=1))
