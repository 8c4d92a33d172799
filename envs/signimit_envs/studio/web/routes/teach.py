"""Routes of Teach: sessions, demonstrations, drafts, undo and redo, and the built-in people."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import Annotated, Any

from fastapi import APIRouter, Query, Response

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.open_session import NotFoundError, OpenSession
from signimit_envs.studio.page.built_in_people import draw_answer, draw_utterance
from signimit_envs.studio.page.prompts import get_language, next_request
from signimit_envs.studio.page.views import demonstration_json, session_json
from signimit_envs.studio.store.event_json import stroke_to_json
from signimit_envs.studio.store.events import (
    Deleted,
    Demonstrated,
    DrawnDemonstration,
    Event,
    Named,
    Redone,
    Redrawn,
    Titled,
    Undone,
)
from signimit_envs.studio.studio import Studio
from signimit_envs.studio.web.messages import (
    Merge,
    NewDemonstration,
    NewDraft,
    NewSession,
    NewTitle,
    PeopleRequest,
    Revised,
    signs_of,
)
from signimit_envs.studio.web.routes.dependencies import Json, Number, SessionId, TheStudio

RevisionQuery = Annotated[int, Query(ge=0, le=10 * LIMITS.events)]
routes = APIRouter(prefix="/api/sessions", tags=["teach"])


@routes.get("")
async def listed(studio: TheStudio) -> Json:
    """List the sessions, the newest first."""
    found = await asyncio.to_thread(studio.store.listed)
    return {"sessions": [one._asdict() for one in found]}


@routes.post("", status_code=201)
async def create(studio: TheStudio, body: NewSession) -> Json:
    """Begin a session."""
    language = get_language(body.language)
    objects = body.objects if language is None else language.objects
    session = await studio.create(body.title.strip(), body.language, objects, body.seed)
    studio.changed(session)
    return session_json(session, studio.arm.state)


@routes.get("/{session_id}")
async def shown(studio: TheStudio, session_id: SessionId) -> Json:
    """Return a session."""
    return session_json(await studio.open(session_id), studio.arm.state)


@routes.get("/{session_id}/scene.jpg")
async def scene(studio: TheStudio, session_id: SessionId) -> Response:
    """Picture the table of the next demonstration."""
    session = await studio.open(session_id)
    return await _still(studio, session.learned.objects)


@routes.post("/{session_id}/demonstrations")
async def demonstrate(studio: TheStudio, session_id: SessionId, body: NewDemonstration) -> Json:
    """Add a demonstration, made in the scene that the session said comes next."""
    session = await studio.open(session_id)
    language, prompt = get_language(session.created.language), None
    if body.prompted and language is not None:
        prompts = [shown.prompt for shown in session.history.shown]
        prompt = next_request(language, session.created.seed, prompts).request
    shown = DrawnDemonstration(signs_of(body.signs), session.learned.objects, body.hand_stroke(), prompt, body.by)
    return await _edited(studio, session, body.revision, Demonstrated((shown,)))


@routes.put("/{session_id}/demonstrations/{number}")
async def redraw(studio: TheStudio, session_id: SessionId, number: Number, body: NewDemonstration) -> Json:
    """Put another drawing in the place of a demonstration, in its scene."""
    session = await studio.open(session_id)
    old = session.demonstration(number)
    prompt = old.prompt if body.prompted else None
    again = DrawnDemonstration(signs_of(body.signs), old.objects, body.hand_stroke(), prompt, body.by)
    return await _edited(studio, session, body.revision, Redrawn(number, again))


@routes.put("/{session_id}/draft")
async def draft(studio: TheStudio, session_id: SessionId, body: NewDraft) -> Json:
    """Keep what is drawn of a demonstration that is not sent yet, at the places that are named."""
    session = await studio.open(session_id)
    if body.number is not None:
        session.demonstration(body.number)
    return await _edited(studio, session, body.revision, body.event())


@routes.delete("/{session_id}/demonstrations/{number}")
async def delete(studio: TheStudio, session_id: SessionId, number: Number, revision: RevisionQuery) -> Json:
    """Take a demonstration out."""
    session = await studio.open(session_id)
    session.demonstration(number)
    return await _edited(studio, session, revision, Deleted(number))


@routes.get("/{session_id}/demonstrations/{number}")
async def demonstration(studio: TheStudio, session_id: SessionId, number: Number) -> Json:
    """Return the strokes of a demonstration."""
    return demonstration_json(await studio.open(session_id), number)


@routes.get("/{session_id}/demonstrations/{number}/scene.jpg")
async def demonstration_scene(studio: TheStudio, session_id: SessionId, number: Number) -> Response:
    """Picture the table of a demonstration."""
    return await _still(studio, (await studio.open(session_id)).demonstration(number).objects)


@routes.post("/{session_id}/undo")
async def undo(studio: TheStudio, session_id: SessionId, body: Revised) -> Json:
    """Take the last edit back."""
    return await _edited(studio, await studio.open(session_id), body.revision, Undone())


@routes.post("/{session_id}/redo")
async def redo(studio: TheStudio, session_id: SessionId, body: Revised) -> Json:
    """Take the last undo back."""
    return await _edited(studio, await studio.open(session_id), body.revision, Redone())


@routes.post("/{session_id}/title")
async def title(studio: TheStudio, session_id: SessionId, body: NewTitle) -> Json:
    """Give the session another title."""
    return await _edited(studio, await studio.open(session_id), body.revision, Titled(body.title.strip()))


@routes.delete("/{session_id}")
async def delete_session(studio: TheStudio, session_id: SessionId) -> Json:
    """Delete a session, for good."""
    await studio.delete(await studio.open(session_id))
    return {}


@routes.post("/{session_id}/movements/{number}/name")
async def name_movement(studio: TheStudio, session_id: SessionId, number: Number, body: NewTitle) -> Json:
    """Give a movement a name, or take it away."""
    session = await studio.open(session_id)
    movements = session.model.movements
    if number >= len(movements):
        raise NotFoundError("There is no such movement.")
    return await _edited(studio, session, body.revision, Named(movements[number].members[0], body.title.strip()))


@routes.post("/{session_id}/merge")
async def merge(studio: TheStudio, session_id: SessionId, body: Merge) -> Json:
    """Append another session's demonstrations."""
    session, other = await studio.open(session_id), await studio.open(body.other)
    if not other.history.shown:
        raise InvalidInputError("other session", "at least one demonstration", "none")
    taken = other.history.shown
    if other.created.language != session.created.language:  # its prompts mean something else here
        taken = tuple(replace(shown, prompt=None) for shown in taken)
    return await _edited(studio, session, body.revision, Demonstrated(taken))


@routes.post("/{session_id}/people")
async def people(studio: TheStudio, session_id: SessionId, body: PeopleRequest) -> Json:
    """Let built-in people draw signs, or the movement in the scene that comes next; nothing is stored."""
    session = await studio.open(session_id)
    created, request, language = session.created, body.request(), get_language(session.created.language)
    if language is None:
        raise InvalidInputError("people", "a session in a language that they know", "one in made-up signs")
    if request not in language.requests:
        raise InvalidInputError("people", "a movement and an object of the language", f"{tuple(request)}")
    if body.part == "signs":
        signs = await asyncio.to_thread(draw_utterance, created.language, created.seed, request, body.attempt)
        return {"signs": [stroke_to_json(sign) for sign in signs]}
    scene = session.learned.objects, session.learned.hand
    hand = await asyncio.to_thread(draw_answer, created.language, created.seed, request, body.attempt, scene)
    return {"hand": stroke_to_json(hand)}


async def _edited(studio: Studio, session: OpenSession, revision: int, event: Event) -> Json:
    await session.edit(revision, event)
    studio.changed(session)
    return session_json(session, studio.arm.state)


async def _still(studio: Studio, objects: Any) -> Response:
    picture = await asyncio.wrap_future(studio.camera.still(objects))
    return Response(picture, media_type="image/jpeg")
