"""Looking: figures, similarities and films."""

from __future__ import annotations

import asyncio
from typing import Annotated, Literal

from fastapi import APIRouter, Path, Response

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.page.pictures import FIGURES, draw_figure, film_answer, film_demonstration, similarities_json
from signimit_envs.studio.studio import NotHereError
from signimit_envs.studio.web.routes.dependencies import Json, Number, SessionId, TheStudio

MEDIA = {"png": "image/png", "svg": "image/svg+xml"}
FigureNumber = Annotated[int, Path(ge=FIGURES[0], le=FIGURES[-1])]
routes = APIRouter(prefix="/api/sessions/{session_id}", tags=["look"])


@routes.get("/figures/{number}.{suffix}")
async def figure(
    studio: TheStudio, session_id: SessionId, number: FigureNumber, suffix: Literal["png", "svg"]
) -> Response:
    """Draw one of the paper's figures 4 to 7."""
    session = await studio.open(session_id)
    model, answers = session.model, session.history.answers
    shown = session.name, session.history.revision, number, suffix
    if known := studio.album.find(shown):
        return Response(known, media_type=MEDIA[suffix])

    def draw() -> bytes:
        tracks = [studio.shelf.read_track(session.name, n) if number == 7 else [] for n in range(len(answers))]
        return draw_figure(number, suffix, model, list(zip(answers, tracks, strict=True)))

    lasting = number != 7  # the arm goes on while nobody edits
    drawn = await studio.develop((lambda: studio.album.fill(shown, draw)) if lasting else draw)
    return Response(drawn, media_type=MEDIA[suffix])


@routes.get("/similarities")
async def similarities(studio: TheStudio, session_id: SessionId) -> Json:
    """Return how similar demonstrations are, in all frames and at most."""
    model = (await studio.open(session_id)).model
    return await studio.develop(lambda: similarities_json(model))


@routes.get("/demonstrations/{number}/film.mp4")
async def demonstration_film(studio: TheStudio, session_id: SessionId, number: Number) -> Response:
    """Film a demonstration."""
    shown = (await studio.open(session_id)).history.shown
    if number >= len(shown):
        raise NotHereError("There is no such demonstration.")
    film = await studio.develop(lambda: film_demonstration(shown[number], number))
    return _download(film, f"demonstration-{number}.mp4")


@routes.get("/answers/{number}/film.mp4")
async def answer_film(studio: TheStudio, session_id: SessionId, number: Number) -> Response:
    """Film the first seconds of an answer."""
    session = await studio.open(session_id)
    if number >= len(session.history.answers):
        raise NotHereError("There is no such answer.")
    given = session.history.answers[number]
    track = await asyncio.to_thread(studio.shelf.read_track, session.name, number)
    if not track:
        raise InvalidInputError("answer", "a second of movement or more", "less")
    film = await studio.develop(lambda: film_answer(given, track))
    return _download(film, f"answer-{number}.mp4")


def _download(film: bytes, name: str) -> Response:
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(film, media_type="video/mp4", headers=headers)
