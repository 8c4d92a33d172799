"""Hostile WebSocket: handshakes and frames, as bytes, that no browser would send."""

from __future__ import annotations

import json
import random
import struct
from collections.abc import Callable, Sequence
from typing import Any
from urllib.parse import urlsplit

from signimit_envs.studio.siege.bodies import HOSTILE
from signimit_envs.studio.siege.requests import Attack

_CONTINUED, _TEXT, _BINARY, _CLOSE, _PING, _PONG = 0x0, 0x1, 0x2, 0x8, 0x9, 0xA
_KEY = "eHh4eHh4eHh4eHh4eHh4eA=="
_UPGRADE = ("Upgrade: websocket", "Connection: Upgrade", f"Sec-WebSocket-Key: {_KEY}", "Sec-WebSocket-Version: 13")
_ODD = (
    "Sec-WebSocket-Version: 12", "Sec-WebSocket-Key: x", "Sec-WebSocket-Protocol: a, \xe9, b", "Content-Length: 10",
    "Sec-WebSocket-Extensions: permessage-deflate; server_max_window_bits=99", f"X: {'a' * 20_000}", "Origin: null",
    "Transfer-Encoding: chunked", "Upgrade: h2c", "Host: evil.example", "Sec-Fetch-Site: cross-site", "X: \xe9\xff",
)  # fmt: skip
_CODES = (0, 999, 1000, 1004, 1005, 1006, 1015, 2999, 3000, 4999, 5000, 65535)
_FLOOD = 3000  # frames
_FEW = 30  # frames


class HostileSockets:
    """Visit number n depends on the seed and n alone, so that any of them can be made again."""

    def __init__(self, address: str, seed: int) -> None:
        """Take the address that the studio printed, and a seed."""
        parts = urlsplit(address)
        self._host, self._root, self._seed = parts.netloc, parts.path.rstrip("/"), seed

    def attack(self, number: int) -> Attack:
        """Return a visit."""
        rng = random.Random(f"{self._seed}/socket/{number}")
        kinds: tuple[Callable[[random.Random], list[bytes]], ...] = (
            _messages, _messages, _messages, _odd_messages, _odd_messages, _sizes, _parts, _controls, _bytes, _flood,
        )  # fmt: skip
        if rng.random() < 0.1:
            return self._handshake(rng)
        make = rng.choice(kinds)
        frames = make(rng)
        reads = rng.random() < 0.8 and make is not _flood
        sent = b"".join(frames)
        if rng.random() < 0.15:
            sent = sent[: rng.randrange(len(sent) + 1)]  # and goes in the middle of a frame
        name = make.__name__.strip("_")
        return Attack(name, (self.hello(), sent), 0.002 if reads else 0.2, False, reads, len(frames))

    def hello(self) -> bytes:
        """Return a handshake that the server takes."""
        return _head(f"{self._root}/ws", (f"Host: {self._host}", *_UPGRADE))

    def _handshake(self, rng: random.Random) -> Attack:
        path = rng.choice(("/ws", "/ws/", "/", "", "/api/health", "/../ws", "/ws?a=%00", "x/ws"))
        headers = [f"Host: {self._host}", *_UPGRADE, *rng.sample(_ODD, rng.randint(0, 2))]
        if rng.random() < 0.3:
            del headers[rng.randrange(len(headers))]
        method = rng.choice(("GET", "GET", "GET", "POST", "HEAD"))
        return Attack(
            "handshake", (_head(self._root + path, headers, method), b"".join(_bytes(rng))), whole=False, frames=1
        )


def _messages(rng: random.Random) -> list[bytes]:
    """Make messages as the page sends them, with numbers that it would not send."""
    numbers = (0, 0.1, -0.3, 1e6, -1e6, 1e-300, 0.05)
    made = []
    for _ in range(rng.randint(1, _FEW)):
        pair = [rng.choice(numbers), rng.choice(numbers)]
        message = rng.choice(
            ({"type": "watch", "on": rng.random() < 0.8}, {"type": "shove", "velocity": pair},
             {"type": "drag", "object": rng.randrange(6), "to": pair})
        )  # fmt: skip
        made.append(_frame(_TEXT, json.dumps(message).encode(), rng))
    return made


def _odd_messages(rng: random.Random) -> list[bytes]:
    """Make a message that has something else somewhere."""
    message: dict[str, Any] = {"type": rng.choice(("watch", "drag", "shove", "x")), "on": True}
    for _ in range(rng.randint(1, 3)):
        key = rng.choice(("type", "on", "object", "to", "velocity", "é" * 200, "\x1b]0;x\x07", "__proto__"))
        message[key] = rng.choice(HOSTILE)
    text = rng.choice(
        (json.dumps(message), json.dumps(message, ensure_ascii=False), json.dumps(rng.choice(HOSTILE)), "{")
    )
    return [_frame(_TEXT, text.encode("utf-8", "surrogatepass"), rng), *_messages(rng)[:3]]


def _sizes(rng: random.Random) -> list[bytes]:
    """Make a frame that is too long, or says so."""
    size = rng.choice((0, 125, 126, 1024, 1025, 4096, 4097, 65_535, 65_536, 1_000_000))
    if rng.random() < 0.5:
        return [_frame(rng.choice((_TEXT, _BINARY)), rng.choice((b" ", b"x", b"\xf0")) * size, rng)]
    said = rng.choice((2**16, 2**31, 2**40, 2**63 - 1, 2**63))
    return [bytes([0x80 | _TEXT, 0x80 | 127]) + struct.pack(">Q", said) + rng.randbytes(2000)]


def _parts(rng: random.Random) -> list[bytes]:
    """Make a message in many parts, some of them empty, or out of order."""
    text = rng.choice((b'{"type":"watch","on":true}', b"\xc3\xa9" * 200, b"x" * 5000, b"\xed\xa0\x80"))
    step = rng.choice((1, 2, 7))
    pieces = [text[n : n + step] for n in range(0, len(text), step)]
    empty = [b""] * rng.choice((0, 0, 2000))
    pieces = pieces[:-1] + empty + pieces[-1:]
    kinds = [_TEXT] + [_CONTINUED] * (len(pieces) - 1)
    if rng.random() < 0.3:
        kinds[rng.randrange(len(kinds))] = rng.choice((_TEXT, _BINARY, _CONTINUED))
    last = len(pieces) - 1
    frames = [_frame(kind, piece, rng, n == last) for n, (kind, piece) in enumerate(zip(kinds, pieces, strict=True))]
    if rng.random() < 0.5:
        frames.insert(rng.randrange(len(frames)), _frame(_PING, b"x", rng))
    return frames


def _controls(rng: random.Random) -> list[bytes]:
    """Make pings, pongs and closing frames as they must not be."""
    code = struct.pack(">H", rng.choice(_CODES))
    reason = rng.choice((b"", b"bye", b"\xff\xfe", b"x" * 120))
    return rng.choice(
        ([_frame(_CLOSE, code + reason, rng)], [_frame(_CLOSE, b"\x03", rng)], [_frame(_CLOSE, b"", rng)] * 3,
         [_frame(_PING, b"x" * 126, rng)], [_frame(_PING, b"", rng, False)],
         [_frame(_PONG, rng.randbytes(9), rng)] * _FEW, [_frame(_CLOSE, code, rng), *_messages(rng)])
    )  # fmt: skip


def _bytes(rng: random.Random) -> list[bytes]:
    """Make what is no frame: odd opcodes, reserved bits, no mask, or anything."""
    return [
        rng.choice(
            (bytes([0x80 | rng.randrange(16) | 0x10 * rng.randrange(8), 0x82]) + rng.randbytes(6), b"\x81\x02{}",
             rng.randbytes(rng.randrange(200)), b"GET / HTTP/1.1\r\n\r\n", _frame(_BINARY, rng.randbytes(90), rng))
        )
    ]  # fmt: skip


def _flood(rng: random.Random) -> list[bytes]:
    """Make very many frames, of which the answers are never read."""
    watch = _frame(_TEXT, b'{"type":"watch","on":true}', rng)
    if rng.random() < 0.5:
        return [watch, *[_frame(_PING, b"x" * 125, rng)] * _FLOOD]
    return [watch, _frame(_TEXT, b"", rng, False), *[_frame(_CONTINUED, b"", rng, False)] * _FLOOD]


def _frame(kind: int, content: bytes, rng: random.Random, last: bool = True) -> bytes:
    """Return a frame with a mask, as a browser sends it."""
    size, mask = len(content), rng.randbytes(4)
    if size < 126:
        length = bytes([0x80 | size])
    elif size < 2**16:
        length = b"\xfe" + struct.pack(">H", size)
    else:
        length = b"\xff" + struct.pack(">Q", size)
    repeated = (mask * (size // 4 + 1))[:size]
    masked = (int.from_bytes(content) ^ int.from_bytes(repeated)).to_bytes(size)
    return bytes([0x80 * last | kind]) + length + mask + masked


def _head(path: str, headers: Sequence[str], method: str = "GET") -> bytes:
    return "\r\n".join((f"{method} {path} HTTP/1.1", *headers, "", "")).encode("latin-1")
