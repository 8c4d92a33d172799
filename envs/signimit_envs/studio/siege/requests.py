"""Hostile HTTP: requests over all routes that the server describes, as bytes, and what may be sent in their place."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple
from urllib.parse import quote, urlencode, urlsplit

from signimit_envs.studio.siege.bodies import SchemaBodies, broken_bytes, file_bytes, json_bytes

Json = dict[str, Any]
METHODS = ("get", "post", "put", "delete")
_ODD_METHODS = ("HEAD", "OPTIONS", "PATCH", "TRACE", "CONNECT", "PROPFIND", "get", "G" * 300, "DEBUG")
_UP = (
    *(
        "..",
        "%2e%2e",
        "%252e%252e",
        "..%2f",
        "..%5c",
        "..%c0%af",
        "%c0%ae%c0%ae",
        "..;",
        ".%00.",
        "%uff0e%uff0e",
        "....",
    ),
    *("%e3%80%82%e3%80%82", "..%252f", "%2e%2e%2f", "..\\"),
)
_SLOW = ("film.mp4", "figures", "scene.jpg", "similarities")  # a second of the server's time each
_SLOW_SHARE = 0.02
_PROBABLE = 0.02  # of a part of a body that is else as described
_HEADERS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("Origin", ("null", "http://evil.example", "https://{host}", "http://{host}", "http://{host}.evil.example", "")),
    ("Sec-Fetch-Site", ("cross-site", "same-site", "same-origin", "none", "x", "")),
    ("Sec-Fetch-Mode", ("navigate", "cors", "no-cors", "websocket", "")),
    ("Sec-Fetch-Dest", ("document", "iframe", "empty", "object", "")),
    (
        "Content-Type",
        ("text/plain", "application/xml", "multipart/form-data", "application/json;charset=utf-7", "\xff"),
    ),
    ("Content-Encoding", ("gzip", "br", "x")),
    ("Transfer-Encoding", ("chunked", "gzip, chunked", "identity", "xchunked")),
    ("Content-Length", ("0", "5", "-1", "+3", "1e3", "9" * 30, "9" * 5000, "0x5", "3, 3", " 3")),
    ("Expect", ("100-continue", "x")),
    ("Upgrade", ("h2c", "websocket", "x")),
    ("Connection", ("Upgrade", "keep-alive", "x, close, Upgrade")),
    ("Range", ("bytes=0-", "bytes=-1", "bytes=9-1,0-0", "x" * 3000)),
    ("X-Forwarded-Host", ("evil.example",)),
    ("X-HTTP-Method-Override", ("DELETE",)),
    ("Cookie", ("a=b", "x" * 6000, "\xe9\xff")),
    ("X", ("", "a" * 60_000, "a\tb", "\xe9", "a\r\n b")),
)


class Attack(NamedTuple):
    """What is sent on one connection.

    Attributes:
        kind: What is wrong with it, in a word.
        parts: Bytes, sent one after the other.
        pause: Between two parts, s.
        whole: Whether it is a request from end to end, which has to be answered.
        reads: Whether the answer is read.
        frames: How many frames are in it, if it goes to the socket.
    """

    kind: str
    parts: tuple[bytes, ...]
    pause: float = 0.0
    whole: bool = True
    reads: bool = True
    frames: int = 0


class Target(NamedTuple):
    """What an attacker knows who has the address.

    Attributes:
        address: The address that the studio printed.
        description: Its ``openapi.json``.
        session: Name of a session with demonstrations.
        samples: Exported files by the name of their format.
        secret: Path of a file outside the studio's folder.
        largest: Bytes of the largest body that the server takes.
    """

    address: str
    description: Json
    session: str
    samples: Mapping[str, bytes]
    secret: str
    largest: int


class HostileRequests:
    """Attack number n depends on the seed and n alone, so that any of them can be made again."""

    def __init__(self, target: Target, seed: int) -> None:
        """Take what is attacked, and a seed."""
        self._target, self._seed = target, seed
        parts = urlsplit(target.address)
        self._host, self._root = parts.netloc, parts.path.rstrip("/")
        self._bodies = SchemaBodies(target.description)
        routes = target.description["paths"].items()
        self._routes = [(m, path, one) for path, all_ in routes for m, one in all_.items() if m in METHODS]
        self._quick = [route for route in self._routes if not any(slow in route[1] for slow in _SLOW)]

    def attack(self, number: int) -> Attack:
        """Return an attack."""
        rng = random.Random(f"{self._seed}/{number}")
        kinds: tuple[Callable[[random.Random], Attack], ...] = (
            self._route, self._route, self._route, self._route, self._headers, self._headers, self._path, self._path,
            self._token, self._body, self._body, self._file, self._protocol, self._protocol, self._chunks, self._slow,
        )  # fmt: skip
        return rng.choice(kinds)(rng)

    def _route(self, rng: random.Random, hostility: float = _PROBABLE) -> Attack:
        head, body = self._described(rng, hostility)
        return Attack("route", (_request(*head, body),))

    def _described(self, rng: random.Random, hostility: float) -> tuple[tuple[str, str, Sequence[str]], bytes]:
        """Return a request for one of the routes: method, path and headers, and the body."""
        routes = self._routes if rng.random() < _SLOW_SHARE else self._quick
        method, path, operation = rng.choice(routes)
        asked: dict[str, str] = {}
        for parameter in operation.get("parameters", ()):
            name, value = parameter["name"], self._bodies.make(parameter["schema"], rng, hostility)
            if name == "session_id" and rng.random() > hostility:
                value = self._target.session
            text = quote(str(value), safe="", errors="replace")[:2000]
            if parameter["in"] == "path":
                path = path.replace(f"{{{name}}}", text)
            elif rng.random() > hostility:
                asked[name] = str(value)[:2000]
        question = f"?{urlencode(asked, errors='replace')}" if asked else ""
        body = b""
        if "requestBody" in operation:
            schema = next(iter(operation["requestBody"]["content"].values()))["schema"]
            body = json_bytes(self._bodies.make(schema, rng, hostility), rng)
        headers = (f"Host: {self._host}", "Content-Type: application/json", "Connection: close")
        return (method.upper(), f"{self._root}{path}{question}", headers), body

    def _headers(self, rng: random.Random) -> Attack:
        (method, path, headers), body = self._described(rng, _PROBABLE)
        changed = list(headers)
        for _ in range(rng.randint(1, 4)):
            name, values = rng.choice(_HEADERS)
            changed.append(f"{name}: {rng.choice(values).format(host=self._host)}")
        if rng.random() < 0.2:
            changed += ["Host: evil.example"] if rng.random() < 0.5 else [f"X{n}: {n}" for n in range(300)]
        if rng.random() < 0.2:
            changed[0] = (
                f"Host: {rng.choice(('evil.example', '', '127.0.0.1', '[::1]:80', f'{self._host}.', 'a' * 9000))}"
            )
        if rng.random() < 0.1:
            method = rng.choice(_ODD_METHODS)
        return Attack("headers", (_request(method, path, changed, body),), whole=False)

    def _path(self, rng: random.Random) -> Attack:
        up, deep = rng.choice(_UP), rng.randint(1, 12)
        where = rng.choice(
            ("", "/api/sessions", "/api", f"/api/sessions/{self._target.session}/export", "/api/sessions/x")
        )
        secret = self._target.secret
        goal = rng.choice(
            (secret, secret.replace("/", "%2f"), "/etc/passwd", "\\windows\\win.ini", "/journal.jsonl", "")
        )
        path = rng.choice(
            (f"{where}/{'/'.join([up] * deep)}{goal}", f"{where}/{up * deep}{goal}", f"{where}{goal}",
             f"{where}//{goal}",
             f"{where}/{goal}%00.js", f"{where}/{rng.randbytes(12).hex('%')}", f"{where}/" + "a" * 60_000,
             f"{where}/{quote(chr(rng.choice((1, 0x85, 0x2028, 0x202E, 0x1F590))))}", f"{where}/?{'a=b&' * 5000}")
        )  # fmt: skip
        headers = (f"Host: {self._host}", "Connection: close")
        return Attack(
            "path", (_request(rng.choice(("GET", "GET", "POST", "DELETE")), self._root + path, headers, b""),)
        )

    def _token(self, rng: random.Random) -> Attack:
        token = self._root[1:]
        other = rng.choice(
            (token[:-1], token + "x", token.swapcase(), "", "." * 32, token[::-1], f"{token}%00", f"%2f{token}",
             f"{token}/../{token}x", f"\\{token}", "".join(f"%{ord(mark):02x}" for mark in token), f"{token};x", "é")
        )  # fmt: skip
        method, path, _ = rng.choice(self._quick)
        target = quote(f"/{other}{path}", safe="/%\\;.")
        return Attack("token", (_request(method.upper(), target, (f"Host: {self._host}", "Connection: close"), b"{}"),))

    def _body(self, rng: random.Random) -> Attack:
        if rng.random() < 0.6:
            return self._route(rng, 0.25)._replace(kind="body")
        (method, path, headers), _ = self._described(rng, 0.0)
        if method in ("GET", "DELETE"):
            method, path = "POST", f"{self._root}/api/sessions"
        body = broken_bytes(rng, self._target.largest)
        return Attack("body", (_request(method, path, headers, body),), whole=len(body) <= self._target.largest)

    def _file(self, rng: random.Random) -> Attack:
        name = rng.choice(tuple(self._target.samples))
        body = file_bytes(name, self._target.samples[name], rng, self._target.secret)
        path = f"{self._root}/api/import?format={rng.choice((name, name, name, 'x', '../x'))}"
        return Attack("file", (_request("POST", path, (f"Host: {self._host}", "Connection: close"), body),))

    def _protocol(self, rng: random.Random) -> Attack:
        (method, path, headers), body = self._described(rng, 0.0)
        request = _request(method, path, headers, body)
        match rng.randrange(8):
            case 0:
                content = rng.randbytes(rng.randrange(400))
            case 1:
                content = request[: rng.randrange(len(request))]
            case 2:
                content = request.replace(b"Connection: close", b"X: y", 1) * 3 + rng.randbytes(20)
            case 3:
                content = request.replace(b"\r\n", rng.choice((b"\n", b"\r", b"\r\n\r\n", b"\r\n ", b"\x00")))
            case 4:
                content = request.replace(
                    b"HTTP/1.1", rng.choice((b"HTTP/2.0", b"HTTP/9", b"", b"HTTP/1.0", b"RTSP/1.0"))
                )
            case 5:
                content = request + request[: rng.randrange(len(request))]
            case 6:
                content = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + rng.randbytes(30)
            case _:
                changed = bytearray(request)
                for _ in range(rng.randint(1, 5)):
                    changed[rng.randrange(len(changed))] = rng.randrange(256)
                content = bytes(changed)
        cut = rng.randrange(len(content) + 1)
        return Attack("protocol", (content[:cut], content[cut:]), 0.002, whole=False)

    def _chunks(self, rng: random.Random) -> Attack:
        (method, path, headers), body = self._described(rng, 0.0)
        method = method if method != "GET" else "POST"
        more = "Transfer-Encoding: chunked"
        smuggled = ("Content-Length: 5",) if rng.random() < 0.2 else ()
        head = _head(method, path, (*headers, more, *smuggled))
        size = rng.choice(
            (f"{len(body):x}", f"{len(body) + 5:x}", "-1", "zz", "f" * 20, "0", f"{len(body):x};{'a' * 900}", "")
        )
        end = rng.choice(
            (b"\r\n0\r\n\r\n", b"\r\n0\r\nX: y\r\n\r\n", b"0\r\n\r\n", b"\r\n", b"\r\nzz\r\n\r\n", b"\x00" * 40)
        )
        return Attack("chunks", (head, size.encode() + b"\r\n", body, end), 0.002, whole=False)

    def _slow(self, rng: random.Random) -> Attack:
        (method, path, headers), body = self._described(rng, 0.0)
        request = _request(method, path, headers, body)
        match rng.randrange(4):
            case 0:  # says that more will come
                head = _head("POST", path, (*headers, f"Content-Length: {len(body) + 1000}"))
                return Attack("slow", (head, body), 0.01, whole=False)
            case 1:  # asks, and never reads
                asked = request.replace(b"Connection: close", b"X: y", 1) * rng.randint(1, 20)
                return Attack("slow", (asked,), 0.05, whole=False, reads=False)
            case 2:
                return Attack(
                    "slow", tuple(request[n : n + 1] for n in range(min(30, len(request)))), 0.001, whole=False
                )
        middle = len(request) // 2
        return Attack("slow", (request[:middle], request[middle:]), 0.01)


def _head(method: str, path: str, headers: Sequence[str]) -> bytes:
    lines = (f"{method} {path} HTTP/1.1", *headers, "", "")
    return "\r\n".join(lines).encode("latin-1", "replace")


def _request(method: str, path: str, headers: Sequence[str], body: bytes) -> bytes:
    length = () if method == "GET" and not body else (f"Content-Length: {len(body)}",)
    return _head(method, path, (*headers, *length)) + body
