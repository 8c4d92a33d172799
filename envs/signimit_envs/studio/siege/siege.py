"""The siege: everything hostile at once, and what an honest page finds afterwards."""

from __future__ import annotations

import asyncio
import json
import random
import re
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import urlsplit
from urllib.request import ProxyHandler, build_opener

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.load import FrameWatcher, PageClient, first_motion
from signimit_envs.studio.siege.requests import Attack, HostileRequests, Target
from signimit_envs.studio.siege.sockets import HostileSockets
from signimit_envs.studio.siege.watched import SECRET, WatchedStudio, watched_studio

Json = dict[str, Any]
AT_ONCE = 24  # connections of attackers
MOST_GROWTH = 256.0  # MiB
_WARM = 0.1  # of all attacks, before memory is looked at
_PATIENCE, _IMPATIENCE = 60.0, 0.15  # s, for the answer to a whole request and to anything else
_GREETING = 1.0  # s, for the answer to a handshake
_ENOUGH = 2**20  # bytes of an answer that are read
_CROWD = 3 * LIMITS.connections
_MOST_FAULTS = 50
_STATUS = re.compile(rb"HTTP/1\.1 (\d{3}) ")


class Report(NamedTuple):
    """What a siege came to.

    Attributes:
        requests: How many requests were sent, whole or not.
        frames: How many frames.
        statuses: How many answers had each code.
        kinds: How many attacks there were of each kind.
        before: Resident memory after the first tenth, MiB.
        after: At the end, MiB.
        highest: At its highest, MiB.
        seconds: How long it took.
        faults: Everything that must not be, a line or more for each.
    """

    requests: int
    frames: int
    statuses: dict[int, int]
    kinds: dict[str, int]
    before: float
    after: float
    highest: float
    seconds: float
    faults: list[str]


def besiege(
    room: Path, requests: int, visits: int, seed: int = 0, progress: Callable[[int], object] = lambda done: None
) -> Report:
    """Attack a studio in a process of its own, over the loopback.

    Args:
        room: An empty folder, or none yet.
        requests: How many requests.
        visits: How many visits of its socket, of one to some thousand frames.
        seed: Decides what is sent.
        progress: Told how many attacks were made since the last time.

    Raises:
        InvalidInputError: If the studio does not start, or an honest page cannot use it before.
    """
    with watched_studio(room) as studio:
        page = PageClient(studio.address)
        about = page.ask("GET", "studio")  # waits for OpenGL
        honest = _taught(page, seed, 2)
        kept = studio.journal(honest["id"])
        target = _target(page, studio, about["can_draw"], seed + 1)
        siege = _Siege(studio, page, target, seed, progress)
        start = time.perf_counter()
        before = asyncio.run(siege.run(requests, visits))
        seconds = time.perf_counter() - start
        try:
            if studio.journal(honest["id"]) != kept:
                siege.faults.append("a session that no attacker knew was changed")
            siege.faults += _look(page, studio.address, honest["id"])
        except (InvalidInputError, OSError) as error:
            siege.faults.append(f"an honest page, afterwards: {error}")
        after, highest = studio.memory()
        if after - before > MOST_GROWTH:
            siege.faults.append(f"memory grew from {before:.0f} to {after:.0f} MiB")
        faults = [*siege.faults, *(f"log: {line}" for line in studio.troubles())]
        faults += [f"file: {line}" for line in studio.touched()]
    counts = dict(sorted(siege.statuses.items())), dict(sorted(siege.kinds.items()))
    return Report(requests, siege.frames, *counts, before, after, highest, seconds, faults)


def _taught(page: PageClient, seed: int, count: int) -> Json:
    session = page.begin(seed)
    for _ in range(count):
        session = page.ask("POST", f"sessions/{session['id']}/demonstrations", page.demonstration(session))
    return session


def _target(page: PageClient, studio: WatchedStudio, can_draw: bool, seed: int) -> Target:
    """Make a session that attackers know, and look at what they can know."""
    session = _taught(page, seed, 2)
    where = f"sessions/{session['id']}"
    page.ask("POST", f"{where}/table", {})
    page.ask("POST", f"{where}/ask", {"signs": page.utterance(session, 0)})
    exports = page.ask("GET", "studio")["exports"]
    samples = {name: _get(f"{studio.address}api/{where}/export/{name}") for name in exports}
    description = json.loads(_get(f"{studio.address}openapi.json"))
    if not can_draw:  # an honest 503
        paths = description["paths"].items()
        description["paths"] = {path: one for path, one in paths if not path.endswith((".jpg", ".mp4"))}
    return Target(studio.address, description, session["id"], samples, str(studio.secret), LIMITS.body)


def _get(address: str) -> bytes:
    with build_opener(ProxyHandler({})).open(address, timeout=_PATIENCE) as answer:
        return bytes(answer.read())


def _look(page: PageClient, address: str, session_id: str) -> Iterator[str]:
    """Go on as if nothing had happened, and say what has."""
    if b"<html" not in _get(address):
        yield "the page is not served any more"
    where = f"sessions/{session_id}"
    found = page.ask("GET", where)
    session = page.ask("POST", f"{where}/demonstrations", page.demonstration(found))
    page.ask("POST", f"{where}/table", {})
    with closing(FrameWatcher(address)) as watcher:
        first_motion(page, watcher, session, 0)
        if watching := page.ask("GET", "health")["viewers"] - 1:
            yield f"{watching} attackers who left still watch"


def fault_of(attack: Attack, answer: bytes) -> str | None:
    """Return what must not be in the answer to an attack, or is missing; none if it is as it should be."""
    codes = _codes(answer)
    if any(code >= 500 for code in codes):
        return f"answered with {codes}: {answer[-200:]!r}"
    if SECRET.encode() in answer:
        return "told what is in a file outside its folder"
    if attack.whole and 408 in codes:
        return "a whole request was taken for a part of one"
    return "no answer" if attack.whole and not codes else None


def _codes(answer: bytes) -> list[int]:
    return [int(code) for code in _STATUS.findall(answer)]


class _Siege:
    """The attackers, and what they saw."""

    def __init__(
        self, studio: WatchedStudio, page: PageClient, target: Target, seed: int, progress: Callable[[int], object]
    ) -> None:
        self._studio, self._page, self._progress = studio, page, progress
        self._requests, self._sockets = HostileRequests(target, seed), HostileSockets(studio.address, seed)
        self._rng = random.Random(seed)
        parts = urlsplit(studio.address)
        self._where = str(parts.hostname), int(parts.port or 0)
        self.frames, self.faults = 0, list[str]()
        self.statuses: Counter[int] = Counter()
        self.kinds: Counter[str] = Counter()

    async def run(self, requests: int, visits: int) -> float:
        """Attack, and return the memory after the first tenth, MiB."""
        numbers = [*range(requests), *(~number for number in range(visits))]
        self._rng.shuffle(numbers)
        warm = round(_WARM * len(numbers))
        await self._attack_all(iter(numbers[:warm]))
        before = self._studio.memory().now
        await self._crowd()
        await self._attack_all(iter(numbers[warm:]))
        await self._crowd()
        return before

    async def _attack_all(self, numbers: Iterator[int]) -> None:
        async def attack() -> None:
            for number in numbers:
                made = self._requests.attack(number) if number >= 0 else self._sockets.attack(~number)
                self.kinds[made.kind] += 1
                self.frames += made.frames
                fault = await self._make(made)
                if fault and len(self.faults) < _MOST_FAULTS:
                    self.faults.append(f"{made.kind} {number}: {fault}: {b''.join(made.parts)[:300]!r}")
                self._progress(1)

        await asyncio.gather(*(attack() for _ in range(AT_ONCE)))

    async def _make(self, attack: Attack) -> str | None:
        """Make an attack, and return what must not have happened."""
        try:
            reader, writer = await asyncio.open_connection(*self._where)
        except OSError as error:
            return f"no connection ({error})"
        answer = b""
        with suppress(OSError, TimeoutError):  # to refuse what is hostile the server may close at any time
            for number, part in enumerate(attack.parts):
                writer.write(part)
                await asyncio.wait_for(writer.drain(), _PATIENCE if attack.reads else _IMPATIENCE)
                if attack.frames and not number:
                    answer = await asyncio.wait_for(reader.read(2**16), _GREETING)
                await asyncio.sleep(attack.pause)
            if attack.reads:
                async with asyncio.timeout(_PATIENCE if attack.whole else _IMPATIENCE):
                    while len(answer) < _ENOUGH and (more := await reader.read(2**16)):
                        answer += more
        writer.transport.abort()
        self.statuses.update(_codes(answer))
        return fault_of(attack, answer)

    async def _crowd(self) -> None:
        """Come with more connections than there may be, and stay, while an honest page asks for something."""
        self.kinds["crowd"] += 1
        beginnings = (b"", b"GET /", self._sockets.hello(), self._sockets.hello().replace(b"13", b"13\r\nX: ") * 9)
        writers = []
        for number in range(_CROWD):
            with suppress(OSError):
                _, writer = await asyncio.open_connection(*self._where)
                writer.write(beginnings[number % len(beginnings)])
                writers.append(writer)
        try:
            await asyncio.to_thread(self._page.ask, "GET", "health")
            await asyncio.to_thread(_get, self._studio.address)
        except (InvalidInputError, OSError) as error:
            self.faults.append(f"an honest page in a crowd: {error}")
        for writer in writers:
            writer.transport.abort()
