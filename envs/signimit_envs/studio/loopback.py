"""Pages without a browser, and a studio in a process of its own: for measurements."""

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
from typing import Any
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


class Page:
    """A page without a browser."""

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


class Watcher:
    """A page that watches, in a thread; counts frames and knows the latest."""

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
                if isinstance(message, bytes):
                    self._take(message)

    def _take(self, frame: bytes) -> None:
        size = struct.unpack(">I", frame[:4])[0]
        with self._came:
            self.frames, self.latest = self.frames + 1, json.loads(frame[4 : 4 + size])
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
