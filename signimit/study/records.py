"""Runs sessions on all processors and keeps what came out, a line a session; a kill loses what was under way."""

from __future__ import annotations

import json
import multiprocessing
import os
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from signimit.learning import learn
from signimit.study.cells import Cell, People, compose_session
from signimit.study.methods import BASELINES, Answer, Evidence, answer
from signimit.study.scoring import confidences, judge

OURS = "joint"
Record = dict[str, Any]
_people: People | None = None  # a worker's, set once when it starts: libraries are not sent with every session


def run_sessions(
    cells: Sequence[Cell], seeds: Sequence[int], records: Path, people: People | None, workers: int
) -> Iterator[Record]:
    """Run every session of every cell that is not in the file yet, and append it there; yields as they end."""
    done = {(r["cell"], r["seed"]) for r in read_records(records)}
    todo = [(c, s) for s in seeds for c in cells if (c.name, s) not in done]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, context, _start_worker, (people,)) as pool:
        for future in as_completed([pool.submit(run_session, cell, seed) for cell, seed in todo]):
            record = future.result()
            append_record(records, record)
            yield record


def _start_worker(people: People | None) -> None:
    global _people
    _people = people


def run_session(cell: Cell, seed: int) -> Record:
    """Let every method answer one session, and ask ours for every pair."""
    session = compose_session(cell, seed, _people if cell.people == "real" else None)
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


def append_record(path: Path, record: Record) -> None:
    """Append a line in one write, and see it to the disk."""
    path.parent.mkdir(parents=True, exist_ok=True)
    line = json.dumps(record) + "\n"
    with path.open("ab") as file:
        file.write(line.encode())
        file.flush()
        os.fsync(file.fileno())


def read_records(path: Path) -> list[Record]:
    """Read all whole lines; a torn last one, all that a kill can leave, is cut off."""
    if not path.exists():
        return []
    text = path.read_bytes()
    whole = text[: text.rfind(b"\n") + 1]
    if len(whole) < len(text):
        os.truncate(path, len(whole))
    return [json.loads(line) for line in whole.splitlines()]
