"""Execution of the study: a record of each session, on all processors."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import as_completed
from pathlib import Path

from signimit.benchmark.scoring import InferenceVerdict, judge_inference
from signimit.benchmark.studies.conditions import compose_study_session
from signimit.benchmark.studies.methods import BASELINES, SharedDistances, infer
from signimit.benchmark.studies.tables import OURS
from signimit.benchmark.workers import SessionProcesses
from signimit.io.safe_files import Record, append_record, read_records
from signimit.learning import ImitationModel, learn
from signimit.teaching.sessions import Condition, Session

Run = Callable[[Condition, int], Record]  # a session of a condition, by its seed; a function of a module
# of a worker, set once when it starts: recordings are not sent with every session
_conditions: dict[str, Condition] = {}


def run_sessions(
    run: Run, conditions: Sequence[Condition], seeds: Sequence[int], records: Path, workers: int
) -> Iterator[Record]:
    """Run every session of every condition that is not in the file yet, and append it there; yields as they end."""
    done = {(r["cell"], r["seed"]) for r in read_records(records)}
    todo = [(c.name, s) for s in seeds for c in conditions if (c.name, s) not in done]
    with SessionProcesses(min(workers, len(todo) or 1), _start_worker, {c.name: c for c in conditions}) as pool:
        for future in as_completed([pool.submit(_run, run, name, seed) for name, seed in todo]):
            record = future.result()
            append_record(records, record)
            yield record


def _start_worker(conditions: dict[str, Condition]) -> None:
    _conditions.update(conditions)


def _run(run: Run, name: str, seed: int) -> Record:
    return run(_conditions[name], seed)


def run_session(condition: Condition, seed: int) -> Record:
    """Score every method on one session, and the confidences of ours on every pair."""
    session = compose_study_session(condition, seed)
    distances = SharedDistances(session, seed)
    verdicts = {m: _three_verdicts(judge_inference(infer(distances, m), session.truth)) for m in BASELINES}
    start = time.perf_counter()
    model = learn(session.demonstrations, method=OURS, policy="knn")
    seconds = time.perf_counter() - start
    verdicts[OURS] = _three_verdicts(judge_inference(model, session.truth))
    asked = [(round(sure, 4), int(right)) for sure, right in ask_with_confidence(model, session)]
    count = len(session.demonstrations)
    return {
        "cell": condition.name, "seed": seed, "demonstrations": count, "verdicts": verdicts, "commands": asked,
        "seconds": round(seconds, 3),
    }  # fmt: skip


def _three_verdicts(verdict: InferenceVerdict) -> list[int]:
    return [int(verdict.grouping), int(verdict.focus), int(verdict.word_order)]


def ask_with_confidence(model: ImitationModel, session: Session) -> list[tuple[float, bool]]:
    """Ask for every pair once.

    Returns:
        For each command how sure the model is, and whether it is right: the object is the one asked for, and most
        members of the movement show the one asked for.
    """
    means = {
        m: Counter(session.truth.movement[list(movement.members)].tolist()).most_common(1)[0][0]
        for m, movement in enumerate(model.movements)
    }
    found = []
    for command in session.commands:
        response = model.respond(command.signs, command.objects)
        right = (means[response.movement], response.focus) == command.request
        found.append((response.confidence, right))
    return found
