"""Only the page that the studio gave out comes in, not too often and not with too much."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, MutableMapping
from types import SimpleNamespace
from typing import Any

import pytest

from signimit_envs.studio.limits import LIMITS, Limits
from signimit_envs.studio.web.guard import HEADERS, Bucket, Guard

httpx = pytest.importorskip("httpx")
TOKEN, HOST = "secret-token", "127.0.0.1:8000"


async def _echo(scope: Any, receive: Any, send: Any) -> None:
    """Answer with the path and the number of bytes of the body."""
    size, more = 0, True
    while more:
        message = await receive()
        if message["type"] == "http.disconnect":
            raise ConnectionError("gone")
        size, more = size + len(message.get("body", b"")), message.get("more_body", False)
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": f"{scope['path']} {size}".encode()})


async def _broken(scope: Any, receive: Any, send: Any) -> None:
    raise RuntimeError("a secret of the inside")


def _ask(path: str, app: Any = _echo, method: str = "GET", any_address: bool = False, **more: Any) -> Any:
    async def ask() -> Any:
        guard = Guard(app, TOKEN, frozenset({HOST, "localhost:8000"}), any_address)
        transport = httpx.ASGITransport(app=guard)
        async with httpx.AsyncClient(transport=transport, base_url=f"http://{HOST}") as client:
            return await client.request(method, path, **more)

    return asyncio.run(ask())


def test_who_has_the_token_comes_in_and_the_application_does_not_see_it() -> None:
    answer = _ask(f"/{TOKEN}/api/studio")
    assert (answer.status_code, answer.text) == (200, "/api/studio 0")


@pytest.mark.parametrize(
    "path", ["/", "/api/studio", "/secret-toke/", "/secret-toke", "/Secret-token", "/Secret-token/", "//", "/é/x"]
)
def test_without_the_token_there_is_nothing(path: str) -> None:
    answer = _ask(path)
    assert answer.status_code == 404
    assert set(answer.json()) == {"error"}


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8000", "127.0.0.1", "127.0.0.1:8001", "", "10.0.0.1:8000"]
)
def test_a_foreign_host_is_refused(host: str) -> None:
    assert _ask(f"/{TOKEN}/", headers={"Host": host}).status_code == 403


@pytest.mark.parametrize(
    ("origin", "status"),
    [(f"http://{HOST}", 200), ("http://evil.example", 403), ("null", 403), (f"https://{HOST}", 403), ("", 403),
     ("http://localhost:8000", 403)],
)  # fmt: skip
def test_a_foreign_origin_is_refused(origin: str, status: int) -> None:
    assert _ask(f"/{TOKEN}/", headers={"Origin": origin}).status_code == status


@pytest.mark.parametrize(
    ("site", "status"), [("same-origin", 200), ("none", 200), ("cross-site", 403), ("same-site", 403)]
)
def test_a_browser_that_says_so_is_believed(site: str, status: int) -> None:
    assert _ask(f"/{TOKEN}/", headers={"Sec-Fetch-Site": site}).status_code == status


OPENS = {"Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}


@pytest.mark.parametrize("site", ["cross-site", "same-site", "none", "same-origin"])
@pytest.mark.parametrize("user", [{}, {"Sec-Fetch-User": "?1"}])
def test_a_click_on_the_address_in_another_page_opens_the_studio(site: str, user: dict[str, str]) -> None:
    assert _ask(f"/{TOKEN}/", headers={"Sec-Fetch-Site": site, **OPENS, **user}).status_code == 200


@pytest.mark.parametrize(
    ("method", "changed"),
    [
        ("POST", {}),
        ("DELETE", {}),
        ("GET", {"Sec-Fetch-Dest": "iframe"}),
        ("GET", {"Sec-Fetch-Dest": "embed"}),
        ("GET", {"Sec-Fetch-Dest": "empty"}),
        ("GET", {"Sec-Fetch-Mode": "no-cors"}),
        ("GET", {"Sec-Fetch-Mode": "cors", "Sec-Fetch-Dest": "empty"}),
        ("GET", {"Sec-Fetch-Mode": "websocket"}),
        ("GET", {"Sec-Fetch-Mode": "navigate, navigate"}),
        ("GET", {"Origin": "http://evil.example"}),
        ("GET", {"Origin": "null"}),
        ("GET", {"Host": "evil.example:8000"}),
    ],
)
@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_another_page_can_do_nothing_but_open_the_studio(site: str, method: str, changed: dict[str, str]) -> None:
    headers = {"Sec-Fetch-Site": site, **OPENS, **changed}
    assert _ask(f"/{TOKEN}/", method=method, headers=headers).status_code == 403


def test_another_page_that_does_not_know_the_token_opens_nothing() -> None:
    assert _ask("/wrong-token/", headers={"Sec-Fetch-Site": "cross-site", **OPENS}).status_code == 404


def test_two_modes_of_one_request_are_not_believed() -> None:
    headers = [("Sec-Fetch-Site", "cross-site"), *OPENS.items(), ("Sec-Fetch-Mode", "cors")]
    assert _ask(f"/{TOKEN}/", headers=headers).status_code == 403


@pytest.mark.parametrize("site", ["none", "cross-site"])
def test_the_last_slash_is_added_to_the_address(site: str) -> None:
    headers = {"Sec-Fetch-Site": site, **OPENS}
    for path, whole in ((f"/{TOKEN}", f"/{TOKEN}/"), (f"/{TOKEN}?a=1&b=/x", f"/{TOKEN}/?a=1&b=/x")):
        answer = _ask(path, headers=headers)
        assert (answer.status_code, answer.headers["location"]) == (307, whole)
        assert _ask(answer.headers["location"], headers=headers).status_code == 200


def test_nothing_but_looking_goes_without_the_last_slash() -> None:
    assert _ask(f"/{TOKEN}", method="POST").status_code == 404
    assert _ask(f"/{TOKEN}", headers={"Host": "evil.example:8000"}).status_code == 403


def test_two_hosts_are_refused() -> None:
    headers = [("Host", HOST), ("Host", HOST)]
    assert _ask(f"/{TOKEN}/", headers=headers).status_code == 403


def test_any_address_but_no_other_name_comes_in_where_others_may() -> None:
    for host, status in (
        ("192.168.0.7:8000", 200),
        ("[::1]:8000", 200),
        ("evil.example:8000", 403),
        ("10.0.0.1:9", 403),
    ):
        assert _ask(f"/{TOKEN}/", any_address=True, headers={"Host": host}).status_code == status


def test_every_answer_has_the_headers_of_a_careful_server() -> None:
    for path in (f"/{TOKEN}/", "/nothing"):
        headers = _ask(path).headers
        for name, value in HEADERS:
            assert headers[name.decode()] == value.decode()
        assert "unsafe" not in headers["content-security-policy"]


def test_a_body_that_says_it_is_too_large_is_refused_unread() -> None:
    answer = _ask(f"/{TOKEN}/x", method="POST", content=bytes(LIMITS.body + 1))
    assert answer.status_code == 413
    assert _ask(f"/{TOKEN}/x", method="POST", content=bytes(LIMITS.body)).status_code == 200
    assert _ask(f"/{TOKEN}/x", method="POST", headers={"Content-Length": "-1"}).status_code == 413
    assert _ask(f"/{TOKEN}/x", method="POST", headers={"Content-Length": "9" * 5000}).status_code == 413


def test_a_body_that_turns_out_too_large_is_refused() -> None:
    async def chunks() -> AsyncIterator[bytes]:
        for _ in range(5):
            yield bytes(2**20)

    assert _ask(f"/{TOKEN}/x", method="POST", content=chunks()).status_code == 413
    assert _ask(f"/{TOKEN}/api/import", method="POST", content=chunks()).status_code == 200


def _serve(app: Any, messages: list[Any], *others: Any) -> list[MutableMapping[str, Any]]:
    """Serve a request that comes in pieces, and return what is sent; a number is a wait, s."""
    sent: list[MutableMapping[str, Any]] = []
    headers = [(b"host", HOST.encode())]
    scope = {"type": "http", "method": "POST", "path": f"/{TOKEN}/x", "query_string": b"", "headers": headers}

    async def serve(guard: Guard, messages: list[Any], send: Any) -> None:
        coming = iter(messages)

        async def receive() -> Any:
            message = next(coming, {"type": "http.disconnect"})
            if isinstance(message, float):
                await asyncio.sleep(message)
                message = next(coming)
            return message

        await guard(scope, receive, send)

    async def keep(message: MutableMapping[str, Any]) -> None:
        sent.append(message)

    async def drop(message: MutableMapping[str, Any]) -> None:
        pass

    async def serve_all() -> None:
        guard = Guard(app, TOKEN, frozenset({HOST}))
        slow = [asyncio.create_task(serve(guard, other, drop)) for other in others]
        await asyncio.sleep(0)
        await serve(guard, messages, keep)
        for task in slow:
            task.cancel()

    asyncio.run(serve_all())
    return sent


def _part(content: bytes, more: bool = True) -> dict[str, Any]:
    return {"type": "http.request", "body": content, "more_body": more}


def test_a_body_that_does_not_come_is_not_waited_for_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.web.guard.LIMITS", Limits(patience=0.05))
    refused = _serve(_broken, [_part(b"a"), 60.0, _part(b"b", False)])
    assert (refused[0]["status"], b"within 0.05 s" in refused[1]["body"]) == (408, True)


def test_bodies_of_all_requests_together_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.web.guard.LIMITS", Limits(held=1000))
    half, rest = [_part(bytes(600)), 60.0, _part(b"", False)], [_part(bytes(600), False)]
    assert _serve(_echo, rest)[0]["status"] == 200
    assert _serve(_echo, rest, half)[0]["status"] == 429
    assert _serve(_echo, rest, rest)[0]["status"] == 200  # what was answered counts no more


def test_the_application_hears_nothing_of_a_request_that_breaks_off(caplog: pytest.LogCaptureFixture) -> None:
    assert _serve(_broken, [_part(b"half")]) == []
    assert caplog.records == []


def test_a_failure_inside_is_logged_and_not_told(caplog: pytest.LogCaptureFixture) -> None:
    answer = _ask(f"/{TOKEN}/x", app=_broken)
    assert (answer.status_code, answer.json()) == (500, {"error": "The studio failed; its log says how."})
    assert "a secret of the inside" in caplog.text


def test_a_socket_is_refused_before_it_is_opened() -> None:
    sent: list[MutableMapping[str, Any]] = []

    async def send(message: MutableMapping[str, Any]) -> None:
        sent.append(message)

    async def receive() -> dict[str, Any]:
        return {"type": "websocket.connect"}

    headers = [(b"host", HOST.encode()), (b"origin", b"http://evil.example")]
    scope = {"type": "websocket", "path": f"/{TOKEN}/ws", "headers": headers}
    asyncio.run(Guard(_broken, TOKEN, frozenset({HOST}))(scope, receive, send))
    assert [message["type"] for message in sent] == ["websocket.close"]


def test_a_bucket_lets_so_many_pass_at_once_and_then_so_many_a_second(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr("signimit_envs.studio.web.guard.time", SimpleNamespace(monotonic=lambda: now))
    bucket = Bucket(rate=10, burst=3)
    assert [bucket.take() for _ in range(5)] == [True] * 3 + [False] * 2
    now += 0.2
    assert [bucket.take() for _ in range(3)] == [True, True, False]
    now += 1000
    assert [bucket.take() for _ in range(4)] == [True] * 3 + [False]


def test_too_many_requests_are_told_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.web.guard.time", SimpleNamespace(monotonic=lambda: 100.0))

    async def ask() -> list[int]:
        transport = httpx.ASGITransport(app=Guard(_echo, TOKEN, frozenset({HOST})))
        async with httpx.AsyncClient(transport=transport, base_url=f"http://{HOST}") as client:
            return [(await client.get(f"/{TOKEN}/")).status_code for _ in range(LIMITS.burst + 40)]

    codes = asyncio.run(ask())
    assert codes == [200] * LIMITS.burst + [429] * 40
