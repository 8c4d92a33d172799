"""Twelve demonstrations are drawn in a real browser, point by point; then the simulated hand obeys."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from signimit import performed

CIRCLE, BLUE = 2, 2  # never demonstrated in the paper's language
SECOND = 50  # samples of an answer's path
PAUSE, PATIENCE = 100, 600  # ms between two looks at what the hand did, and how many of them


def test_twelve_drawn_demonstrations_are_understood_and_an_unseen_request_is_obeyed(
    visit: Callable[..., Any], new_session: Callable[..., str], actor: Callable[[int], Any], in_picture: Any
) -> None:
    visitor = visit(viewport={"width": 1280, "height": 900})
    name, person = new_session(), actor(11)
    visitor.open("teach", name)
    prompts = teach_all(visitor, person)
    check_belief(visitor, prompts)

    visitor.page.get_by_role("tab", name="Ask").click()
    visitor.page.locator(".handle").nth(2).wait_for()
    person.speak(visitor, "ask", {"movement": CIRCLE, "focus": BLUE})
    visitor.see("#ask-sentence", "about the blue object")
    answer = wait_until_blue_is_circled(visitor, name, person, 0)

    visitor.page.get_by_role("button", name="Right").click()
    visitor.page.locator(".verdict[aria-pressed=true]").wait_for()
    assert visitor.session()["answers"][0]["verdict"] is True

    meddle(visitor, answer, in_picture)
    meddled = len(visitor.api(f"sessions/{name}/answers/0")["path"])
    after = wait_until_blue_is_circled(visitor, name, person, meddled + 2 * SECOND)
    assert np.linalg.norm(np.subtract(after["objects"][-1][1][BLUE], answer["objects"][-1][1][BLUE])) > 0.04


def teach_all(visitor: Any, person: Any) -> list[Any]:
    prompts = []
    for _ in range(12):
        session = visitor.session()
        prompts.append(session["next"]["prompt"])
        person.demonstrate(visitor, session)
    return prompts


def check_belief(visitor: Any, prompts: list[Any]) -> None:
    belief = visitor.session()["belief"]
    assert belief["focus"] == [prompt["focus"] for prompt in prompts]
    pairs = {(label, prompt["movement"]) for label, prompt in zip(belief["labels"], prompts, strict=True)}
    assert len(pairs) == len({label for label, _ in pairs}) == 3
    visitor.see("#word-order", "The first sign names the object, the second the movement.")
    visitor.see("#belief", "3 movements, and the signs for them")
    names = ("red", "green", "blue")
    for number in (0, 11):
        visitor.page.locator(".thumb").nth(number).click()
        visitor.see("#chosen-belief", f"about the {names[prompts[number]['focus']]} object")


def wait_until_blue_is_circled(visitor: Any, name: str, person: Any, first: int) -> Any:
    """Wait until the hand, from a sample of its path on, has gone round the blue object where it lies now."""
    done = None
    for _ in range(PATIENCE):
        answer = visitor.api(f"sessions/{name}/answers/0")
        path = answer["path"][first:]
        if len(path) > SECOND:
            done = performed(path, answer["objects"][-1][1], person.templates)
            if (done.movement, done.focus) == (CIRCLE, BLUE) and done.coverage > 0.8:
                return answer
        visitor.page.wait_for_timeout(PAUSE)
    raise AssertionError(f"the hand did {done}")


def meddle(visitor: Any, answer: Any, in_picture: Any) -> None:
    """Drag the blue object to the table's middle by 6 cm, and flick the hand."""
    picture = visitor.api("studio")["picture"]
    blue = np.array(answer["objects"][-1][1][BLUE])
    towards = blue - 0.06 * blue / np.linalg.norm(blue)
    places = np.linspace(blue, towards, 6)
    visitor.draw("#ask-stage .sheet", in_picture(picture, places), np.linspace(0, 0.3, 6))
    visitor.page.locator("#shove").click()
