"""State of a session: a pure fold over its events, with undo and redo."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.teaching.languages import Request
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page.prompts import get_language
from signimit_envs.studio.store.events import (
    PLACES,
    QUESTION,
    Asked,
    Created,
    Deleted,
    Demonstrated,
    Drafted,
    DrawnDemonstration,
    Event,
    Insisted,
    Judged,
    Named,
    Redone,
    Redrawn,
    Signs,
    Titled,
    Undone,
)

Demonstrations = tuple[DrawnDemonstration, ...]


@dataclass(frozen=True, eq=False)
class Answer:
    """An answer of the arm and the verdict on it.

    Attributes:
        asked: What was asked, and how it was understood.
        good: Whether a person judged it right; none without a verdict.
        insisted: Whether a person let the arm do what it had asked back about.
    """

    asked: Asked
    good: bool | None = None
    insisted: bool = False

    @property
    def held(self) -> bool:
        """Whether the arm asked back instead of moving, and still waits."""
        return self.asked.held and not self.insisted


@dataclass(frozen=True, eq=False)
class Draft:
    """A demonstration that is half drawn, and the first sign of a question.

    Attributes:
        number: Of the demonstration that is drawn again; none for a new one.
        drawn: Strokes at each place where something was drawn or cleared.
    """

    number: int | None = None
    drawn: Mapping[str, Signs] = field(default_factory=dict)

    def question_only(self) -> Draft:
        """Return what is left of it once the demonstration is taught, or its table is another."""
        return Draft(None, {place: strokes for place, strokes in self.drawn.items() if place == QUESTION})


@dataclass(frozen=True, eq=False)
class History:
    """A session at one moment.

    Attributes:
        created: How it began.
        title: What it is called now.
        shown: The demonstrations that count now.
        answers: What the arm was asked.
        draft: What is drawn and not sent yet; any edit of the demonstrations ends it, as the next table is another.
        names: What the movement was called that a demonstration shows, the latest last.
        revision: How many edits there were; drafts, asking and judging are none.
        events: How many events there were.
        past: What undo brings back, the latest last.
        future: What redo brings back, the next last.
    """

    created: Created
    title: str
    shown: Demonstrations = ()
    answers: tuple[Answer, ...] = ()
    draft: Draft = field(default_factory=Draft)
    names: Mapping[DrawnDemonstration, str] = field(default_factory=dict)
    revision: int = 0
    events: int = 1
    past: tuple[Demonstrations, ...] = ()
    future: tuple[Demonstrations, ...] = ()


def replay_events(events: Iterable[Event]) -> History:
    """Fold the events of a session into its state.

    Raises:
        UnknownNameError: If its language is none of the studio's.
        InvalidInputError: If the first does not create it, or one of them cannot have happened.
    """
    remaining = iter(events)
    first = next(remaining, None)
    if not isinstance(first, Created):
        raise InvalidInputError("session", "a beginning", type(first).__name__)
    language = get_language(first.language)
    if language is not None and first.objects != language.objects:
        raise InvalidInputError("session", f"{language.objects} objects, as its language has", f"{first.objects}")
    return functools.reduce(apply_event, remaining, History(first, first.title))


def apply_event(history: History, event: Event) -> History:
    """Return the state of a session after one more event.

    Raises:
        InvalidInputError: If that cannot happen now.
    """
    following = replace(_apply(history, event), events=history.events + 1)
    if following.shown is history.shown:
        return following
    return replace(following, draft=history.draft.question_only())


def _apply(history: History, event: Event) -> History:
    """Apply an event to everything but the number of events and the draft that an edit ends."""
    draft, revision = history.draft, history.revision + 1
    match event:
        case Created():
            raise InvalidInputError("session", "one beginning", "another")
        case Demonstrated() | Redrawn() | Deleted():
            past = (*history.past, history.shown)
            return replace(history, shown=_edited(history, event), past=past, future=(), revision=revision)
        case Undone():
            if not history.past:
                raise InvalidInputError("undo", "something to take back", "nothing")
            past, shown, future = history.past[:-1], history.past[-1], (*history.future, history.shown)
            return replace(history, shown=shown, past=past, future=future, revision=revision)
        case Redone():
            if not history.future:
                raise InvalidInputError("redo", "something that was undone", "nothing")
            past, shown, future = (*history.past, history.shown), history.future[-1], history.future[:-1]
            return replace(history, shown=shown, past=past, future=future, revision=revision)
        case Titled(title):
            return replace(history, title=title, revision=revision)
        case Named(number, name):
            _check_number(number, len(history.shown), "demonstration")
            named = history.shown[number]
            others = {one: given for one, given in history.names.items() if one is not named}
            return replace(history, names={**others, named: name}, revision=revision)
        case Drafted():
            return replace(history, draft=_drafted(history, event))
        case Asked():
            _check_number(event.movement, LIMITS.demonstrations, "asked: movement")
            _check_number(event.focus, history.created.objects, "asked: focus")
            _check_request(history, event.request, "asked: request")
            drawn = {place: strokes for place, strokes in draft.drawn.items() if place != QUESTION}
            return replace(history, answers=(*history.answers, Answer(event)), draft=replace(draft, drawn=drawn))
        case Insisted(number):
            return replace(history, answers=_changed_answer(history, number, insisted=True))
        case Judged(number, good):
            return replace(history, answers=_changed_answer(history, number, good=good))


def _changed_answer(history: History, number: int, **changed: Any) -> tuple[Answer, ...]:
    """Return the answers with one of them changed.

    Raises:
        InvalidInputError: If there is none of that number.
    """
    _check_number(number, len(history.answers), "answer")
    before, answer, after = history.answers[:number], history.answers[number], history.answers[number + 1 :]
    return (*before, replace(answer, **changed), *after)


def _edited(history: History, event: Demonstrated | Redrawn | Deleted) -> Demonstrations:
    """Return the demonstrations after an edit.

    Raises:
        InvalidInputError: If there is no such demonstration, or one does not fit the others.
    """
    shown = history.shown
    if isinstance(event, Demonstrated):
        edited = (*shown, *event.shown)
    else:
        _check_number(event.number, len(shown), "demonstration")
        instead = (event.shown,) if isinstance(event, Redrawn) else ()
        edited = (*shown[: event.number], *instead, *shown[event.number + 1 :])
    words, objects = len(edited[0].signs) if edited else 0, history.created.objects
    for number, one in enumerate(edited, 1):
        if len(one.signs) != words:
            raise InvalidInputError(f"demonstration {number}: signs", f"{words}", f"{len(one.signs)}")
        if len(one.objects) != objects:
            raise InvalidInputError(f"demonstration {number}: objects", f"{objects}", f"{len(one.objects)}")
        if objects > 1 and not np.ptp(one.objects, axis=0).any():
            raise InvalidInputError(f"demonstration {number}: objects", "places apart", f"{objects} in one place")
        _check_request(history, one.prompt, f"demonstration {number}: prompt")
    return edited


def _drafted(history: History, event: Drafted) -> Draft:
    """Return the draft after another stroke: the last at a place counts."""
    if not set(event.drawn) <= set(PLACES):
        raise InvalidInputError("draft", f"some of {', '.join(PLACES)}", f"{list(event.drawn)!r:.80}")
    if event.number is not None:
        _check_number(event.number, len(history.shown), "demonstration")
    draft = history.draft if event.number == history.draft.number else history.draft.question_only()
    return Draft(event.number, {**draft.drawn, **event.drawn})


def _check_request(history: History, request: Request | None, where: str) -> None:
    """Refuse a request for an object or a movement that the session does not have."""
    if request is None:
        return
    _check_number(request.focus, history.created.objects, f"{where}: focus")
    language = get_language(history.created.language)
    if language is not None:
        _check_number(request.movement, len(language.movements), f"{where}: movement")


def _check_number(number: int, count: int, what: str) -> None:
    if type(number) is not int or number not in range(count):
        raise InvalidInputError(what, f"a number below {count}", f"{number!r:.40}")
