"""How fast the studio is, how smooth, and whether it grows: measured from outside, as a page would see it."""

from __future__ import annotations

import time
from contextlib import closing
from pathlib import Path
from typing import NamedTuple

from signimit_envs.studio.loopback import Json, Page, Watcher

_REST = 0.4  # s, for the arm to come to rest
_SETTLE = 2.0  # s, in which policies are made; people need longer to draw two signs
_CADENCE = 0.05  # s, between two requests under load; the studio takes 40 a second


class Speed(NamedTuple):
    """What was measured.

    Attributes:
        motion: From a request to the first frame in which the hand has moved, s, one for each answer.
        update: From a demonstration to the belief, s, one for each demonstration.
        frames: Frames per second of each page, for one page and for two.
        real_time: Simulated time over time, while two pages watch.
    """

    motion: list[float]
    update: list[float]
    frames: dict[int, list[float]]
    real_time: float


class Growth(NamedTuple):
    """Memory under load.

    Attributes:
        minutes: How long.
        requests: How many requests were made.
        before: Resident memory after the first tenth, MiB.
        after: At the end, MiB.
        real_time: Simulated time over time, all the while.
    """

    minutes: float
    requests: int
    before: float
    after: float
    real_time: float


def measure_speed(address: str, sessions: int, answers: int, seconds: float) -> Speed:
    """Measure how long a page waits, and how smoothly it sees the arm move.

    Args:
        address: What the studio printed.
        sessions: Sessions taught, twelve demonstrations each.
        answers: Answers asked for, one by one, of a resting arm.
        seconds: How long frames are counted, with one page and with two.
    """
    page = Page(address)
    page.ask("GET", "studio")  # waits for OpenGL
    update = []
    for seed in range(sessions):
        session = page.begin(seed)
        while session["next"]["left"]:
            body = page.demonstration(session)
            start = time.perf_counter()
            session = page.ask("POST", f"sessions/{session['id']}/demonstrations", body)
            update.append(time.perf_counter() - start)
    time.sleep(_SETTLE)
    page.ask("POST", f"sessions/{session['id']}/table", {})
    with closing(Watcher(address)) as one:
        motion = [_first_motion(page, one, session, attempt) for attempt in range(answers)]
        frames = {1: _frame_rates(page, [one], session, seconds)}
        with closing(Watcher(address)) as two:
            start = page.ask("GET", "health")
            frames[2] = _frame_rates(page, [one, two], session, seconds)
            real_time = _real_time(start, page.ask("GET", "health"))
    return Speed(motion, update, frames, real_time)


def measure_growth(address: str, process: int, minutes: float) -> Growth:
    """Use the studio without pause, far faster than people would, and look at its memory.

    Raises:
        OSError: If the system does not tell.
    """
    page, begin, before, count = Page(address), time.perf_counter(), 0.0, 0
    start = page.ask("GET", "health")
    with closing(Watcher(address)), closing(Watcher(address)):
        while (elapsed := time.perf_counter() - begin) < 60 * minutes:
            if not before and elapsed > 6 * minutes:
                before = resident_memory(process)
            _use(page, count)
            count += 1
        real_time = _real_time(start, page.ask("GET", "health"))
        return Growth(minutes, page.requests, before, resident_memory(process), real_time)


def _real_time(start: Json, end: Json) -> float:
    """Return simulated time over time between two control steps; the arm tells both times of a step."""
    return float((end["time"] - start["time"]) / (end["clock"] - start["clock"]))


def resident_memory(process: int) -> float:
    """Return the resident memory of a process, MiB.

    Raises:
        OSError: If the system does not tell.
    """
    for line in Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise OSError("the system does not tell how large a process is")


def _first_motion(page: Page, watcher: Watcher, session: Json, attempt: int) -> float:
    signs = page.utterance(session, attempt)
    page.ask("POST", f"sessions/{session['id']}/stop", {})
    time.sleep(_REST)
    place, start = watcher.latest["hand"], time.perf_counter()
    page.ask("POST", f"sessions/{session['id']}/ask", {"signs": signs})
    return watcher.wait_until_moved(place) - start


def _frame_rates(page: Page, watchers: list[Watcher], session: Json, seconds: float) -> list[float]:
    page.ask("POST", f"sessions/{session['id']}/ask", {"signs": page.utterance(session, 0)})
    before, start = [watcher.frames for watcher in watchers], time.perf_counter()
    time.sleep(seconds)
    elapsed = time.perf_counter() - start
    return [(watcher.frames - count) / elapsed for watcher, count in zip(watchers, before, strict=True)]


def _use(page: Page, seed: int) -> None:
    """Do what people do with a session, all of it."""
    session = page.begin(seed)
    base = f"sessions/{session['id']}"
    for _ in range(6):
        session = page.ask("POST", f"{base}/demonstrations", page.demonstration(session))
        time.sleep(_CADENCE)
    session = page.ask("POST", f"{base}/undo", {"revision": session["revision"]})
    page.ask("POST", f"{base}/redo", {"revision": session["revision"]})
    page.ask("POST", f"{base}/table", {})
    for attempt in range(4):
        number = page.ask("POST", f"{base}/ask", {"signs": page.utterance(session, attempt)})["number"]
        time.sleep(1.0)
        page.ask("POST", f"{base}/answers/{number}/verdict", {"good": True})
        page.ask("GET", f"{base}/answers/{number}")
    page.ask("GET", f"{base}/similarities")
    page.ask("GET", "sessions")
