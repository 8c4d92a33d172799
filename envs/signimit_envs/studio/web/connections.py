"""Connections of the server, on which the other end may do what no browser does.

uvicorn's own are made for well-behaved ends: one that sends half a request, or never reads, keeps its place for ever,
and what is no HTTP at the wrong moment is an error in the log. Here a server that is full takes the place of whoever
has kept it waiting longest, and all that cannot be read ends the connection.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterable
from typing import cast

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import CloseCode, Frame

from signimit_envs.studio.limits import LIMITS

_BROKEN_HANDSHAKE = b"HTTP/1.1 400 Bad Request\r\nConnection: close\r\nContent-Length: 0\r\n\r\n"


class HttpConnection(H11Protocol):
    """A connection that speaks HTTP, until a socket takes it over."""

    waiting_since = 0.0
    """Since when the other end has had its turn, s, if it still has."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as in uvicorn
        """Take a connection, in the place of another if there are too many."""
        full = len(self.connections) >= LIMITS.connections
        super().connection_made(transport)
        self.waiting_since = time.monotonic()
        if full:
            waiting = [other for other in _ours(self.connections) if other.waits_for_client() and other is not self]
            leaving = min(waiting, key=lambda other: other.waiting_since, default=self)
            leaving.transport.abort()

    def waits_for_client(self) -> bool:
        """Tell whether the next step is up to the other end: to ask, to finish asking, or to read."""
        asked = self.cycle is not None and not self.cycle.response_complete and not self.cycle.more_body
        return not asked or self.flow.write_paused or self.transport.is_closing()

    def on_response_complete(self) -> None:
        """Go on with the next request."""
        self.waiting_since = time.monotonic()
        super().on_response_complete()

    def send_400_response(self, msg: str) -> None:
        """Refuse what is no HTTP, if there is still an answer to give; it is then the last one."""
        if self.cycle is not None and not self.cycle.response_complete:
            self.cycle.disconnected = True  # what the application answers to it has no place to go to
            self.cycle.message_event.set()
        try:
            super().send_400_response(msg)
        except h11.LocalProtocolError:  # it came during or after the answer to what it pretends to belong to
            self.transport.close()


class SocketConnection(WebSocketsSansIOProtocol):
    """A connection that speaks WebSocket."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take a connection over from HTTP."""
        super().connection_made(transport)
        self.waiting_since = time.monotonic()

    def waits_for_client(self) -> bool:
        """Tell whether the next step is up to the other end, which is to read or to leave."""
        return self.close_sent or not self.writable.is_set() or self.transport.is_closing()

    def data_received(self, data: bytes) -> None:
        """Read what came; the first is a whole request, which HTTP has read before."""
        super().data_received(data)
        if not self.handshake_initiated and not self.transport.is_closing():
            self.transport.write(_BROKEN_HANDSHAKE)
            self.transport.close()

    def handle_cont(self, event: Frame) -> None:
        """Take a further part of a message, of which there may not be endlessly many empty ones."""
        if len(self.frames) >= LIMITS.message:
            self._end(CloseCode.MESSAGE_TOO_BIG)
        else:
            super().handle_cont(event)

    def send_receive_event_to_app(self) -> None:
        """Hand a message on, if it is text or bytes as it says."""
        if self.curr_msg_data_type == "text":
            try:
                b"".join(self.frames).decode()
            except UnicodeDecodeError:
                self._end(CloseCode.INVALID_DATA)
                return
        super().send_receive_event_to_app()

    def handle_ping(self) -> None:
        """Answer, unless answers pile up unread."""
        if self.writable.is_set():
            super().handle_ping()
        else:
            self.transport.abort()

    def keepalive_timeout(self) -> None:
        """Let go of an end that is silent; it will not read what is left to send either."""
        super().keepalive_timeout()
        self.transport.abort()

    def handle_parser_exception(self) -> None:
        """Let go of an end that sends no frames, if need be before the socket is open."""
        if self.conn.close_sent is None:
            self.transport.abort()
        else:
            super().handle_parser_exception()

    def _end(self, code: CloseCode) -> None:
        self.frames = []
        self.conn.fail(code)
        self.handle_parser_exception()


def _ours(connections: Iterable[object]) -> list[HttpConnection | SocketConnection]:
    return [cast(HttpConnection | SocketConnection, connection) for connection in connections]
