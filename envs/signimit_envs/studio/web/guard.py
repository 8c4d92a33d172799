"""ASGI middleware: token, Host and Origin checks, rate and size limits."""

from __future__ import annotations

import asyncio
import ipaddress
import json
import logging
import secrets
import time
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from typing import Any

from signimit_envs.studio.limits import LIMITS

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

HEADERS = (
    (
        b"content-security-policy",
        b"default-src 'self'; img-src 'self' blob: data:; media-src 'self' blob:; object-src 'none'; base-uri 'none'; "
        b"form-action 'none'; frame-ancestors 'none'",
    ),
    (b"referrer-policy", b"no-referrer"),
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cache-control", b"no-store"),
)
_NAVIGATION = {b"sec-fetch-mode": [b"navigate"], b"sec-fetch-dest": [b"document"]}
_log = logging.getLogger(__name__)


class Bucket:
    """Token bucket: lets so many things a second pass, and so many at once."""

    def __init__(self, rate: float, burst: float) -> None:
        """Start full."""
        self._rate, self._burst = rate, burst
        self._left, self._at = burst, time.monotonic()

    def take(self) -> bool:
        """Take a token; tell whether there was one."""
        now = time.monotonic()
        self._left = min(self._burst, self._left + self._rate * (now - self._at))
        self._at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True


class Guard:
    """ASGI middleware about an application, which is reached under ``/TOKEN/``.

    A page elsewhere can make a browser send requests here, and by DNS rebinding even read the answers. So the Host
    must be one of ours, the Origin, where there is one, must be that Host, and the token must be in the path. What a
    browser says comes from another site is let in only if it opens a page of its own with it, as a click on the
    address in a web terminal does: such an answer is shown to the person, and the other site cannot read it.
    """

    def __init__(self, app: App, token: str, hosts: frozenset[str], any_address: bool = False) -> None:
        """Remember which requests are let in.

        Args:
            app: What is guarded.
            token: First part of every path.
            hosts: Values of the Host header that are ours, with the port.
            any_address: Let in any Host that is an IP address rather than a name; addresses cannot be rebound.
        """
        self._app, self._token, self._hosts, self._any_address = app, token.encode(), hosts, any_address
        self._bucket, self._bodies = Bucket(LIMITS.requests, LIMITS.burst), _Bodies()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Hand a request on to the application, or refuse it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is not None:
            status, sentence = refusal
            _log.warning("refused %s with %d: %s", scope["type"], status, sentence)
            await _refuse(scope, send, status, sentence)
            return
        prefix = "/" + self._token.decode()
        if scope["path"] == prefix:  # what makes addresses clickable likes to leave the last slash out
            await _redirect(scope, send, prefix + "/")
            return
        inner = dict(scope)
        inner["path"] = scope["path"][len(prefix) :]
        inner["raw_path"] = inner["path"].encode()
        if scope["type"] == "http":
            most = LIMITS.upload if inner["path"] == "/api/import" else LIMITS.body
            await _Bounded(self._app, most, self._bodies).serve(inner, receive, send)
        else:
            await self._app(inner, receive, send)

    def _refusal(self, scope: Scope) -> tuple[int, str] | None:
        headers = [(name.lower(), value) for name, value in scope["headers"]]
        hosts = [value.decode("latin-1") for name, value in headers if name == b"host"]
        if len(hosts) != 1 or not self._is_ours(hosts[0]):
            return 403, "This studio is not at that address."
        origins = [value.decode("latin-1") for name, value in headers if name == b"origin"]
        if origins not in ([], [f"http://{hosts[0]}"]):
            return 403, "Other pages may not use this studio."
        sites = [value for name, value in headers if name == b"sec-fetch-site"]
        if any(site not in (b"same-origin", b"none") for site in sites) and not _opens_page(scope, headers):
            return 403, "Other pages may not use this studio."
        first, slash, _ = scope["path"].removeprefix("/").partition("/")
        is_token = secrets.compare_digest(first.encode("utf-8", "replace"), self._token)
        if not is_token or not (slash or _is_reading(scope)):
            return 404, "There is nothing here. The studio printed its whole address when it started."
        if not self._bucket.take():
            return 429, f"Too many requests: at most {LIMITS.requests} a second."
        return None

    def _is_ours(self, host: str) -> bool:
        if host in self._hosts:
            return True
        name, _, port = host.rpartition(":")
        same_port = any(ours.rpartition(":")[2] == port for ours in self._hosts)
        return self._any_address and same_port and _is_address(name)


class _Bounded:
    """Serves one request: takes its body, which must come soon and not be too large; adds our headers to the answer."""

    def __init__(self, app: App, most: int, bodies: _Bodies) -> None:
        self._app, self._most, self._bodies = app, most, bodies
        self._body = bytearray()
        self._started = False

    async def serve(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            refusal = await self._take(scope, receive)
            if refusal is None:
                await self._answer(scope, receive, send)
            else:
                await _refuse(scope, send, *refusal)
        except _LeftError:
            return  # nobody waits for an answer
        finally:
            self._bodies.held -= len(self._body)

    async def _take(self, scope: Scope, receive: Receive) -> tuple[int, str] | None:
        """Take the body whole, so that the application never sees one that breaks off; return why not."""
        too_large = 413, f"Too large: at most {self._most} bytes."
        lengths = [value for name, value in scope["headers"] if name.lower() == b"content-length"]
        if any(not value.isdigit() or int(value[:20]) > self._most for value in lengths):
            return too_large
        try:
            async with asyncio.timeout(LIMITS.patience):
                more = True
                while more:
                    message = await receive()
                    if message["type"] == "http.disconnect":
                        raise _LeftError
                    part, more = message.get("body", b""), message.get("more_body", False)
                    self._body += part
                    self._bodies.held += len(part)
                    if len(self._body) > self._most:
                        return too_large
                    if self._bodies.held > LIMITS.held:
                        return 429, f"Too much at once: at most {LIMITS.held} bytes of all requests together."
        except TimeoutError:
            return 408, f"Too slow: a request must be here within {LIMITS.patience:g} s."
        return None

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        whole = iter([{"type": "http.request", "body": bytes(self._body), "more_body": False}])

        async def taken() -> Message:
            return next(whole, None) or await receive()

        async def marked(message: Message) -> None:
            if message["type"] == "http.response.start":
                message = {**message, "headers": [*message.get("headers", ()), *HEADERS]}
                self._started = True
            await send(message)

        try:
            await self._app(scope, taken, marked)
        except Exception:
            _log.exception("a request failed")
            if not self._started:
                await _refuse(scope, send, 500, "The studio failed; its log says how.")


class _LeftError(Exception):
    """Whoever sent a request left before its end."""


class _Bodies:
    """Bytes of the bodies of all requests that are under way."""

    held = 0


def _is_reading(scope: Scope) -> bool:
    """Tell whether a request is one that changes nothing."""
    return scope["type"] == "http" and scope["method"] in ("GET", "HEAD")


def _opens_page(scope: Scope, headers: Iterable[tuple[bytes, bytes]]) -> bool:
    """Tell whether a browser says that it opens a page of its own with the answer, no frame in another one."""
    told = {name: [value for other, value in headers if other == name] for name in _NAVIGATION}
    return _is_reading(scope) and told == _NAVIGATION


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return False
    return True


async def _refuse(scope: Scope, send: Send, status: int, sentence: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": sentence})
        return
    body = json.dumps({"error": sentence}).encode()
    await _answer(send, status, [(b"content-type", b"application/json")], body)


async def _redirect(scope: Scope, send: Send, path: str) -> None:
    """Send a browser to another path here, with the question that it came with."""
    question = scope["query_string"]
    await _answer(send, 307, [(b"location", path.encode() + (b"?" + question if question else b""))], b"")


async def _answer(send: Send, status: int, headers: list[tuple[bytes, bytes]], body: bytes) -> None:
    length = (b"content-length", str(len(body)).encode())
    await send({"type": "http.response.start", "status": status, "headers": [*headers, length, *HEADERS]})
    await send({"type": "http.response.body", "body": body})
