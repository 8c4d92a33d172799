"""Routes of Look: figures, similarities and films."""

from __future__ import annotations

import asyncio
from typing import Annotated, Literal

from fastapi import APIRouter, Path, Response

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.page.pictures import FIGURES, draw_figure, film_answer, film_demonstration, similarities_json
from signimit_envs.studio.web.routes.dependencies import Json, Number, SessionId, TheStudio

MEDIA = {"png": "image/png", "svg": "image/svg+xml"}
FigureNumber = Annotated[int, Path(ge=FIGURES[0], le=FIGURES[-1])]
routes = APIRouter(prefix="/api/sessions/{session_id}", tags=["look"])


@routes.get("/figures/{number}.{suffix}")
async def figure(
    studio: TheStudio,
    session_id: SessionId,
    number: FigureNumber,
    suffix: Literal["png", "svg"],
    look: Literal["light", "dark"] = "light",
) -> Response:
    """Draw one of the paper's figures 4 to 7."""
    session = await studio.open(session_id)
    model, answers = session.model, session.history.answers
    key = session.name, session.history.revision, number, suffix, look
    if known := studio.figures.find(key):
        return Response(known, media_type=MEDIA[suffix])

    def draw() -> bytes:
        tracks = [studio.store.read_track(session.name, n) if number == 7 else [] for n in range(len(answers))]
        return draw_figure(number, suffix, model, list(zip(answers, tracks, strict=True)), look)

    lasting = number != 7  # the arm goes on drawing at the same revision
    drawn = await studio.render((lambda: studio.figures.find_or_draw(key, draw)) if lasting else draw)
    return Response(drawn, media_type=MEDIA[suffix])


@routes.get("/similarities")
async def similarities(studio: TheStudio, session_id: SessionId) -> Json:
    """Return how similar demonstrations are, in all frames and at most."""
    model = (await studio.open(session_id)).model
    return await studio.render(lambda: similarities_json(model))


@routes.get("/demonstrations/{number}/film.mp4")
async def demonstration_film(studio: TheStudio, session_id: SessionId, number: Number) -> Response:
    """Film a demonstration."""
    shown = (await studio.open(session_id)).demonstration(number)
    film = await studio.render(lambda: film_demonstration(shown, number))
    return _download(film, f"demonstration-{number + 1}.mp4")


@routes.get("/answers/{number}/film.mp4")
async def answer_film(studio: TheStudio, session_id: SessionId, number: Number) -> Response:
    """Film the first seconds of an answer."""
    session = await studio.open(session_id)
    answer = session.answer(number)
    track = await asyncio.to_thread(studio.store.read_track, session.name, number)
    if not track:
        raise InvalidInputError("answer", "a second of movement or more", "less")
    film = await studio.render(lambda: film_answer(answer, track))
    return _download(film, f"answer-{number + 1}.mp4")


def _download(film: bytes, name: str) -> Response:
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(film, media_type="video/mp4", headers=headers)
