"""Execution of benchmark sessions: one from beginning to end, and many on the processors of this machine.

An engine takes tasks and yields their records as they end, in any order. Every session depends on its task alone, so
that all engines give the same records.
"""

from __future__ import annotations

import hashlib
import math
import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import cache
from itertools import islice
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import signimit
from signimit.benchmark.entries import EntrantReference, get_entrant
from signimit.benchmark.protocol import Entrant, Entry, Kit, Observation, Oracle, Truth
from signimit.benchmark.scoring import count_signs_read, judge_inference, score_path
from signimit.benchmark.shipped_sessions import get_session, session_hash
from signimit.benchmark.splits import entry_stream, get_split, with_more_demonstrations
from signimit.benchmark.workers import SessionProcesses
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import Record
from signimit.learners.base import Understanding
from signimit.policies import CONTROL_PERIOD, run_policy
from signimit.teaching.composition import GroundTruth
from signimit.teaching.sessions import Command, Session

WAITING = 2  # batches a worker that wait or run: enough that none idles, few enough for millions of tasks
SECONDS = 10.0  # how long a hand moves for each command
FASTEST = 1.2  # m/s along either axis, the arm's `max_hand_speed`; what is faster is slowed down as a whole
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


class SessionTask(NamedTuple):
    """A session to run, in a form that any process on any machine can run.

    Attributes:
        entrant: The entry that takes part.
        split: Name of the split.
        seed: Number of the session.
    """

    entrant: EntrantReference
    split: str
    seed: int


Engine = Callable[[Iterable[SessionTask]], Iterator[Record]]


def run_task(task: SessionTask) -> Record:
    """Run one session.

    Returns:
        What goes into a line of JSON. All but ``seconds``, of the processor, depends on nothing but the task and the
        code.

    Raises:
        InvalidInputError: If the entry commands what is not a velocity.
    """
    began = time.thread_time()
    entrant = get_entrant(task.entrant)
    session = get_session(get_split(task.split), task.seed)
    extended = with_more_demonstrations(session, entrant.demonstrations)
    composed = time.thread_time()
    with _blaming(f"entry {task.entrant.name}, split {task.split}, session {task.seed}"):
        entry = make_entry(entrant, extended)
        entry.observe(extended.demonstrations)
        observed = time.thread_time()
        understanding: Understanding | None = getattr(entry, "understanding", None)
        answers = _score_commands(entry, extended, session.truth.templates, understanding)
    inferences = {}
    if understanding is not None:
        verdict = judge_inference(*_of_sound(understanding, extended.truth))
        focus = verdict.foci_right.count / verdict.foci_right.total
        inferences = {"groups": verdict.rand_index, "focus": focus, "order": float(verdict.word_order)}
    times = {"compose": composed - began, "observe": observed - composed, "act": time.thread_time() - observed}
    return {
        "split": task.split,
        "seed": task.seed,
        "session": session_hash(session),
        "code": code_hash(),
        "demonstrations": len(extended.demonstrations),
        **inferences,
        **answers,
        "seconds": {part: round(spent, 4) for part, spent in times.items()},
    }


@contextmanager
def _blaming(where: str) -> Iterator[None]:
    """Name entry and session in whatever an entry raises: in the sentence of bad input, or as a note."""
    try:
        yield
    except InvalidInputError as error:
        raise error.inside(where) from None
    except Exception as error:
        error.add_note(where)
        raise


def _of_sound(understanding: Understanding, truth: GroundTruth) -> tuple[Understanding, GroundTruth]:
    """Keep what is inferred and true of the demonstrations that do what their words ask for."""
    sound = np.flatnonzero(truth.sound)
    return understanding._replace(labels=understanding.labels[sound], focus=understanding.focus[sound]), truth.select(
        sound
    )


def make_entry(entrant: Entrant | Oracle, session: Session) -> Entry:
    """Make the entry of a session; only an oracle is told the truth."""
    kit = Kit(tuple(p.points for p in session.prototypes), entry_stream(session))
    if isinstance(entrant, Oracle):
        return entrant.make(kit, Truth(session.truth, tuple(c.request for c in session.commands)))
    return entrant.make(kit)


def _score_commands(
    entry: Entry,
    session: Session,
    templates: Sequence[Sequence[NDArray[np.float64]]],
    understanding: Understanding | None,
) -> dict[str, list[Any]]:
    """Score what an entry does for each command."""
    obeyed, misfit, read = [], [], []
    for command in session.commands:
        done = score_path(obey(entry, command), command, templates)
        obeyed.append(int(done.obeyed))
        misfit.append(done.misfit)
        reading = getattr(entry, "reading", None)
        if reading is not None and understanding is not None:
            read.append(count_signs_read(reading, *_of_sound(understanding, session.truth), command.request))
    scores: dict[str, list[Any]] = {"obeyed": obeyed, "misfit": misfit}
    if len(read) == len(obeyed):
        scores["read"] = read
    families = [c.family for c in session.commands]
    return scores | ({"families": families} if len(set(families)) < len(families) else {})


def obey(entry: Entry, command: Command, seconds: float = SECONDS) -> NDArray[np.float64]:
    """Let an entry answer a command; the hand is a point that follows exactly.

    Returns:
        Where the hand was at the start and after every control period, shape (T + 1, 2), m, table frame.

    Raises:
        InvalidInputError: If the entry commands what is not a velocity.
    """
    entry.begin(command.signs, command.objects)
    velocity, step = np.zeros(2), 0

    def act(hand: NDArray[np.float64]) -> NDArray[np.float64]:
        nonlocal velocity, step
        given = entry.act(Observation(hand.copy(), velocity.copy(), step * CONTROL_PERIOD))
        velocity, step = _check_velocity(given, step), step + 1
        return velocity

    return run_policy(act, command.hand, seconds)


def _check_velocity(given: Any, step: int) -> NDArray[np.float64]:
    """Return a velocity that the arm can have, shape (2,), m/s."""
    try:
        velocity = np.array(given, dtype=np.float64)
    except (TypeError, ValueError):
        velocity = np.empty(0)
    x, y = velocity.tolist() if velocity.shape == (2,) else (math.nan, math.nan)
    if not (math.isfinite(x) and math.isfinite(y)):
        raise InvalidInputError(f"act at step {step}", "a finite velocity of shape (2,), m/s", f"{given!r:.60}")
    allowed: NDArray[np.float64] = velocity / max(1.0, abs(x) / FASTEST, abs(y) / FASTEST)
    return allowed


@cache
def code_hash() -> str:
    """Return a short SHA-256 of all modules of signimit, the same wherever and however it is installed."""
    return hash_modules(signimit)[:16]


def hash_modules(package: ModuleType) -> str:
    """Return the SHA-256 of all modules of a package, or of a module alone, the same wherever it is installed."""
    file = Path(str(package.__file__))
    folder, sha = file.parent, hashlib.sha256()
    modules = folder.rglob("*.py") if hasattr(package, "__path__") else [file]
    for path in sorted(modules, key=lambda p: p.relative_to(folder).as_posix()):
        sha.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes().replace(b"\r\n", b"\n"))
    return sha.hexdigest()


def run_batch(tasks: list[SessionTask]) -> list[Record]:
    """Run some sessions, one after the other; what is sent to a worker."""
    return [run_task(task) for task in tasks]


def batches_of(tasks: Iterable[SessionTask], size: int) -> Iterator[list[SessionTask]]:
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

    def run(tasks: Iterable[SessionTask]) -> Iterator[Record]:
        with _single_threads(), SessionProcesses(workers) as pool:
            try:
                yield from _in_turns(pool, batches_of(tasks, batch), WAITING * workers)
            except BrokenProcessPool:
                found = "one that was killed; what was done is kept, run again to go on"
                raise InvalidInputError("workers", "processes that live", found) from None

    return run


def _in_turns(pool: ProcessPoolExecutor, batches: Iterator[list[SessionTask]], room: int) -> Iterator[Record]:
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
