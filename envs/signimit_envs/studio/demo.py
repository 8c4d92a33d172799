"""The demo: built-in people teach a session, ask for what was never demonstrated, and judge the answers."""

from __future__ import annotations

import asyncio

import numpy as np

from signimit.evaluation import performed
from signimit.names import object_name
from signimit.teaching.languages import PAPER_LANGUAGE, Request
from signimit_envs.studio.open_session import OpenSession
from signimit_envs.studio.page.built_in_people import draw_answer, draw_utterance, templates
from signimit_envs.studio.page.prompts import next_request, prompt_text
from signimit_envs.studio.store.events import Demonstrated, DrawnDemonstration, Judged
from signimit_envs.studio.studio import Studio

LANGUAGE = "paper"
_ARRIVAL = 10  # s, in which a page may open before it begins
_FIRST_PAUSE, _PAUSE = 12.0, 3.0  # s, for the first demonstration to be watched in full, and for each other
_ANSWER_PAUSE = 12.0  # s, in which the arm answers
_INTERFERE_AFTER = 4.0  # s, of an answer
_JUDGED_STEPS = 300  # the last so many control steps of an answer
_SHOVE, _SHIFT = (0.7, 0.4), (-0.10, 0.06)  # m/s; m


async def play_session(studio: Studio, seed: int, pace: float = 1.0) -> None:
    """Play a session on the page: twelve demonstrations, then the three requests that were never demonstrated.

    Args:
        studio: The studio that plays.
        seed: Decides the built-in people and what they draw.
        pace: Factor of all pauses, 1 for a talk.
    """
    for _ in range(_ARRIVAL):  # the first page should see the first demonstration
        if len(studio.viewers):
            break
        await asyncio.sleep(pace)
    session = await studio.create("A session that plays itself", LANGUAGE, PAPER_LANGUAGE.objects, seed)
    studio.demo = session.name
    while True:
        request, left = next_request(PAPER_LANGUAGE, seed, [shown.prompt for shown in session.history.shown])
        if not left:
            break
        await _demonstrate(studio, session, request)
        await asyncio.sleep(pace * (_FIRST_PAUSE if len(session.history.shown) == 1 else _PAUSE))
    for attempt, request in enumerate(sorted(PAPER_LANGUAGE.held_back)):
        await _ask(studio, session, request, attempt, pace)
    _tell(studio, session, "look", "What the robot has seen, believed and done")
    studio.viewers.forget()


async def _demonstrate(studio: Studio, session: OpenSession, request: Request) -> None:
    number, seed = len(session.history.shown), session.created.seed
    objects, hand = session.learned.objects, session.learned.hand
    signs = await asyncio.to_thread(draw_utterance, LANGUAGE, seed, request, number)
    answer = await asyncio.to_thread(draw_answer, LANGUAGE, seed, request, number, (objects, hand))
    shown = DrawnDemonstration(signs, objects, answer, request, "built-in people")
    await session.edit(session.history.revision, Demonstrated((shown,)))
    caption = f"{prompt_text(PAPER_LANGUAGE, request)} The robot is told nothing of this."
    _tell(studio, session, "teach", caption, number)  # the news of the change too: a page shows both at once


async def _ask(studio: Studio, session: OpenSession, request: Request, attempt: int, pace: float) -> None:
    wanted = f"{PAPER_LANGUAGE.movements[request.movement]} about the {object_name(request.focus)} object"
    _tell(studio, session, "ask", f"Never demonstrated: {wanted}")
    studio.set_table(session)
    signs = draw_utterance(LANGUAGE, session.created.seed, request, 1000 + attempt)
    number = await studio.ask(session, signs, request)
    studio.changed(session)
    await asyncio.sleep(pace * _INTERFERE_AFTER)
    if attempt == 1:  # interfere in the second answer and in the third
        studio.arm.shove(np.array(_SHOVE))
    elif attempt == 2:
        studio.arm.drag(request.focus, studio.arm.state.objects[request.focus] + _SHIFT)
    await asyncio.sleep(pace * (_ANSWER_PAUSE - _INTERFERE_AFTER))
    good = await asyncio.to_thread(_is_obeyed, studio, session, number)
    await session.note(Judged(number, good))
    studio.changed(session)


def _is_obeyed(studio: Studio, session: OpenSession, number: int) -> bool:
    """Judge the last seconds of an answer."""
    parts = studio.store.read_track(session.name, number)
    path = [place for part in parts for place in part["path"]][-_JUDGED_STEPS:]
    if len(path) < 2:
        return False
    done = performed(path, parts[-1]["objects"][-1], templates(LANGUAGE, session.created.seed))
    return (done.movement, done.focus) == session.history.answers[number].asked.request


def _tell(studio: Studio, session: OpenSession, view: str, caption: str, demonstration: int | None = None) -> None:
    news = {"type": "demo", "session": session.name, "view": view, "caption": caption, "demonstration": demonstration}
    studio.viewers.tell(news, standing=True)
