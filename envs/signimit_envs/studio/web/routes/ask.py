"""Routes of Ask: the live table, answers of the arm, verdicts, and the socket."""

from __future__ import annotations

import asyncio
import contextlib
import logging

import numpy as np
from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.arm.viewers import Viewer
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page.views import answer_json, session_json, track_json
from signimit_envs.studio.store.event_json import stroke_to_json
from signimit_envs.studio.store.events import Judged
from signimit_envs.studio.studio import Studio
from signimit_envs.studio.web.guard import Bucket
from signimit_envs.studio.web.messages import (
    Ask,
    Drag,
    NewVerdict,
    Shove,
    Watch,
    printable,
    read_socket_message,
    signs_of,
)
from signimit_envs.studio.web.routes.dependencies import Json, Number, SessionId, TheStudio

BAD_MESSAGE, TOO_MANY_MESSAGES, TOO_MANY_VIEWERS, TOO_BIG, NOT_TEXT = 4400, 4429, 4503, 1009, 1003
_REASON = 120  # bytes, of 123 that a socket can be closed with
_LEFT = (WebSocketDisconnect, OSError)  # what sending to a page raises that is gone
_log = logging.getLogger(__name__)
routes = APIRouter(tags=["ask"])


@routes.post("/api/sessions/{session_id}/table")
async def table(studio: TheStudio, session_id: SessionId) -> Json:
    """Put the arm and new objects on the live table."""
    objects, hand = studio.set_table(await studio.open(session_id))
    return {"objects": objects.tolist(), "hand": hand.tolist()}


@routes.post("/api/sessions/{session_id}/ask")
async def ask(studio: TheStudio, session_id: SessionId, body: Ask) -> Json:
    """Let the arm answer two signs, on the live table as it is."""
    session = await studio.open(session_id)
    request = None if body.request is None else body.request.request()
    number = await studio.ask(session, signs_of(body.signs), request)
    studio.changed(session)
    answer = answer_json(session, number, session.history.answers[number], studio.arm.state)
    return {**answer, "running": not answer["held"]}


@routes.post("/api/sessions/{session_id}/answers/{number}/insist")
async def insist(studio: TheStudio, session_id: SessionId, number: Number) -> Json:
    """Let the arm do what it has asked back about."""
    session = await studio.open(session_id)
    await studio.insist(session, number)
    studio.changed(session)
    answer = answer_json(session, number, session.answer(number), studio.arm.state)
    return {**answer, "running": True}


@routes.post("/api/sessions/{session_id}/stop")
async def stop(studio: TheStudio, session_id: SessionId) -> Json:
    """Let the arm hold still."""
    session = await studio.open(session_id)
    if studio.arm.state.session == session.name:
        studio.arm.rest()
    return {}


@routes.post("/api/sessions/{session_id}/answers/{number}/verdict")
async def verdict(studio: TheStudio, session_id: SessionId, number: Number, body: NewVerdict) -> Json:
    """Keep a person's verdict on an answer."""
    session = await studio.open(session_id)
    session.answer(number)
    await session.note(Judged(number, body.good))
    studio.changed(session)
    return session_json(session, studio.arm.state)


@routes.get("/api/sessions/{session_id}/answers/{number}")
async def answer(studio: TheStudio, session_id: SessionId, number: Number) -> Json:
    """Return what the arm was asked and what it did."""
    session = await studio.open(session_id)
    answered = session.answer(number)
    parts = await asyncio.to_thread(studio.store.read_track, session.name, number)
    return {
        **answer_json(session, number, answered, studio.arm.state),
        "signs": [stroke_to_json(sign) for sign in answered.asked.signs],
        **track_json(parts),
    }


@routes.websocket("/ws")
async def live(studio: TheStudio, socket: WebSocket) -> None:
    """Send frames and news to a page, and do what it says."""
    with contextlib.suppress(*_LEFT):
        await socket.accept()
        if len(studio.viewers) >= LIMITS.viewers:
            await socket.close(TOO_MANY_VIEWERS, f"at most {LIMITS.viewers} pages")
            return
        viewer = Viewer()
        studio.viewers.add(viewer)
        sending = asyncio.create_task(_send(socket, viewer))
        try:
            await _listen(socket, viewer, studio)
        finally:
            studio.viewers.remove(viewer)
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await sending


async def _send(socket: WebSocket, viewer: Viewer) -> None:
    """Send what there is until the page goes away."""
    with contextlib.suppress(RuntimeError, *_LEFT):
        while True:
            message = await viewer.take()
            if isinstance(message, bytes):
                await socket.send_bytes(message)
            else:
                await socket.send_text(message)


async def _listen(socket: WebSocket, viewer: Viewer, studio: Studio) -> None:
    """Do what the page says until it goes away or says what it must not."""
    bucket = Bucket(LIMITS.messages, LIMITS.messages)
    while True:
        received = await socket.receive()
        if received["type"] == "websocket.disconnect":
            return
        text = received.get("text")
        try:
            if not bucket.take():
                raise Refusal(TOO_MANY_MESSAGES, f"at most {LIMITS.messages} messages a second")
            _obey(_parse(text), viewer, studio)
        except Refusal as refusal:
            _log.warning("closed a socket with %d: %s", refusal.code, refusal.reason)
            await socket.close(refusal.code, refusal.reason.encode()[:_REASON].decode(errors="ignore"))
            return


class Refusal(Exception):
    """A message that closes the socket, with its code and reason."""

    def __init__(self, code: int, reason: str) -> None:
        """Keep both."""
        self.code, self.reason = code, printable(reason)
        super().__init__(code, reason)


def _parse(text: str | None) -> Watch | Drag | Shove:
    if text is None:
        raise Refusal(NOT_TEXT, "text only")
    if len(text.encode("utf-8", "replace")) > LIMITS.message:
        raise Refusal(TOO_BIG, f"at most {LIMITS.message} bytes")
    try:
        return read_socket_message(text)
    except InvalidInputError as error:
        raise Refusal(BAD_MESSAGE, str(error)) from None


def _obey(message: Watch | Drag | Shove, viewer: Viewer, studio: Studio) -> None:
    if isinstance(message, Watch):
        viewer.watching = message.on
    elif isinstance(message, Drag):
        studio.arm.drag(message.object, np.array(message.to))
    else:
        studio.arm.shove(np.array(message.velocity))
