"""What a person can choose in the page beside drawing: to delete, to name, and to let an unsure arm move."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest


def test_a_session_is_deleted_once_it_was_confirmed(visit: Callable[..., Any], new_session: Callable[..., str]) -> None:
    visitor = visit()
    gone, kept = new_session(), new_session()
    visitor.api(f"sessions/{gone}/title", {"revision": 0, "title": "to be deleted"})
    visitor.open("keep", kept)
    visitor.page.get_by_role("button", name="Delete to be deleted").click()
    assert gone in [one["id"] for one in visitor.api("sessions")["sessions"]]
    visitor.page.get_by_role("button", name="Delete for good: to be deleted").click()
    visitor.page.get_by_role("button", name="Delete for good: to be deleted").wait_for(state="detached")
    assert gone not in [one["id"] for one in visitor.api("sessions")["sessions"]]


def test_a_movement_is_named_and_an_unsure_arm_waits_for_move_anyway(
    visit: Callable[..., Any],
    new_session: Callable[..., str],
    actor: Callable[[int], Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("signimit_envs.studio.studio.LEAST_CONFIDENCE", 1.1)
    visitor = visit(viewport={"width": 1280, "height": 900})
    visitor.open("teach", new_session(12))
    field = visitor.page.get_by_label("Name of movement 1")
    field.fill("wave")
    field.press("Enter")
    visitor.see("#belief", "(wave)")
    visitor.page.get_by_role("tab", name="Ask").click()
    visitor.page.locator(".handle").nth(2).wait_for()
    actor(3).speak(visitor, "ask", {"movement": 1, "focus": 1})
    visitor.see("#ask-sentence", "Not sure, so the arm waits.")
    visitor.page.get_by_role("button", name="Move anyway").click()
    visitor.page.locator("#ask-insist").wait_for(state="hidden")
    session = visitor.session()
    assert session["answers"][0]["held"] is False
    assert session["belief"]["names"][0] == "wave"


def test_what_is_missing_is_said_and_a_second_sign_of_two_strokes_is_one_question(
    visit: Callable[..., Any], new_session: Callable[..., str]
) -> None:
    visitor = visit(viewport={"width": 1280, "height": 900})
    visitor.open("teach", new_session(12))
    visitor.see("#teach-missing", "Still to draw: the first sign, the second sign and the movement.")
    line = np.array([[0.0, 0.0], [0.5, 1.0], [1.0, 0.0], [1.0, 1.0]])
    visitor.sign("teach", 1, line)
    visitor.see("#teach-missing", "Still to draw: the second sign and the movement.")
    visitor.page.get_by_role("button", name="Ask the arm now").click()
    visitor.see("#ask-taught", "Signs that were taught")
    visitor.page.locator(".handle").nth(2).wait_for()
    for number in (1, 2, 2):
        visitor.sign("ask", number, line)
    visitor.see("#ask-answers", "1. Movement")
    visitor.page.wait_for_timeout(800)  # longer than a lifted pen is waited for
    assert len(visitor.session()["answers"]) == 1


def test_a_wrong_answer_leads_to_a_demonstration_of_what_was_meant(
    visit: Callable[..., Any], new_session: Callable[..., str], actor: Callable[[int], Any]
) -> None:
    visitor, person = visit(viewport={"width": 1280, "height": 900}), actor(6)
    visitor.open("ask", new_session(6))
    visitor.page.locator(".handle").nth(2).wait_for()
    person.speak(visitor, "ask", {"movement": 1, "focus": 1})
    visitor.see("#ask-answers", "1. Movement")
    visitor.page.get_by_role("button", name="Wrong", exact=True).click()
    visitor.page.get_by_role("button", name="Show what I meant").click()
    visitor.see("#teach-missing", "Still to draw: the movement.")
    visitor.see("#teach-prompt", "you asked for something else")
    session = visitor.session()
    visitor.hand(
        np.add(session["next"]["scene"]["hand"], 0.05 * np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]])), 0.2
    )
    visitor.page.locator("#teach-it").click()
    visitor.see("#teach-count", "Demonstration 8")
    taught, asked = (visitor.api(f"sessions/{session['id']}/{what}") for what in ("demonstrations/6", "answers/0"))
    assert visitor.session()["demonstrations"][6]["prompt"] is None
    for one, other in zip(taught["signs"], asked["signs"], strict=True):
        shapes = [np.array(sign["points"]) - np.mean(sign["points"], axis=0) for sign in (one, other)]
        first, second = (shape / np.ptp(shape, axis=0).max() for shape in shapes)
        np.testing.assert_allclose(first, second, atol=0.01)
