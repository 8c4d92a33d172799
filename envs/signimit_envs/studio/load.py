"""Load test of the studio from outside, as a page sees it: waits, frame rate, real time and memory.

`studio_process` runs a studio in a process of its own, `PageClient` and `FrameWatcher` are pages without a browser.
"""

from __future__ import annotations

import http.client
import json
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import urlsplit

import numpy as np

from signimit.exceptions import InvalidInputError, MissingDependencyError

Json = dict[str, Any]
_SERVER = (
    "import sys; from pathlib import Path\n"
    "from signimit_envs.studio.web.serving import StudioPlan, serve_studio\n"
    "serve_studio(StudioPlan(folder=Path(sys.argv[1])), lambda address: print(address, flush=True))"
)
_MOVED = 5e-4  # m; a hand that is so far from where it was has begun to move
_TIMEOUT = 60.0  # s
_REST = 0.4  # s, for the arm to come to rest
_SETTLE = 2.0  # s, in which policies are made; people need longer to draw two signs
_CADENCE = 0.05  # s, between two requests under load; the studio takes 40 a second


class Speed(NamedTuple):
    """How long a page waits, and how smoothly it sees the arm move.

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
    """Memory of the studio under load.

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


class PageClient:
    """HTTP client of the studio; built-in people draw for it."""

    def __init__(self, address: str) -> None:
        """Remember the address that the studio printed."""
        self._parts = urlsplit(address)
        self.requests = 0

    def ask(self, method: str, path: str, body: Json | None = None) -> Any:
        """Make a request and return the JSON of the answer.

        Raises:
            InvalidInputError: If the studio refuses.
        """
        self.requests += 1
        content = None if body is None else json.dumps(body)
        connection = http.client.HTTPConnection(self._parts.hostname or "", self._parts.port, timeout=_TIMEOUT)
        with closing(connection):
            connection.request(method, f"{self._parts.path}api/{path}", content, {"Content-Type": "application/json"})
            answer = connection.getresponse()
            text = answer.read()
        if answer.status >= 400:
            raise InvalidInputError(f"{method} {path}", "an answer", text.decode()[:200])
        return json.loads(text)

    def begin(self, seed: int) -> Json:
        """Begin a session of the paper's language."""
        return dict(self.ask("POST", "sessions", {"seed": seed}))

    def demonstration(self, session: Json) -> Json:
        """Let built-in people follow the next prompt."""
        asked = {name: session["next"]["prompt"][name] for name in ("movement", "focus")}
        asked["attempt"] = session["revision"]
        where = f"sessions/{session['id']}/people"
        signs = self.ask("POST", where, {"part": "signs", **asked})["signs"]
        hand = self.ask("POST", where, {"part": "movement", **asked})["hand"]
        return {"revision": session["revision"], "signs": signs, "hand": hand}

    def utterance(self, session: Json, attempt: int) -> list[Json]:
        """Let the built-in interactant ask for something."""
        request = {"movement": attempt % 3, "focus": attempt // 3 % 3, "attempt": 1000 + attempt}
        return list(self.ask("POST", f"sessions/{session['id']}/people", {"part": "signs", **request})["signs"])


class FrameWatcher:
    """Socket client that watches the arm in a thread; counts frames and keeps the latest header."""

    def __init__(self, address: str) -> None:
        """Connect and watch."""
        self._leaving = ExitStack()
        try:
            from websockets.sync.client import connect
        except ImportError:
            raise MissingDependencyError("websockets", "studio", "Measuring the studio") from None
        self._socket = self._leaving.enter_context(connect(address.replace("http", "ws", 1) + "ws", proxy=None))
        self._socket.send(json.dumps({"type": "watch", "on": True}))
        self.frames, self.latest = 0, Json()
        self._came = threading.Condition()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def wait_until_moved(self, place: Any) -> float:
        """Wait for a frame in which the hand has left a place, and return when it came.

        Raises:
            InvalidInputError: If it does not come.
        """

        def moved() -> bool:
            return bool(self.latest and np.hypot(*np.subtract(self.latest["hand"], place)) > _MOVED)

        with self._came:
            if not self._came.wait_for(moved, _TIMEOUT):
                raise InvalidInputError("the arm", "a movement within a minute", "none")
            return time.perf_counter()

    def close(self) -> None:
        """Disconnect."""
        self._leaving.close()
        self._thread.join()

    def _watch(self) -> None:
        from websockets.exceptions import ConnectionClosed

        with suppress(ConnectionClosed):
            for message in self._socket:
                if not isinstance(message, bytes):
                    continue
                size = struct.unpack(">I", message[:4])[0]
                with self._came:
                    self.frames, self.latest = self.frames + 1, json.loads(message[4 : 4 + size])
                    self._came.notify_all()


@contextmanager
def studio_process(folder: Path) -> Iterator[tuple[str, int]]:
    """Run a studio in a process of its own; give its address and process number."""
    command = [sys.executable, "-c", _SERVER, str(folder)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            address = process.stdout.readline().strip() if process.stdout else ""
            if not address:
                raise InvalidInputError("the studio", "its address", "nothing")
            yield address, process.pid
        finally:
            process.terminate()


def measure_speed(address: str, sessions: int, answers: int, seconds: float) -> Speed:
    """Measure waits, frame rates and simulated time over time.

    Args:
        address: What the studio printed.
        sessions: Sessions taught, twelve demonstrations each.
        answers: Answers asked for, one by one, of a resting arm.
        seconds: How long frames are counted, with one page and with two.
    """
    page = PageClient(address)
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
    with closing(FrameWatcher(address)) as one:
        motion = [first_motion(page, one, session, attempt) for attempt in range(answers)]
        frames = {1: _frame_rates(page, [one], session, seconds)}
        with closing(FrameWatcher(address)) as two:
            start = page.ask("GET", "health")
            frames[2] = _frame_rates(page, [one, two], session, seconds)
            real_time = _real_time(start, page.ask("GET", "health"))
    return Speed(motion, update, frames, real_time)


def measure_growth(address: str, process: int, minutes: float) -> Growth:
    """Measure the memory of a studio that is used without pause, far faster than by people.

    Args:
        address: What the studio printed.
        process: Its process number.
        minutes: How long.

    Raises:
        OSError: If the system does not tell.
    """
    page, begin, before, count = PageClient(address), time.perf_counter(), 0.0, 0
    start = page.ask("GET", "health")
    with closing(FrameWatcher(address)), closing(FrameWatcher(address)):
        while (elapsed := time.perf_counter() - begin) < 60 * minutes:
            if not before and elapsed > 6 * minutes:
                before = resident_memory(process).now
            _use_session(page, count)
            count += 1
        real_time = _real_time(start, page.ask("GET", "health"))
        return Growth(minutes, page.requests, before, resident_memory(process).now, real_time)


def first_motion(page: PageClient, watcher: FrameWatcher, session: Json, attempt: int) -> float:
    """Ask a resting arm for something, and return how long it takes until it is seen to move, s.

    Raises:
        InvalidInputError: If it is not, within a minute.
    """
    signs = page.utterance(session, attempt)
    page.ask("POST", f"sessions/{session['id']}/stop", {})
    time.sleep(_REST)
    place, start = watcher.latest["hand"], time.perf_counter()
    page.ask("POST", f"sessions/{session['id']}/ask", {"signs": signs})
    return watcher.wait_until_moved(place) - start


def _real_time(start: Json, end: Json) -> float:
    """Return simulated time over time between two control steps; the arm tells both times of a step."""
    return float((end["time"] - start["time"]) / (end["clock"] - start["clock"]))


class Memory(NamedTuple):
    """Resident memory of a process, MiB, now and at its highest."""

    now: float
    highest: float


def resident_memory(process: int) -> Memory:
    """Look how large a process is.

    Raises:
        OSError: If the system does not tell.
    """
    told = dict(line.split(":", 1) for line in Path(f"/proc/{process}/status").read_text().splitlines())
    try:
        return Memory(*(int(told[name].split()[0]) / 1024 for name in ("VmRSS", "VmHWM")))
    except KeyError:
        raise OSError("the system does not tell how large a process is") from None


def _frame_rates(page: PageClient, watchers: list[FrameWatcher], session: Json, seconds: float) -> list[float]:
    page.ask("POST", f"sessions/{session['id']}/ask", {"signs": page.utterance(session, 0)})
    before, start = [watcher.frames for watcher in watchers], time.perf_counter()
    time.sleep(seconds)
    elapsed = time.perf_counter() - start
    return [(watcher.frames - count) / elapsed for watcher, count in zip(watchers, before, strict=True)]


def _use_session(page: PageClient, seed: int) -> None:
    """Teach, undo, redo, ask, judge and compare in a new session."""
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
