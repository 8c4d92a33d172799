"""What a session is after its events: a pure fold, with undo and redo."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.store.events import (
    PLACES,
    QUESTION,
    Asked,
    Created,
    Deleted,
    Demonstrated,
    Drafted,
    Event,
    Judged,
    Redone,
    Redrawn,
    Shown,
    Signs,
    Titled,
    Undone,
)

Demonstrations = tuple[Shown, ...]


@dataclass(frozen=True, eq=False)
class Given:
    """An answer, and what people thought of it."""

    asked: Asked
    good: bool | None = None


@dataclass(frozen=True, eq=False)
class Draft:
    """What is drawn and not sent yet.

    Attributes:
        number: Of the demonstration that is drawn again; none for a new one.
        drawn: Strokes at each place where somebody drew or cleared something.
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
        revision: How many edits there were; drafts, asking and judging are none.
        events: How many events there were.
        past: What undo brings back, the latest last.
        future: What redo brings back, the next last.
    """

    created: Created
    title: str
    shown: Demonstrations = ()
    answers: tuple[Given, ...] = ()
    draft: Draft = field(default_factory=Draft)
    revision: int = 0
    events: int = 1
    past: tuple[Demonstrations, ...] = ()
    future: tuple[Demonstrations, ...] = ()


def retell(events: Iterable[Event]) -> History:
    """Return the session that a list of events makes.

    Raises:
        InvalidInputError: If the first does not create it, or one of them cannot have happened.
    """
    remaining = iter(events)
    first = next(remaining, None)
    if not isinstance(first, Created):
        raise InvalidInputError("session", "a beginning", type(first).__name__)
    return functools.reduce(after, remaining, History(first, first.title))


def after(history: History, event: Event) -> History:
    """Return the session after one more event.

    Raises:
        InvalidInputError: If that cannot happen now.
    """
    following = replace(_after(history, event), events=history.events + 1)
    if following.shown is history.shown:
        return following
    return replace(following, draft=history.draft.question_only())


def _after(history: History, event: Event) -> History:
    match event:
        case Asked():
            drawn = {place: strokes for place, strokes in history.draft.drawn.items() if place != QUESTION}
            draft = replace(history.draft, drawn=drawn)
            return replace(history, answers=(*history.answers, Given(event)), draft=draft)
        case Drafted():
            return replace(history, draft=_drafted(history, event))
        case Judged(number, good):
            _check_number(number, len(history.answers), "answer")
            answers = list(history.answers)
            answers[number] = replace(answers[number], good=good)
            return replace(history, answers=tuple(answers))
        case Titled(title):
            return replace(history, title=title, revision=history.revision + 1)
        case Undone():
            return _undone(history)
        case Redone():
            return _redone(history)
        case Created():
            raise InvalidInputError("session", "one beginning", "another")
        case _:
            return _edited(history, event)


def _drafted(history: History, event: Drafted) -> Draft:
    """Return the draft after another stroke: the last at a place counts."""
    if not set(event.drawn) <= set(PLACES):
        raise InvalidInputError("draft", f"some of {', '.join(PLACES)}", f"{list(event.drawn)!r:.80}")
    if event.number is not None:
        _check_number(event.number, len(history.shown), "demonstration")
    draft = history.draft if event.number == history.draft.number else history.draft.question_only()
    return Draft(event.number, {**draft.drawn, **event.drawn})


def _edited(history: History, event: Demonstrated | Redrawn | Deleted) -> History:
    shown = history.shown
    if isinstance(event, Demonstrated):
        edited = (*shown, *event.shown)
    else:
        _check_number(event.number, len(shown), "demonstration")
        instead = (event.shown,) if isinstance(event, Redrawn) else ()
        edited = (*shown[: event.number], *instead, *shown[event.number + 1 :])
    _check_alike(edited, history.created.objects)
    past = (*history.past, shown)
    return replace(history, shown=edited, past=past, future=(), revision=history.revision + 1)


def _undone(history: History) -> History:
    if not history.past:
        raise InvalidInputError("undo", "something to take back", "nothing")
    return replace(
        history,
        shown=history.past[-1],
        past=history.past[:-1],
        future=(*history.future, history.shown),
        revision=history.revision + 1,
    )


def _redone(history: History) -> History:
    if not history.future:
        raise InvalidInputError("redo", "something that was undone", "nothing")
    return replace(
        history,
        shown=history.future[-1],
        past=(*history.past, history.shown),
        future=history.future[:-1],
        revision=history.revision + 1,
    )


def _check_number(number: int, count: int, what: str) -> None:
    if number not in range(count):
        raise InvalidInputError(what, f"a number below {count}", f"{number!r:.40}")


def _check_alike(shown: Demonstrations, objects: int) -> None:
    for number, one in enumerate(shown):
        if len(one.signs) != len(shown[0].signs):
            raise InvalidInputError(f"demonstration {number}: signs", f"{len(shown[0].signs)}", f"{len(one.signs)}")
        if len(one.objects) != objects:
            raise InvalidInputError(f"demonstration {number}: objects", f"{objects}", f"{len(one.objects)}")
