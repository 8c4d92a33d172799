"""The learner in the documentation enters the benchmark as it stands."""

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
