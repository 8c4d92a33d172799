"""JSON of a session for the page: demonstrations, answers, draft, prompt and belief."""

from __future__ import annotations

from typing import Any

import numpy as np

from signimit.names import object_name
from signimit.teaching.languages import Language, Request
from signimit_envs.studio.arm.live_state import LiveState
from signimit_envs.studio.open_session import OpenSession
from signimit_envs.studio.page.belief import movement_names, sign_json, understood_text
from signimit_envs.studio.page.built_in_people import examples
from signimit_envs.studio.page.prompts import get_language, next_request, prompt_text, sign_labels
from signimit_envs.studio.store.event_json import stroke_to_json
from signimit_envs.studio.store.events import DrawnDemonstration
from signimit_envs.studio.store.history import Answer


def session_json(session: OpenSession, state: LiveState) -> dict[str, Any]:
    """Return all of a session but the strokes of its demonstrations and answers."""
    history, learned = session.history, session.learned
    created, language = history.created, get_language(history.created.language)
    drawn = {place: [stroke_to_json(stroke) for stroke in strokes] for place, strokes in history.draft.drawn.items()}
    prompt, left = None, 0
    if language is not None:
        request, left = next_request(language, created.seed, [shown.prompt for shown in history.shown])
        prompt = prompt_json(session, request)
    return {
        "id": session.name,
        "title": history.title,
        "created": created.created,
        "revision": history.revision,
        "events": history.events,
        "language": None if language is None else language_json(created.language, language),
        "objects": created.objects,
        "demonstrations": [_listed_json(session, number, shown) for number, shown in enumerate(history.shown)],
        "answers": [answer_json(session, number, answer, state) for number, answer in enumerate(history.answers)],
        "draft": {"number": history.draft.number, "drawn": drawn},
        "can_undo": bool(history.past),
        "can_redo": bool(history.future),
        "next": {
            "scene": {"objects": learned.objects.tolist(), "hand": learned.hand.tolist()},
            "prompt": prompt,
            "left": left,
        },
        "belief": _belief_json(session),
    }


def _belief_json(session: OpenSession) -> dict[str, Any] | None:
    """Return what was learned, with what people call the movements."""
    learned = session.learned
    if learned.belief is None or learned.model is None:
        return learned.belief
    return {**learned.belief, "names": movement_names(learned.model, session.history)}


def answer_json(session: OpenSession, number: int, answer: Answer, state: LiveState) -> dict[str, Any]:
    """Return what the arm was asked, and how it was understood."""
    asked, task = answer.asked, state.task
    return {
        "number": number,
        "movement": asked.movement,
        "focus": asked.focus,
        "confidence": round(asked.confidence, 4),
        "text": understood_text(asked.movement, asked.focus, asked.confidence, asked.name),
        "held": answer.held,
        "verdict": answer.good,
        "request": _request_json(asked.request),
        "running": task is not None and (task.session, task.answer) == (session.name, number),
    }


def demonstration_json(session: OpenSession, number: int) -> dict[str, Any]:
    """Return a demonstration, strokes and all, for replay."""
    shown = session.demonstration(number)
    return {
        **_listed_json(session, number, shown),
        "signs": [stroke_to_json(sign) for sign in shown.signs],
        "objects": shown.objects.tolist(),
        "hand": stroke_to_json(shown.hand),
    }


def prompt_json(session: OpenSession, request: Request) -> dict[str, Any]:
    """Return what a person is asked to draw, and how it looks."""
    name, language = session.created.language, get_language(session.created.language)
    if language is None:
        raise RuntimeError("free sessions have no prompts")
    signs, drawing = examples(name, session.created.seed, request)
    return {
        "movement": request.movement,
        "focus": request.focus,
        "text": prompt_text(language, request),
        "signs": list(sign_labels(language, request)),
        "movement_name": language.movements[request.movement],
        "examples": [sign_json(sign) for sign in signs],
        "drawing": sign_json(drawing),
    }


def _listed_json(session: OpenSession, number: int, shown: DrawnDemonstration) -> dict[str, Any]:
    model = session.learned.model
    belief = session.learned.belief or {}
    doubtful = {doubt["number"] for doubt in belief.get("doubtful", ())}
    return {
        "number": number,
        "prompt": _request_json(shown.prompt),
        "focus": None if model is None or model.focus[number] < 0 else int(model.focus[number]),
        "movement": None if model is None or model.labels[number] < 0 else int(model.labels[number]),
        "sure": model is not None and number not in doubtful,
        "by": shown.by,
    }


def _request_json(request: Request | None) -> dict[str, int] | None:
    return None if request is None else {"movement": request.movement, "focus": request.focus}


def language_json(name: str, language: Language) -> dict[str, Any]:
    """Return the words and movements of a language, and which requests are never prompted for."""
    return {
        "name": name,
        "objects": [object_name(i) for i in range(language.objects)],
        "movements": list(language.movements),
        "focus_signs": list(language.focus_signs),
        "movement_signs": list(language.movement_signs),
        "focus_word": language.focus_word,
        "movement_word": language.movement_word,
        "unseen": [_request_json(request) for request in sorted(language.held_back)],
    }


def track_json(parts: list[dict[str, Any]]) -> dict[str, Any]:
    """Return what the arm did in an answer, from the parts of its track."""
    path = [place for part in parts for place in part["path"]]
    objects: list[Any] = []
    for part in parts:
        for step, places in enumerate(part["objects"], part["first"]):
            if not objects or objects[-1][1] != places:
                objects.append([round(step / part["rate"], 2), places])
    times = np.arange(len(path)) / (parts[0]["rate"] if parts else 1)
    return {"path": path, "times": np.round(times, 2).tolist(), "objects": objects}
