"""Routes of Keep: export of a session and import of another."""

from __future__ import annotations

import asyncio
from enum import StrEnum
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response

from signimit_envs.studio.page.exports import FORMATS, Lesson, export_bytes, import_bytes
from signimit_envs.studio.page.prompts import FREE, get_language
from signimit_envs.studio.page.views import session_json
from signimit_envs.studio.store.events import Demonstrated
from signimit_envs.studio.web.messages import Title
from signimit_envs.studio.web.routes.dependencies import Json, SessionId, TheStudio

routes = APIRouter(prefix="/api", tags=["keep"])
FormatName = StrEnum("FormatName", {name: name for name in FORMATS})  # type: ignore[misc]


@routes.get("/sessions/{session_id}/export/{name}")
async def export(studio: TheStudio, session_id: SessionId, name: FormatName) -> Response:
    """Export the demonstrations, or what was learned from them."""
    session = await studio.open(session_id)
    lesson = Lesson(session.history.shown, get_language(session.created.language), session.learned.model)
    content = await asyncio.to_thread(export_bytes, name.value, lesson)
    headers = {"Content-Disposition": f'attachment; filename="{session.name}-{name.value}"'}
    return Response(content, media_type=FORMATS[name.value].media_type, headers=headers)


@routes.post("/import", status_code=201)
async def take_in(
    studio: TheStudio, request: Request, format: FormatName, title: Annotated[Title, Query()] = ""
) -> Json:
    """Begin a session with the demonstrations of a file, which is the body."""
    content = await request.body()
    shown = await studio.render(lambda: import_bytes(format.value, content))
    session = await studio.create(title.strip(), FREE, len(shown[0].objects))
    await session.edit(session.history.revision, Demonstrated(shown))
    studio.changed(session)
    return session_json(session, studio.arm.state)
