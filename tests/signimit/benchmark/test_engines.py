"""Sessions run on this machine's processors, a few at a time."""

import os
from collections.abc import Iterator

import pytest

from signimit.benchmark.engines import batches_of, local_engine
from signimit.benchmark.registry import EntrantReference
from signimit.benchmark.results import records_digest
from signimit.benchmark.running import Task, run_task
from signimit.exceptions import InvalidInputError

DEADLY = """
import os, signal
class Deadly:
    def __init__(self): os.kill(os.getpid(), signal.SIGKILL)
    def observe(self, demonstrations): pass
    def begin(self, signs, objects): pass
    def act(self, observation): return 0, 0
"""


def test_batches_hold_all_tasks_in_order(still: EntrantReference) -> None:
    tasks = [Task(still, "few", seed) for seed in range(5)]
    assert list(batches_of(tasks, 2)) == [tasks[:2], tasks[2:4], tasks[4:]]


def test_processes_give_what_this_process_gives_and_take_no_more_tasks_than_they_need(still: EntrantReference) -> None:
    taken: list[int] = []

    def tasks() -> Iterator[Task]:
        for seed in range(6):
            taken.append(seed)
            yield Task(still, "few", seed)

    found = local_engine(workers=1)(tasks())
    records = [next(found)]
    assert len(taken) <= 3
    threads = [os.environ.get(name) for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")]
    assert threads == ["1", "1"]
    records += found
    expected = [run_task(Task(still, "few", seed)) for seed in range(6)]
    assert records_digest(sorted(records, key=lambda r: int(r["seed"]))) == records_digest(expected)


def test_the_number_of_threads_is_put_back(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    assert list(local_engine(1)(())) == []
    assert os.environ["OMP_NUM_THREADS"] == "3"
    assert "MKL_NUM_THREADS" not in os.environ


def test_a_killed_process_ends_the_run_with_a_sentence() -> None:
    tasks = [Task(EntrantReference("deadly.py:Deadly", DEADLY), "few", 0)]
    with pytest.raises(InvalidInputError, match="one that was killed; what was done is kept, run again to go on"):
        list(local_engine(workers=1)(tasks))


def test_at_least_one_worker_and_one_session_a_batch() -> None:
    with pytest.raises(InvalidInputError, match="workers: expected at least 1, found 0"):
        local_engine(0)
    with pytest.raises(InvalidInputError, match="batch: expected at least 1, found 0"):
        local_engine(1, batch=0)
