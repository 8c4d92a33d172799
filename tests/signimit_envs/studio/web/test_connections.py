"""What no browser does to a connection: half requests, no HTTP, no frames, floods, and never reading."""

from __future__ import annotations

import asyncio
import json
import logging
import socket
import struct
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any
from urllib.parse import urlsplit

import pytest

from signimit_envs.studio.limits import LIMITS, Limits
from signimit_envs.studio.siege.sockets import HostileSockets

pytest.importorskip("uvicorn", reason="the studio needs signimit[studio]")
connections = pytest.importorskip("signimit_envs.studio.web.connections")
PATIENCE = 30.0  # s, on a busy machine
TEXT, CONTINUED, CLOSE = 0x1, 0x0, 0x8
Connect = Callable[..., socket.socket]


@pytest.fixture
def connect(address: str) -> Iterator[Connect]:
    """Makes connections that have sent something."""
    where = urlsplit(address)
    with ExitStack() as open_ones:

        def make(content: bytes = b"") -> socket.socket:
            connection = open_ones.enter_context(socket.create_connection((where.hostname, where.port), PATIENCE))
            connection.sendall(content)
            return connection

        yield make


@pytest.fixture
def head(address: str) -> Callable[..., bytes]:
    """Makes the lines before a body."""
    where = urlsplit(address)

    def make(path: str, *headers: str, method: str = "POST") -> bytes:
        lines = (f"{method} {where.path.rstrip('/')}{path} HTTP/1.1", f"Host: {where.netloc}", *headers, "", "")
        return "\r\n".join(lines).encode()

    return make


def _read(connection: socket.socket) -> bytes:
    """Read until the server closes the connection."""
    found = b""
    try:
        while more := connection.recv(2**16):
            found += more
    except ConnectionResetError:
        pass
    return found


def _failures(caplog: pytest.LogCaptureFixture) -> list[logging.LogRecord]:
    return [record for record in caplog.records if record.levelno >= logging.ERROR or record.exc_info]


CHUNKED = "Transfer-Encoding: chunked"
NO_CHUNK = b"zz\r\nthis is no chunk\r\n\r\n"


@pytest.mark.parametrize("path", ["/nothing", "/api/sessions", "/api/import?format=strokes.csv"])
def test_a_body_that_is_no_body_ends_the_connection_and_is_no_failure(
    connect: Connect, head: Any, caplog: pytest.LogCaptureFixture, path: str
) -> None:
    answer = _read(connect(head(path, CHUNKED) + NO_CHUNK))
    assert answer.startswith(b"HTTP/1.1 400 ")
    late = connect(head(path, CHUNKED, "Host: again"))
    assert late.recv(2**16).startswith(b"HTTP/1.1 ")  # refused before its body came
    late.sendall(NO_CHUNK)
    _read(late)
    assert _failures(caplog) == []


def test_garbage_behind_a_request_that_is_being_answered_is_no_failure(
    connect: Connect, head: Any, caplog: pytest.LogCaptureFixture
) -> None:
    for path in ("/api/studio", "/api/sessions", "/nothing"):
        assert _read(connect(head(path, method="GET") + b"\x00\x01 garbage\r\n\r\n")).startswith(b"HTTP/1.1 ")
    assert _failures(caplog) == []


def test_a_body_that_breaks_off_is_no_failure(connect: Connect, head: Any, page: Any, caplog: Any) -> None:
    for path in ("/api/sessions", "/api/import?format=strokes.csv", "/nothing"):
        connect(head(path, "Content-Length: 1000") + b"{").close()
    page.get("health")
    assert _failures(caplog) == []


@pytest.mark.parametrize(
    ("more", "code"),
    [
        (f"X: {'a' * 20_000}", 400),
        ("Content-Length: 10", 400),
        ("X: a\r\n" * 300 + "X: a", 400),
        ("Sec-WebSocket-Version: 12", 400),
        ("Sec-WebSocket-Key: again", 400),
    ],
)
def test_a_handshake_that_is_none_is_refused_at_once(connect: Connect, head: Any, more: str, code: int) -> None:
    for path in ("/ws", "/../wrong/ws"):
        upgrade = ("Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: eA==")
        begin = time.monotonic()
        assert _read(connect(head(path, *upgrade, more, method="GET"))).startswith(b"HTTP/1.1 %d " % code)
        assert time.monotonic() - begin < PATIENCE


def test_of_too_many_connections_those_go_that_were_waited_for_longest(
    connect: Connect, head: Any, page: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    page.get("health")  # the page keeps its connection for the next request
    few = 6
    monkeypatch.setattr(connections, "LIMITS", Limits(connections=few))
    halves = (b"", b"GET /", head("/api/sessions", "Content-Length: 9"), head("/x", CHUNKED) + b"5\r\n")
    crowd = []
    for number in range(4 * few):
        crowd.append(connect(halves[number % len(halves)]))
        time.sleep(0.01)  # they come one after the other
    page.get("health")
    for gone in crowd[:few]:
        assert not _read(gone)
    crowd[-1].setblocking(False)
    with pytest.raises(BlockingIOError):
        crowd[-1].recv(1)


def test_a_page_that_watches_keeps_its_place_in_a_crowd(
    connect: Connect, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    sockets = HostileSockets(address, 0)
    watching = connect(sockets.hello())
    assert watching.recv(2**16).startswith(b"HTTP/1.1 101 ")
    monkeypatch.setattr(connections, "LIMITS", Limits(connections=3))
    for _ in range(9):
        connect()
        time.sleep(0.01)
    watching.sendall(b"\x81\x80\x00\x00\x00\x00")  # an empty message, which is answered by closing
    assert _code(watching) == 4400


def _code(connection: socket.socket) -> int:
    """Return the code that a socket is closed with."""
    frames, closing = b"", bytes([0x80 | CLOSE])
    while len(frames.partition(closing)[2]) < 3:
        frames += connection.recv(2**16)
    return int(struct.unpack(">H", frames.partition(closing)[2][1:3])[0])


def _frame(kind: int, content: bytes = b"", last: bool = True) -> bytes:
    return bytes([0x80 * last | kind, 0x80 | len(content), 0, 0, 0, 0]) + content


@pytest.mark.parametrize(
    ("frames", "code"),
    [
        (_frame(TEXT, b"\xed\xa0\x80"), 1007),
        (_frame(TEXT, b"\xc3", False) + _frame(CONTINUED, b"\x28"), 1007),
        (_frame(TEXT, last=False) + _frame(CONTINUED, last=False) * (LIMITS.message + 1), 1009),
        (_frame(TEXT, b"\xc3", False) + _frame(CONTINUED, b"\xa9"), 4400),
        (_frame(CONTINUED), 1002),
        (b"\x81\x00", 1002),
        (b"\xf1\x80\x00\x00\x00\x00", 1002),
        (_frame(CLOSE, b"\x00\x01"), 1002),
    ],
)
def test_frames_that_are_none_close_the_socket_with_a_code_and_are_no_failure(
    connect: Connect, address: str, caplog: pytest.LogCaptureFixture, frames: bytes, code: int
) -> None:
    connection = connect(HostileSockets(address, 0).hello())
    assert connection.recv(2**16).startswith(b"HTTP/1.1 101 ")
    connection.sendall(frames)
    assert _code(connection) == code
    assert _failures(caplog) == []


class _Transport:
    """A connection whose other end never reads."""

    def __init__(self) -> None:
        self.aborted = False
        self.written = b""

    def write(self, content: bytes) -> None:
        self.written += content

    def get_extra_info(self, name: str) -> None:
        return None

    def is_closing(self) -> bool:
        return self.aborted

    def close(self) -> None:
        """Wait for what is left to be read."""

    def pause_reading(self) -> None:
        """Go on: there is nothing to read."""

    def abort(self) -> None:
        self.aborted = True


async def _open_socket() -> tuple[Any, _Transport]:
    import uvicorn
    from uvicorn.server import ServerState

    async def app(scope: Any, receive: Any, send: Any) -> None:
        await send({"type": "websocket.accept"})
        await asyncio.sleep(PATIENCE)

    config = uvicorn.Config(app, http=connections.HttpConnection, ws=connections.SocketConnection)
    config.load()
    made = connections.SocketConnection(config=config, server_state=ServerState(), app_state={})
    transport = _Transport()
    made.connection_made(transport)
    made.data_received(HostileSockets("http://127.0.0.1:80/token/", 0).hello())
    while not made.handshake_complete:
        await asyncio.sleep(0)
    return made, transport


def test_who_pings_and_never_reads_is_let_go() -> None:
    async def ping() -> tuple[bool, bool]:
        made, transport = await _open_socket()
        made.data_received(_frame(0x9, b"x"))
        before = transport.aborted
        made.pause_writing()  # as the transport does when too much is not read
        made.data_received(_frame(0x9, b"x"))
        made.stop_keepalive()
        return before, transport.aborted

    assert asyncio.run(ping()) == (False, True)


def test_who_is_silent_is_let_go_although_there_is_something_left_to_read() -> None:
    async def be_silent() -> bool:
        made, transport = await _open_socket()
        made.keepalive_timeout()
        made.stop_keepalive()
        return transport.aborted

    assert asyncio.run(be_silent())


def test_an_honest_page_is_served_after_all_this(page: Any) -> None:
    assert json.dumps(page.get("sessions"))
