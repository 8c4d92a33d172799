"""What the page is told where people err: one demonstration does another movement, one is a scribble."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from signimit.strokes import Stroke
from signimit.teaching.languages import Request
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit_envs.studio.open_session import learn_session
from signimit_envs.studio.page.built_in_people import draw_answer, draw_utterance
from signimit_envs.studio.page.prompts import LANGUAGES, next_request
from signimit_envs.studio.store.events import Created, Demonstrated, DrawnDemonstration
from signimit_envs.studio.store.history import History, apply_event, replay_events

SEED, WRONG, SCRIBBLE = 7, 5, 11


def scribble(hand: Stroke) -> Stroke:
    """Something that wanders as long as a hand did, from where it began."""
    rng = np.random.default_rng(3)
    steps = rng.normal(0, 0.006, (len(hand.points), 2))
    return replace(hand, points=hand.points[0] + np.cumsum(steps, axis=0))


def demonstrated(asked: Request, done: Request, number: int) -> DrawnDemonstration:
    rng = np.random.default_rng([number, 1])
    objects, hand = sample_scene(rng), sample_hand(rng)
    signs = draw_utterance("paper", SEED, asked, number)
    drawn = draw_answer("paper", SEED, done, number, (objects, hand))
    return DrawnDemonstration(signs, objects, scribble(drawn) if number == SCRIBBLE else drawn, asked)


@pytest.fixture(scope="module")
def history() -> History:
    made = replay_events([Created("t", "2020-01-01T00:00:00", "paper", 3, SEED)])
    for number in range(12):
        asked = next_request(LANGUAGES["paper"], SEED, [one.prompt for one in made.shown]).request
        done = Request((asked.movement + 1) % 3, asked.focus) if number == WRONG else asked
        made = apply_event(made, Demonstrated((demonstrated(asked, done, number),)))
    return made


@pytest.fixture(scope="module")
def belief(history: History) -> dict[str, Any]:
    found = learn_session(history, None).belief
    assert found is not None
    assert "failed" not in found, found
    return found


def test_both_are_under_suspicion_with_the_reason(belief: dict[str, Any]) -> None:
    suspected = {doubt["number"]: doubt["text"] for doubt in belief["doubtful"] if doubt["suspected"]}
    assert set(suspected) == {WRONG, SCRIBBLE}
    assert "Demonstration 6 asks for movement " in suspected[WRONG]
    assert " about it. It would fit if it showed movement " in suspected[WRONG]
    assert "but shows none of the movements." in suspected[SCRIBBLE]
    assert [t for t, trust in enumerate(belief["trust"]) if trust < 0.5] == [WRONG, SCRIBBLE]


def test_what_shows_nothing_can_be_sent_and_belongs_to_no_movement(belief: dict[str, Any]) -> None:
    json.dumps(belief, allow_nan=False)
    assert (belief["labels"][SCRIBBLE], belief["focus"][SCRIBBLE]) == (-1, -1)
    members = [number for movement in belief["movements"] for number in movement["members"]]
    assert sorted(members) == [t for t in range(12) if t != SCRIBBLE]


def test_signs_are_shown_with_what_they_ask_for(belief: dict[str, Any]) -> None:
    for kind in ("objects", "movements"):
        assert [len(entry["strokes"]) for entry in belief["lexicon"][kind]] == [4, 4, 4]


def test_it_wishes_for_a_pair_under_suspicion_and_says_why(history: History, belief: dict[str, Any]) -> None:
    wish = belief["wish"]
    asked = [history.shown[t].prompt for t in (WRONG, SCRIBBLE)]
    copied = [history.shown[t].prompt for t in wish["copied"]]
    assert not {WRONG, SCRIBBLE} & set(wish["copied"])
    first, second = copied
    assert first is not None
    assert second is not None
    assert Request(second.movement, first.focus) in asked
    assert wish["text"].endswith("ask again, as I doubt that what I was shown then was meant.")


def test_the_word_order_cannot_be_told_after_one_demonstration(history: History, belief: dict[str, Any]) -> None:
    first = replay_events([history.created, Demonstrated((history.shown[0],))])
    early = learn_session(first, None).belief
    assert early is not None
    assert not early["word_order"]["clear"]
    assert early["word_order"]["text"].startswith("The word order cannot be told yet; so far it seems that the ")
    assert belief["word_order"]["clear"]
    assert belief["word_order"]["text"] == "The first sign names the object, the second the movement."
