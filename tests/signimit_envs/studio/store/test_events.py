"""Events survive the way to the disk and back, and nothing else passes for one."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit import InvalidInputError
from signimit.strokes import Stroke
from signimit.teaching.languages import Request
from signimit_envs.studio.store.event_json import event_from_json, event_to_json
from signimit_envs.studio.store.events import (
    Asked,
    Created,
    Deleted,
    Demonstrated,
    Drafted,
    DrawnDemonstration,
    Event,
    Judged,
    Redone,
    Redrawn,
    Titled,
    Undone,
)

WORDS = st.sampled_from(["", "asked", "demonstrated", "deleted", "points", "times", "hand", "objects", "\0"])
ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | WORDS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=3),
    max_leaves=8,
)


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, Stroke):
        return np.array_equal(a.points, b.points) and np.array_equal(a.times, b.times)
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(_same(a[name], b[name]) for name in a)
    if isinstance(a, tuple):
        return len(a) == len(b) and all(map(_same, a, b))
    if dataclasses.is_dataclass(a):
        return type(a) is type(b) and all(_same(getattr(a, f.name), getattr(b, f.name)) for f in dataclasses.fields(a))
    return bool(a == b)


def test_every_event_comes_back_from_json_to_the_last_bit(shown: Callable[[], DrawnDemonstration]) -> None:
    one = dataclasses.replace(shown(), prompt=Request(2, 1), by="built-in people")
    events: list[Event] = [
        Created("a title", "2020-01-01T00:00:00", "paper", 3, 7),
        Demonstrated((one, shown())),
        Redrawn(1, shown()),
        Deleted(0),
        Drafted(None, {"sign 1": one.signs, "hand": ()}),
        Drafted(1, {"question": one.signs[:1]}),
        Undone(),
        Redone(),
        Titled("another"),
        Asked(one.signs, 2, 1, 0.123456789012345678, Request(0, 1)),
        Asked(one.signs, 2, 1, 1.0),
        Judged(0, None),
        Judged(0, True),
    ]
    for event in events:
        assert _same(event_from_json(json.loads(json.dumps(event_to_json(event)))), event), event


@pytest.mark.parametrize("lacking", ["event", "number", "shown"])
def test_an_event_that_lacks_something_is_refused(lacking: str, shown: Callable[[], DrawnDemonstration]) -> None:
    value = event_to_json(Redrawn(0, shown()))
    del value[lacking]
    with pytest.raises(InvalidInputError, match="event: expected one of created, demonstrated"):
        event_from_json(value)


@pytest.mark.parametrize(
    ("name", "value"), [("objects", 7), ("objects", "3"), ("seed", -1), ("title", None), ("seed", 0.5)]
)
def test_a_beginning_that_is_none_is_refused(name: str, value: Any) -> None:
    beginning = event_to_json(Created("a title", "2020-01-01T00:00:00", "paper", 3, 7))
    with pytest.raises(InvalidInputError, match="session: expected a title, a time"):
        event_from_json({**beginning, name: value})


def test_a_stroke_that_is_not_finite_is_refused(shown: Callable[[], DrawnDemonstration]) -> None:
    value = event_to_json(Demonstrated((shown(),)))
    value["shown"][0]["hand"]["points"][3][0] = float("nan")
    with pytest.raises(InvalidInputError, match="stroke points: expected finite numbers"):
        event_from_json(value)


@settings(deadline=None, max_examples=30)
@given(st.dictionaries(st.sampled_from(["event", "number", "shown", "signs", "good", "title"]), ANYTHING))
def test_whatever_a_file_says_it_is_an_event_or_refused_in_a_sentence(value: dict[str, Any]) -> None:
    try:
        event = event_from_json(value)
    except InvalidInputError:
        return
    assert type(event).__name__.lower() == value["event"]


@pytest.mark.parametrize(
    ("event", "sentence"),
    [
        ({"event": "titled", "title": ["a"]}, "title: expected text, found list"),
        ({"event": "titled", "title": "half \ud800"}, "title: expected text in Unicode"),
        ({"event": "judged", "number": 0, "good": "yes"}, "judged: good: expected true, false or null"),
        ({"event": "asked", "signs": [], "movement": "0", "focus": 0, "confidence": 0.5, "request": None}, "movement"),
        ({"event": "asked", "signs": [], "movement": 0, "focus": -1, "confidence": 0.5, "request": None}, "focus"),
        ({"event": "asked", "signs": [], "movement": 0, "focus": 0, "confidence": 1.5, "request": None}, "probability"),
        ({"event": "asked", "signs": [], "movement": 0, "focus": 0, "confidence": "1", "request": None}, "confidence"),
        ({"event": "asked", "signs": [], "movement": 0, "focus": 0, "confidence": 1, "request": "01"}, "request"),
    ],
)
def test_what_the_page_could_not_show_is_no_event(event: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInputError, match=sentence):
        event_from_json(event)


def test_a_demonstration_that_cannot_be_learned_from_is_no_event(shown: Callable[[], DrawnDemonstration]) -> None:
    event = event_to_json(Demonstrated((shown(),)))
    event["shown"][0]["hand"]["points"][0] = [1e9, 0.0]
    with pytest.raises(InvalidInputError, match="hand: expected numbers within 500"):
        event_from_json(event)


@pytest.mark.parametrize("kind", ["demonstrated", "redrawn"])
def test_one_demonstration_is_no_list_of_them_and_a_list_is_not_one(
    kind: str, shown: Callable[[], DrawnDemonstration]
) -> None:
    one, several = event_to_json(Redrawn(0, shown())), event_to_json(Demonstrated((shown(),)))
    mixed = {**one, "event": kind, "shown": (one if kind == "demonstrated" else several)["shown"]}
    with pytest.raises(InvalidInputError, match="event: expected one of created, demonstrated"):
        event_from_json(mixed)


def test_a_question_of_a_journal_from_before_arms_asked_back_is_read() -> None:
    sign = Stroke(np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([0.0, 1.0]))
    line = event_to_json(Asked((sign, sign), 0, 1, 0.25))
    older = {name: value for name, value in line.items() if name not in ("held", "name")}
    read = event_from_json(older)
    assert isinstance(read, Asked)
    assert (read.held, read.name) == (False, "")
