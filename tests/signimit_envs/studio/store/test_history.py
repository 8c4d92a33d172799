"""A session is the fold of its events; undo and redo are exact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit import InvalidInputError, UnknownNameError
from signimit.strokes import Stroke
from signimit.teaching.languages import Request
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
from signimit_envs.studio.store.history import apply_event, replay_events

BEGINNING = Created("title", "2020-01-01T00:00:00", "paper", 3, 0)
Make = Callable[[], DrawnDemonstration]


def test_demonstrations_are_added_redrawn_and_deleted_in_their_places(shown: Make) -> None:
    a, b, c, d = (shown() for _ in range(4))
    history = replay_events([BEGINNING, Demonstrated((a,)), Demonstrated((b, c)), Redrawn(1, d), Deleted(0)])
    assert history.shown == (d, c)
    assert history.revision == 4


def test_undo_takes_back_edits_one_by_one_and_redo_brings_them_again(shown: Make) -> None:
    a, b = shown(), shown()
    history = replay_events([BEGINNING, Demonstrated((a,)), Demonstrated((b,)), Deleted(0), Undone(), Undone()])
    assert history.shown == (a,)
    history = apply_event(apply_event(history, Redone()), Redone())
    assert history.shown == (b,)
    assert not history.future


def test_an_edit_after_an_undo_leaves_nothing_to_redo(shown: Make) -> None:
    history = replay_events([BEGINNING, Demonstrated((shown(),)), Undone(), Demonstrated((shown(),))])
    with pytest.raises(InvalidInputError, match="redo: expected something that was undone"):
        apply_event(history, Redone())


def test_the_last_stroke_at_a_place_of_a_draft_counts(shown: Make) -> None:
    (a, b), (c, _) = shown().signs, shown().signs
    history = replay_events([BEGINNING, Drafted(None, {"sign 1": (a,), "hand": (b,)}), Drafted(None, {"sign 1": (c,)})])
    assert history.draft.drawn == {"sign 1": (c,), "hand": (b,)}
    assert (history.revision, history.events) == (0, 3)
    assert apply_event(history, Titled("another")).draft is history.draft


def test_a_draft_of_another_demonstration_begins_with_nothing(shown: Make) -> None:
    a, b = shown().signs
    history = replay_events(
        [BEGINNING, Demonstrated((shown(),)), Drafted(None, {"sign 1": (a,)}), Drafted(0, {"hand": (b,)})]
    )
    assert (history.draft.number, history.draft.drawn) == (0, {"hand": (b,)})


def test_an_edit_of_the_demonstrations_ends_the_draft_and_asking_ends_the_question(shown: Make) -> None:
    a, b = shown().signs
    draft = Drafted(None, {"sign 1": (a,), "question": (b,)})
    edits: list[Event] = [Demonstrated((shown(),)), Redrawn(0, shown()), Deleted(1), Undone()]
    for edit in edits:
        history = replay_events([BEGINNING, Demonstrated((shown(), shown())), draft, edit])
        assert history.draft.drawn == {"question": (b,)}
    history = replay_events([BEGINNING, Demonstrated((shown(),)), draft, Asked((b, b), 0, 0, 1.0)])
    assert history.draft.drawn == {"sign 1": (a,)}


@pytest.mark.parametrize("event", [Drafted(1, {"hand": ()}), Drafted(None, {"foot": ()})])
def test_a_draft_of_what_is_not_there_is_refused(event: Event, shown: Make) -> None:
    with pytest.raises(InvalidInputError, match=r"demonstration: expected a number below 1|draft: expected some of"):
        replay_events([BEGINNING, Demonstrated((shown(),)), event])


def test_nothing_can_be_undone_at_the_beginning() -> None:
    with pytest.raises(InvalidInputError, match="undo: expected something to take back"):
        apply_event(replay_events([BEGINNING]), Undone())


def test_a_title_is_no_edit_of_demonstrations_but_changes_the_revision(shown: Make) -> None:
    history = replay_events([BEGINNING, Demonstrated((shown(),)), Titled("new"), Undone()])
    assert (history.title, history.shown, history.revision) == ("new", (), 3)


def test_asking_and_judging_leave_the_revision_alone(shown: Make) -> None:
    signs = shown().signs
    history = replay_events(
        [BEGINNING, Asked(signs, 0, 0, 0.5), Asked(signs, 1, 2, 0.9), Judged(1, False), Judged(1, True)]
    )
    assert [given.good for given in history.answers] == [None, True]
    assert history.revision == 0


@pytest.mark.parametrize("event", [Deleted(1), Deleted(-1), Judged(0, True)])
def test_what_is_not_there_cannot_be_changed(event: Event, shown: Make) -> None:
    with pytest.raises(InvalidInputError, match="expected a number below"):
        replay_events([BEGINNING, Demonstrated((shown(),)), event])


def test_a_demonstration_with_other_objects_does_not_fit() -> None:
    with pytest.raises(InvalidInputError, match="demonstration 1: objects: expected 4, found 3"):
        replay_events([Created("", "", "free", 4, 0), Demonstrated((_shown_once(),))])


def test_objects_in_one_place_are_no_scene() -> None:
    heap = replace(_shown_once(), objects=np.zeros((3, 2)))
    with pytest.raises(
        InvalidInputError, match="demonstration 1: objects: expected places apart, found 3 in one place"
    ):
        replay_events([BEGINNING, Demonstrated((heap,))])


def test_a_session_begins_once() -> None:
    for events in ([], [Undone()], [BEGINNING, BEGINNING]):
        with pytest.raises(InvalidInputError, match="beginning"):
            replay_events(events)


@settings(deadline=None, max_examples=30)
@given(st.lists(st.sampled_from(["add", "delete", "undo", "redo"]), max_size=25))
def test_undo_is_what_a_list_of_snapshots_would_give(deeds: list[str]) -> None:
    """A slow oracle: all states in a list, and where we are in it."""
    history, at = replay_events([BEGINNING]), 0
    snapshots: list[tuple[DrawnDemonstration, ...]] = [()]
    for deed in deeds:
        now = snapshots[at]
        if deed == "undo" and at:
            history, at = apply_event(history, Undone()), at - 1
        elif deed == "redo" and at + 1 < len(snapshots):
            history, at = apply_event(history, Redone()), at + 1
        elif deed == "add":
            one = _shown_once()
            history, snapshots, at = (
                apply_event(history, Demonstrated((one,))),
                [*snapshots[: at + 1], (*now, one)],
                at + 1,
            )
        elif deed == "delete" and now:
            history, snapshots, at = apply_event(history, Deleted(0)), [*snapshots[: at + 1], now[1:]], at + 1
        assert history.shown == snapshots[at]


def _shown_once() -> DrawnDemonstration:
    places = np.arange(6.0).reshape(3, 2)
    stroke = Stroke(places, np.arange(3.0))
    return DrawnDemonstration((stroke, stroke), places, stroke)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"focus": 3}, "asked: focus: expected a number below 3, found 3"),
        ({"movement": 10**12}, "asked: movement: expected a number below 100, found 1000000000000"),
        ({"request": Request(5, 0)}, "asked: request: movement: expected a number below 3, found 5"),
        ({"request": Request(0, 3)}, "asked: request: focus: expected a number below 3, found 3"),
    ],
)
def test_nobody_asks_for_what_a_session_does_not_have(change: dict[str, Any], told: str, shown: Make) -> None:
    asked = Asked(shown().signs, 0, 2, 1.0, Request(2, 2))
    assert len(replay_events([BEGINNING, asked]).answers) == 1
    with pytest.raises(InvalidInputError, match=told):
        replay_events([BEGINNING, replace(asked, **change)])


@pytest.mark.parametrize("request_", [Request(3, 0), Request(0, 3)])
def test_a_prompt_that_the_language_does_not_have_is_refused(request_: Request, shown: Make) -> None:
    with pytest.raises(InvalidInputError, match=r"demonstration 2: prompt: \w+: expected a number below"):
        replay_events([BEGINNING, Demonstrated((shown(), replace(shown(), prompt=request_)))])


def test_a_session_in_a_language_that_the_studio_does_not_have_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="Unknown language 'papier'; known are paper"):
        replay_events([replace(BEGINNING, language="papier")])
    with pytest.raises(InvalidInputError, match="session: expected 3 objects, as its language has, found 4"):
        replay_events([replace(BEGINNING, objects=4)])
    assert replay_events([replace(BEGINNING, language="free", objects=4)]).created.objects == 4
