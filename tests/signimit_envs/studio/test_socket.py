"""The socket: frames for who watches, news for all, and a code for who misbehaves."""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit import InvalidInputError
from signimit_envs.studio.arm.live_state import LiveState
from signimit_envs.studio.arm.viewers import Viewer, Viewers
from signimit_envs.studio.web.messages import Drag, Shove, Watch, read_socket_message

WebSocketDisconnect = pytest.importorskip("fastapi", reason="the studio needs signimit[studio]").WebSocketDisconnect
live = pytest.importorskip("signimit_envs.studio.web.routes.ask").live
client = pytest.importorskip("websockets.sync.client", reason="the studio needs signimit[studio]")
exceptions = pytest.importorskip("websockets.exceptions")
Json = dict[str, Any]
FRAMES = 1000  # after so many a page has seen what it waits for, on a busy machine too
BAD, TOO_MANY, NO_ROOM = 4400, 4429, 4503


def _connect(page: Any, **more: Any) -> Any:
    origin = "/".join(page.address.split("/")[:3])
    return client.connect(page.address.replace("http", "ws", 1) + "ws", **{"origin": origin, "proxy": None, **more})


@pytest.fixture
def socket(page: Any) -> Iterator[Any]:
    with _connect(page) as connection:
        yield connection


def _next_frame(socket: Any) -> tuple[Json, bytes]:
    while True:
        message = socket.recv(timeout=60)
        if isinstance(message, bytes):
            size = struct.unpack(">I", message[:4])[0]
            return json.loads(message[4 : 4 + size]), message[4 + size :]


def _next_news(socket: Any) -> Json:
    while True:
        message = socket.recv(timeout=60)
        if isinstance(message, str):
            return dict(json.loads(message))


def _closing_code(socket: Any) -> int:
    try:
        while True:
            socket.recv(timeout=60)
    except exceptions.ConnectionClosed as closed:
        return int(closed.rcvd.code)


def _say(socket: Any, **message: Any) -> None:
    socket.send(json.dumps(message))


def test_frames_come_to_who_watches_with_what_is_in_them(page: Any, socket: Any) -> None:
    why_not = page.get("studio")["why_not"]
    _say(socket, type="watch", on=True)
    header, picture = _next_frame(socket)
    assert set(header) == {
        "session", "answer", "time", "hand", "objects", "trail", "text", "focus", "moving", "done", "shoved",
    }  # fmt: skip
    assert picture.startswith(b"\xff\xd8") or (why_not and not picture)


@pytest.mark.slow
def test_two_pages_get_the_frames_of_one_simulation(page: Any, socket: Any, taught_id: str) -> None:
    request = {"movement": 0, "focus": 0}
    page.post(f"sessions/{taught_id}/table", {})
    with _connect(page) as other:
        for one in (socket, other):
            _say(one, type="watch", on=True)
        answer = page.post(f"sessions/{taught_id}/ask", {"signs": page.signs(taught_id, request, 5)})
        seen = []
        for one in (socket, other):
            frames = (_next_frame(one)[0] for _ in range(FRAMES))
            seen.append(next(header for header in frames if header["moving"] and header["session"] == taught_id))
    assert [header["answer"] for header in seen] == [answer["number"]] * 2
    assert seen[0]["text"] == seen[1]["text"] == answer["text"]
    page.post(f"sessions/{taught_id}/stop", {})


def test_who_drags_an_object_sees_it_move(page: Any, socket: Any, session: Json) -> None:
    page.post(f"sessions/{session['id']}/table", {})
    _say(socket, type="watch", on=True)
    _say(socket, type="drag", object=1, to=[0.1, -0.2])
    frames = (_next_frame(socket)[0] for _ in range(FRAMES))
    assert any(header["objects"][1] == [0.1, -0.2] for header in frames)


def test_every_tab_hears_of_every_change(page: Any, socket: Any, session: Json) -> None:
    page.post(f"sessions/{session['id']}/title", {"revision": 0, "title": "new"})
    news = _next_news(socket)
    while news != {"type": "changed", "session": session["id"], "revision": 1, "events": 2}:
        news = _next_news(socket)
    assert page.get(f"sessions/{session['id']}")["events"] == 2


@pytest.mark.parametrize(
    ("message", "code"),
    [
        ("nonsense", BAD),
        ("{}", BAD),
        ("[]", BAD),
        ("[" * 1000, BAD),
        ('{"type": "watch"}', BAD),
        ('{"type": "watch", "on": true, "more": 1}', BAD),
        (f'{{"type": "watch", "on": true, "{"é" * 300}": 1}}', BAD),
        ('{"type": "watch", "on": true, "\\ud800": 1}', BAD),
        ('{"type": "drag", "object": 6, "to": [0, 0]}', BAD),
        ('{"type": "drag", "object": 0, "to": [0, NaN]}', BAD),
        ('{"type": "shove", "velocity": [1e400, 0]}', BAD),
        ('{"type": "shove", "velocity": [1]}', BAD),
        (" " * 1025, 1009),
        ("x" * 100_000, 1009),
        (b"bytes", 1003),
    ],
)
def test_what_is_no_message_closes_the_socket_with_a_code(message: Any, code: int, socket: Any) -> None:
    socket.send(message)
    assert _closing_code(socket) == code


def test_too_many_messages_close_the_socket(page: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    with _connect(page) as socket:
        monkeypatch.setattr("signimit_envs.studio.web.guard.Bucket.take", lambda self: False)
        _say(socket, type="shove", velocity=[0, 0])
        assert _closing_code(socket) == TOO_MANY


class _Gone:
    """A page that says nonsense, and is gone when it is told so."""

    def __init__(self, gone_from: str) -> None:
        self._gone_from = gone_from

    async def accept(self) -> None:
        if self._gone_from == "accept":
            raise OSError

    async def receive(self) -> Json:
        return {"type": "websocket.receive", "text": "nonsense"}

    async def close(self, code: int, reason: str) -> None:
        raise WebSocketDisconnect(1006)


@pytest.mark.parametrize("gone_from", ["accept", "close"])
def test_a_page_that_is_gone_when_it_is_told_something_is_no_failure(gone_from: str) -> None:
    async def come() -> int:
        studio: Any = SimpleNamespace(viewers=Viewers())
        socket: Any = _Gone(gone_from)
        await live(studio, socket)
        return len(studio.viewers)

    assert asyncio.run(come()) == 0


def test_only_so_many_pages_may_come(page: Any) -> None:
    from contextlib import ExitStack

    with ExitStack() as pages:
        sockets = [pages.enter_context(_connect(page)) for _ in range(12)]
        assert _closing_code(sockets[-1]) == NO_ROOM
        _say(sockets[0], type="watch", on=False)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://localhost:1"])
def test_another_page_cannot_open_a_socket(origin: str, page: Any) -> None:
    with pytest.raises(exceptions.InvalidStatus, match="403"), _connect(page, origin=origin):
        pass


def test_without_the_token_there_is_no_socket(page: Any) -> None:
    address = "/".join(page.address.split("/")[:3]).replace("http", "ws", 1) + "/wrong/ws"
    with pytest.raises(exceptions.InvalidStatus, match=r"403|404"), client.connect(address, proxy=None):
        pass


ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.sampled_from(["watch", "drag", "shove", ""]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from("abc"), inner, max_size=2),
    max_leaves=6,
)
KEYS = st.sampled_from(["type", "on", "object", "to", "velocity", "more"])


@settings(deadline=None, max_examples=30)
@given(st.dictionaries(KEYS, ANYTHING) | ANYTHING)
def test_whatever_a_page_says_it_is_a_message_or_refused_in_a_sentence(value: Any) -> None:
    try:
        message = read_socket_message(json.dumps(value))
    except InvalidInputError:
        return
    assert isinstance(message, Watch | Drag | Shove)
    numbers = message.to if isinstance(message, Drag) else message.velocity if isinstance(message, Shove) else (0.0,)
    assert np.isfinite(numbers).all()


@settings(deadline=None, max_examples=30)
@given(st.binary(max_size=60))
def test_whatever_the_text_it_is_a_message_or_refused_in_a_sentence(content: bytes) -> None:
    with pytest.raises(InvalidInputError):
        read_socket_message(content.decode("latin-1"))


def test_a_slow_page_gets_the_newest_frame_and_all_news_first() -> None:
    async def watch() -> list[str | bytes]:
        viewers, viewer = Viewers(), Viewer()
        viewers.add(viewer)
        viewer.watching = True
        for frame in (b"1", b"2", b"3"):
            viewers.publish(frame)
        viewers.tell({"a": 1})
        viewers.tell({"a": 2})
        return [await viewer.take() for _ in range(3)]

    assert asyncio.run(watch()) == ['{"a": 1}', '{"a": 2}', b"3"]


def test_who_does_not_watch_gets_no_frames_and_who_left_gets_nothing() -> None:
    async def watch() -> tuple[bool, bool, int]:
        viewers, viewer = Viewers(), Viewer()
        viewers.add(viewer)
        viewers.publish(b"1")
        before = viewers.watching
        viewer.watching = True
        viewers.publish(b"2")
        assert await viewer.take() == b"2"
        during = viewers.watching
        viewers.remove(viewer)
        viewers.remove(viewer)
        viewers.publish(b"3")
        return before, during, len(viewers)

    assert asyncio.run(watch()) == (False, True, 0)


def test_a_page_that_comes_late_hears_what_stands() -> None:
    async def come() -> str | bytes:
        viewers = Viewers()
        viewers.tell({"passing": 1})
        viewers.tell({"standing": 1}, standing=True)
        late = Viewer()
        viewers.add(late)
        return await late.take()

    assert asyncio.run(come()) == '{"standing": 1}'


def test_a_page_that_comes_after_the_play_is_over_is_not_led_anywhere() -> None:
    async def come() -> str | bytes:
        viewers = Viewers()
        viewers.tell({"standing": 1}, standing=True)
        viewers.forget()
        late = Viewer()
        viewers.add(late)
        viewers.tell({"passing": 1})
        return await late.take()

    assert asyncio.run(come()) == '{"passing": 1}'


def test_a_waiting_page_wakes_for_a_frame_from_another_thread() -> None:
    async def wait() -> str | bytes:
        viewer = Viewer()
        waiting = asyncio.create_task(viewer.take())
        await asyncio.sleep(0)
        await asyncio.to_thread(viewer.put_frame, b"frame")
        return await asyncio.wait_for(waiting, 60)

    assert asyncio.run(wait()) == b"frame"


def test_states_are_told_in_numbers_that_json_can_say() -> None:
    from signimit_envs.studio.arm.camera import frame_header

    state = LiveState(
        None, None, None, 0.1, 0.1, np.zeros(3), np.ones(2) / 3, np.zeros((3, 2)), ((0.1, 0.2),), False, 0.0
    )
    header = json.loads(json.dumps(frame_header(state), allow_nan=False))
    assert header["hand"] == [0.3333, 0.3333]
    assert header["moving"] is False
