"""Runs sessions on all processors and keeps what came out, a line a session."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from signimit.benchmark.studies.cells import Cell, People, compose_session
from signimit.benchmark.studies.methods import BASELINES, Answer, Evidence, answer
from signimit.benchmark.studies.scoring import confidences, judge
from signimit.io.safe_files import Record as Record
from signimit.io.safe_files import append_record as append_record
from signimit.io.safe_files import read_records as read_records
from signimit.learning import learn

OURS = "joint"
_people: People | None = None  # a worker's, set once when it starts: libraries are not sent with every session


Run = Callable[[Cell, int, People | None], Record]  # a session of a cell, by its seed; a function of a module


def run_sessions(
    run: Run, cells: Sequence[Cell], seeds: Sequence[int], records: Path, people: People | None, workers: int
) -> Iterator[Record]:
    """Run every session of every cell that is not in the file yet, and append it there; yields as they end."""
    done = {(r["cell"], r["seed"]) for r in read_records(records)}
    todo = [(c, s) for s in seeds for c in cells if (c.name, s) not in done]
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(workers, context, _start_worker, (people,))
    try:
        for future in as_completed([pool.submit(_run, run, cell, seed) for cell, seed in todo]):
            record = future.result()
            append_record(records, record)
            yield record
    finally:
        pool.shutdown(cancel_futures=True)  # whoever stops waits for the sessions under way, not for all that are left


def _start_worker(people: People | None) -> None:
    global _people
    _people = people


def _run(run: Run, cell: Cell, seed: int) -> Record:
    return run(cell, seed, _people if cell.people == "real" else None)


def run_session(cell: Cell, seed: int, people: People | None) -> Record:
    """Let every method answer one session, and ask ours for every pair."""
    session = compose_session(cell, seed, people)
    evidence, verdicts = Evidence(session, seed), {}
    for method in BASELINES:
        verdicts[method] = list(map(int, judge(answer(evidence, method), session.truth)))
    start = time.perf_counter()
    model = learn(session.demonstrations, method=OURS, policy="knn")
    seconds = time.perf_counter() - start
    ours = Answer(model.labels, model.focus, model.word_order)
    verdicts[OURS] = list(map(int, judge(ours, session.truth)))
    asked = [(round(sure, 4), int(right)) for sure, right in confidences(model, session)]
    count = len(session.demonstrations)
    return {
        "cell": cell.name, "seed": seed, "demonstrations": count, "verdicts": verdicts, "commands": asked,
        "seconds": round(seconds, 3),
    }  # fmt: skip
