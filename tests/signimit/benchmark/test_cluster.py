"""A cluster gives what this machine gives, also when a worker is killed."""

import importlib
import os
import signal
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("distributed", reason="the engine dask needs distributed")

from signimit.benchmark.cluster import dask_engine
from signimit.benchmark.entries import EntrantReference
from signimit.benchmark.results import ResultFile, records_digest, run_missing
from signimit.benchmark.running import SessionTask, run_task
from signimit.exceptions import InvalidInputError

pytestmark = pytest.mark.slow
distributed: Any = importlib.import_module("distributed")


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=":0", silence_logs=50
    ) as cluster:
        yield cluster


def test_a_worker_is_killed_and_the_results_are_the_same_bit_for_bit(
    cluster: Any, still: EntrantReference, tmp_path: Path
) -> None:
    tasks = [SessionTask(still, split, seed) for seed in range(4) for split in ("few", "paper")]
    file = ResultFile(tmp_path, still)
    running = run_missing(file, ["few", "paper"], range(4), dask_engine(cluster.scheduler_address))
    next(running)
    pids = [worker.pid for worker in cluster.workers.values()]
    os.kill(pids[0], signal.SIGKILL)
    rest = list(running)
    assert len(rest) == 7
    assert [worker.pid for worker in cluster.workers.values()] != pids
    expected = sorted(map(run_task, tasks), key=lambda r: (r["split"] == "few", r["seed"]))
    assert records_digest(file.read()) == records_digest(expected)


def test_what_a_cluster_left_undone_is_done_on_the_next_run(
    cluster: Any, still: EntrantReference, tmp_path: Path
) -> None:
    file = ResultFile(tmp_path, still)
    engine = dask_engine(cluster.scheduler_address)
    running: Any = run_missing(file, ["few"], range(4), engine)
    next(running)
    running.close()
    seeds = [r["seed"] for r in run_missing(file, ["few"], range(4), engine)]
    assert len(seeds) == 3
    assert [r["seed"] for r in file.read()] == [0, 1, 2, 3]


def test_a_mistake_of_an_entry_comes_back_from_the_cluster(cluster: Any) -> None:
    wrong = EntrantReference(
        "wrong.py:Wrong",
        "class Wrong:\n"
        "    def observe(self, demonstrations): pass\n"
        "    def begin(self, signs, objects): pass\n"
        "    def act(self, observation): return 'left'\n",
    )
    with pytest.raises(InvalidInputError, match=r"entry wrong\.py:Wrong, split few, session 0: act at step 0"):
        list(dask_engine(cluster.scheduler_address)([SessionTask(wrong, "few", 0)]))


def test_a_scheduler_that_is_not_there_gets_a_sentence() -> None:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with pytest.raises(
        InvalidInputError, match=rf"scheduler tcp://127\.0\.0\.1:{port}: expected a dask scheduler that"
    ):
        list(dask_engine(f"tcp://127.0.0.1:{port}", timeout=0.5)([]))


@pytest.mark.parametrize("address", ["nowhere", "ftp://127.0.0.1:1", "tcp://127.0.0.1", ""])
def test_what_is_no_address_gets_a_sentence_and_no_client(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A client that fails while it is made tries to close itself for 20 s, and prints a traceback then."""
    monkeypatch.delattr(distributed, "Client")
    with pytest.raises(InvalidInputError, match=f"scheduler {address}: expected a dask scheduler that answers"):
        list(dask_engine(address, timeout=0.5)([]))
