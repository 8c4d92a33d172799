"""What is drawn and not sent yet is kept stroke by stroke, and ends with the demonstration."""

from __future__ import annotations

from typing import Any

import pytest

from signimit_envs.studio.limits import LIMITS

Json = dict[str, Any]
SIGN: Json = {"points": [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]], "times": [0.0, 0.1, 0.2]}
OTHER: Json = {**SIGN, "points": [[0.0, 0.0], [0.1, 0.3], [0.2, 0.0]]}
NOTHING: Json = {"number": None, "drawn": {}}


def _keep(page: Any, session: Json, drawn: Json, **more: Any) -> Any:
    body = {"revision": session["revision"], "drawn": drawn, **more}
    return page.ask("PUT", f"sessions/{session['id']}/draft", json=body)


def _drawn(page: Any, session: Json) -> Json:
    return dict(page.get(f"sessions/{session['id']}")["draft"]["drawn"])


def test_every_page_sees_the_last_stroke_at_each_place(page: Any, session: Json) -> None:
    assert session["draft"] == NOTHING
    strokes: list[Json] = [
        {"sign 1": [SIGN, OTHER]},
        {"sign 2": [SIGN]},
        {"sign 2": [OTHER], "hand": [OTHER]},
        {"hand": []},
    ]
    for drawn in strokes:
        answer = _keep(page, session, drawn)
        assert answer.status_code == 200, answer.text
    assert _drawn(page, session) == {"sign 1": [SIGN, OTHER], "sign 2": [OTHER], "hand": []}


def test_a_draft_is_no_edit_and_ends_with_the_demonstration(page: Any, session: Json) -> None:
    demonstration = page.demonstration(session)
    assert _keep(page, session, {"sign 1": [SIGN], "question": [SIGN]}).json()["revision"] == session["revision"]
    taught = page.post(f"sessions/{session['id']}/demonstrations", demonstration)
    assert taught["draft"]["drawn"] == {"question": [SIGN]}
    _keep(page, taught, {"sign 1": [SIGN]})
    undone = page.post(f"sessions/{session['id']}/undo", {"revision": taught["revision"]})
    assert undone["draft"]["drawn"] == {"question": [SIGN]}


def test_a_question_ends_when_it_is_asked(page: Any, session: Json) -> None:
    session = page.teach(session, 1)
    _keep(page, session, {"question": [SIGN]})
    page.post(f"sessions/{session['id']}/ask", {"signs": [SIGN, OTHER]})
    page.post(f"sessions/{session['id']}/stop", {})
    assert _drawn(page, session) == {}


def test_a_stroke_on_a_table_that_is_gone_is_refused(page: Any, session: Json) -> None:
    page.teach(session, 1)
    late = _keep(page, session, {"hand": [OTHER]})
    assert (late.status_code, late.json()["revision"]) == (409, 1)
    assert _drawn(page, session) == {}


def test_a_demonstration_can_be_half_redrawn(page: Any, session: Json) -> None:
    session = page.teach(session, 1)
    _keep(page, session, {"sign 1": [SIGN]})
    assert _keep(page, session, {"hand": [OTHER]}, number=0).json()["draft"] == {
        "number": 0,
        "drawn": {"hand": [OTHER]},
    }
    assert _keep(page, session, {"hand": [OTHER]}, number=1).status_code == 404


@pytest.mark.parametrize(
    ("drawn", "sentence"),
    [
        ({}, "drawn: Dictionary should have at least 1 item"),
        ({"foot": [SIGN]}, "'sign 1', 'sign 2', 'hand' or 'question'"),
        ({"sign 1": [{**SIGN, "points": [[1, 1]] * 3}]}, "sign 1"),
        ({"sign 1": [{**SIGN, "times": [0, 1e5, 2e5]}]}, "sign 1: expected at most 600 s"),
        ({"hand": [{**SIGN, "points": [[0, 0], [1, 1], [2, 9]]}]}, "hand: expected positions over the table"),
        ({"sign 1": [SIGN] * (LIMITS.lifts + 1)}, "at most 50 items"),
        ({"sign 1": [{"points": [[n, n] for n in range(3000)], "times": list(range(600)) * 5}]}, "sign 1"),
        (
            {"sign 1": [{"points": [[n, n] for n in range(3000)], "times": [n / 9 for n in range(3000)]}] * 2},
            "sign 1: expected at most 5000 points",
        ),
    ],
)
def test_what_is_no_stroke_is_not_kept(drawn: Json, sentence: str, page: Any, session: Json) -> None:
    answer = _keep(page, session, drawn)
    assert answer.status_code == 422
    assert sentence in answer.json()["error"]
    assert _drawn(page, session) == {}
