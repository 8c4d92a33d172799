"""The judge is known by the code that scores, and by nothing else."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator

import pytest

from signimit import drawing_alignment, evaluation, paths
from signimit.benchmark import judge, scoring


@pytest.fixture(autouse=True)
def _read_anew() -> Iterator[None]:
    judge.judge_hash.cache_clear()
    judge._definitions.cache_clear()
    yield
    judge.judge_hash.cache_clear()
    judge._definitions.cache_clear()


def hash_where(monkeypatch: pytest.MonkeyPatch, **sources: str) -> str:
    """Return the judge's hash as if modules had other texts."""
    given = inspect.getsource
    monkeypatch.setattr(inspect, "getsource", lambda m: sources.get(m.__name__.rpartition(".")[2], given(m)))
    judge.judge_hash.cache_clear()
    judge._definitions.cache_clear()
    return judge.judge_hash()


def test_a_threshold_or_a_formula_makes_another_judge(monkeypatch: pytest.MonkeyPatch) -> None:
    text, as_it_is = inspect.getsource(evaluation), judge.judge_hash()
    assert len(as_it_is) == 16
    line = next(line for line in text.splitlines() if line.startswith("TOLERANCE = "))
    assert hash_where(monkeypatch, evaluation=text.replace(line, "TOLERANCE = 0.1")) != as_it_is
    alignment = inspect.getsource(drawing_alignment)
    assert hash_where(monkeypatch, drawing_alignment=alignment.replace("_NEAR = 0.4", "_NEAR = 0.5")) != as_it_is
    geometry = inspect.getsource(paths)
    changed = geometry.replace("def half_size(", "def half_size(not_the_same, ", 1)
    assert hash_where(monkeypatch, paths=changed) != as_it_is


def test_comments_docstrings_and_what_does_not_score_do_not(monkeypatch: pytest.MonkeyPatch) -> None:
    text, as_it_is = inspect.getsource(paths), judge.judge_hash()
    more = text + "\n\ndef not_used_by_the_judge() -> None:\n    pass\n"
    assert hash_where(monkeypatch, paths=more) == as_it_is
    said = ast.get_docstring(ast.parse(inspect.getsource(evaluation).partition("def performed")[0]))
    assert said
    shorter = inspect.getsource(evaluation).replace(said.splitlines()[0], "Another docstring.  # and no comment")
    assert hash_where(monkeypatch, evaluation=shorter) == as_it_is
    assert hash_where(monkeypatch, scoring="# a comment\n" + inspect.getsource(scoring)) == as_it_is


def test_the_hash_is_of_all_that_scores() -> None:
    for name in judge._ENTRANCES:
        assert name in judge._definitions(scoring)
    used = {"performed", "TOLERANCE", "Performance"}
    assert used <= set(judge._definitions(evaluation))


def test_the_criterion_names_the_thresholds() -> None:
    assert f"at most {evaluation.TOLERANCE:g} half sizes" in judge.CRITERION
