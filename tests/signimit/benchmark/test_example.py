"""The learner in the documentation enters the benchmark as it stands."""

import shutil
from pathlib import Path

import pytest

from signimit.benchmark.entries import refer_to
from signimit.benchmark.running import SessionTask, run_task

EXAMPLE = Path(__file__).parents[3] / "examples" / "benchmark_entry.py"


def test_the_example_obeys_more_than_chance_and_fails_where_it_must() -> None:
    if not EXAMPLE.exists():
        pytest.skip("the examples are not part of what is installed here")
    reference = refer_to(f"{EXAMPLE}:MostAlikeUtterance")
    shown = run_task(SessionTask(reference, "paper", 0))
    unseen = run_task(SessionTask(reference, "unseen-pair", 0))
    assert sum(shown["obeyed"]) >= 4
    assert sum(unseen["obeyed"]) < sum(shown["obeyed"])
    assert "groups" not in shown


def test_an_earlier_package_enters_under_a_name_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    example = EXAMPLE.with_name("earlier_learner.py")
    if not example.exists():
        pytest.skip("the examples are not part of what is installed here")
    package = tmp_path / "earlier_signimit"  # here the present one
    package.mkdir()
    (package / "__init__.py").write_text("from signimit import Demonstration, DemonstrationSet, learn\n")
    shutil.copy(example, package / "entry.py")
    monkeypatch.syspath_prepend(tmp_path)
    record = run_task(SessionTask(refer_to("earlier_signimit.entry:Joint"), "wrong-2", 0))
    assert record["groups"] == 1.0
    assert sum(record["obeyed"]) >= 8
