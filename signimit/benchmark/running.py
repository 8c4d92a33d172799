"""One session from beginning to end: the unit of work that is sent about, and the record that comes back."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from signimit.benchmark.obeying import obey
from signimit.benchmark.protocol import Entrant, Entry, Kit, Oracle, Truth
from signimit.benchmark.provenance import code_hash
from signimit.benchmark.registry import EntrantReference, get_entrant
from signimit.benchmark.scoring import Judge, Understood, count_signs_read, score_understanding
from signimit.benchmark.sessions import BenchmarkSession, Lesson, entry_stream, with_more_demonstrations
from signimit.benchmark.shipped_sessions import get_session, session_hash
from signimit.benchmark.splits import get_split
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import Record
from signimit.learners.base import Understanding


class Task(NamedTuple):
    """A session to run: enough to run it anywhere.

    Attributes:
        entrant: Who takes part.
        split: Name of the split.
        seed: Number of the session.
    """

    entrant: EntrantReference
    split: str
    seed: int


def run_task(task: Task) -> Record:
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
    lesson = with_more_demonstrations(session, entrant.demonstrations)
    composed = time.thread_time()
    with _blaming(f"entry {task.entrant.name}, split {task.split}, session {task.seed}"):
        entry = make_entry(entrant, session, lesson)
        entry.observe(lesson.demonstrations)
        observed = time.thread_time()
        understanding: Understanding | None = getattr(entry, "understanding", None)
        answers = _answers(entry, session, lesson, understanding)
    understood = None if understanding is None else score_understanding(understanding, lesson.truth)
    times = {"compose": composed - began, "observe": observed - composed, "act": time.thread_time() - observed}
    return {
        "split": task.split,
        "seed": task.seed,
        "session": session_hash(session),
        "code": code_hash(),
        "demonstrations": len(lesson.demonstrations),
        **(Understood(*understood)._asdict() if understood else {}),
        **answers,
        "seconds": {part: round(spent, 4) for part, spent in times.items()},
    }


@contextmanager
def _blaming(where: str) -> Iterator[None]:
    """Say where an entry failed: in our sentence, or beside the traceback of a mistake of its own."""
    try:
        yield
    except InvalidInputError as error:
        raise error.inside(where) from None
    except Exception as error:
        error.add_note(where)
        raise


def make_entry(entrant: Entrant | Oracle, session: BenchmarkSession, lesson: Lesson) -> Entry:
    """Make the entry of a session; only an oracle is told the truth."""
    kit = Kit(session.prototypes, entry_stream(session))
    if isinstance(entrant, Oracle):
        return entrant.make(kit, Truth(lesson.truth, tuple(c.request for c in session.commands)))
    return entrant.make(kit)


def _answers(
    entry: Entry, session: BenchmarkSession, lesson: Lesson, understanding: Understanding | None
) -> dict[str, list[Any]]:
    """Let the entry answer all commands, and judge what it did."""
    judge, obeyed, misfit, read = Judge(session.truth.templates), [], [], []
    for command in session.commands:
        done = judge.judge(obey(entry, command), command)
        obeyed.append(int(done.obeyed))
        misfit.append(done.misfit)
        reading = getattr(entry, "reading", None)
        if reading is not None and understanding is not None:
            read.append(count_signs_read(reading, understanding, lesson.truth, command.request))
    answers: dict[str, list[Any]] = {"obeyed": obeyed, "misfit": misfit}
    if len(read) == len(obeyed):
        answers["read"] = read
    families = [c.family for c in session.commands]
    return answers | ({"families": families} if len(set(families)) < len(families) else {})
