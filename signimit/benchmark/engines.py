"""Where sessions run. An engine takes tasks and yields their records as they end, in any order.

Every session depends on its task alone, so that all engines give the same records.
"""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import islice

from signimit.benchmark.running import Task, run_task
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import Record

Engine = Callable[[Iterable[Task]], Iterator[Record]]
WAITING = 2  # batches a worker that wait or run: enough that nobody idles, few enough for millions of tasks
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def run_batch(tasks: list[Task]) -> list[Record]:
    """Run some sessions, one after the other; what is sent to a worker."""
    return [run_task(task) for task in tasks]


def batches_of(tasks: Iterable[Task], size: int) -> Iterator[list[Task]]:
    """Cut tasks into batches."""
    rest = iter(tasks)
    while batch := list(islice(rest, size)):
        yield batch


def check_counts(**counts: int) -> None:
    """Refuse numbers of workers or sessions below one.

    Raises:
        InvalidInputError: Names the first.
    """
    for name, count in counts.items():
        if count < 1:
            raise InvalidInputError(name, "at least 1", f"{count}")


def local_engine(workers: int, batch: int = 1) -> Engine:
    """Make the engine that uses this machine's processors.

    Args:
        workers: How many processes.
        batch: Sessions handed to a process together.

    Raises:
        InvalidInputError: If there are no workers, or, while the engine runs, one of them is killed.
    """
    check_counts(workers=workers, batch=batch)

    def run(tasks: Iterable[Task]) -> Iterator[Record]:
        context = multiprocessing.get_context("spawn")
        with _single_threads(), ProcessPoolExecutor(workers, context) as pool:
            try:
                yield from _in_turns(pool, batches_of(tasks, batch), WAITING * workers)
            except BrokenProcessPool:
                found = "one that was killed; what was done is kept, run again to go on"
                raise InvalidInputError("workers", "processes that live", found) from None

    return run


def _in_turns(pool: ProcessPoolExecutor, batches: Iterator[list[Task]], room: int) -> Iterator[Record]:
    """Keep so many batches under way."""
    pending: set[Future[list[Record]]] = {pool.submit(run_batch, batch) for batch in islice(batches, room)}
    while pending:
        done, pending = wait(pending, return_when=FIRST_COMPLETED)
        pending |= {pool.submit(run_batch, batch) for batch in islice(batches, len(done))}
        for future in done:
            yield from future.result()


@contextmanager
def _single_threads() -> Iterator[None]:
    """Let processes that are started meanwhile do their linear algebra in one thread: there is one for each core."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
