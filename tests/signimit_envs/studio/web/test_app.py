"""The server as a page sees it: teach, undo, ask, look, keep, and two tabs at once."""

from __future__ import annotations

import itertools
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

import signimit as si
from signimit_envs.studio.limits import Limits
from signimit_envs.studio.page.built_in_people import templates
from signimit_envs.studio.page.exports import FORMATS
from signimit_envs.video.backend import choose_backend

Json = dict[str, Any]


def _stroke(count: int = 5, **changed: Any) -> Json:
    return {"points": [[n, n * n] for n in range(count)], "times": list(range(count)), **changed}


HAND = _stroke(points=[[0.01 * n, 0] for n in range(5)])
SHORT = {"revision": 0, "signs": [_stroke(), _stroke()], "hand": HAND}


@pytest.fixture
def opengl() -> None:
    try:
        choose_backend()
    except si.SignimitError as error:
        pytest.skip(str(error))


def test_the_studio_says_what_the_page_needs(page: Any) -> None:
    facts = page.get("studio")
    assert facts["picture"]["metres_per_pixel"]["table"] == pytest.approx(0.002324, abs=1e-6)
    assert facts["languages"] == ["paper", "movement first", "five movements", "free"]
    assert facts["exports"] == list(FORMATS)


def test_a_new_session_prompts_for_its_first_demonstration(session: Json) -> None:
    assert session["revision"] == 0
    assert session["belief"] is None
    assert session["next"]["left"] == 12
    assert len(session["next"]["scene"]["objects"]) == 3
    prompt = session["next"]["prompt"]
    assert prompt["text"].startswith(f"Sign {prompt['signs'][0]}, then {prompt['signs'][1]}. Then draw a ")


def test_after_twelve_demonstrations_the_belief_is_right(page: Any, taught_id: str) -> None:
    session = page.get(f"sessions/{taught_id}")
    assert session["next"]["left"] == 0
    for demonstration in session["demonstrations"]:
        assert demonstration["focus"] == demonstration["prompt"]["focus"]
    assert session["belief"]["word_order"]["focus"] == 0


def test_undo_redo_redraw_and_delete_change_the_belief_with_the_demonstrations(page: Any, session: Json) -> None:
    base = f"sessions/{session['id']}"
    session = page.teach(session, 2)
    redrawn = page.demonstration(session)
    session = dict(page.ask("PUT", f"{base}/demonstrations/0", json=redrawn).json())
    assert page.get(f"{base}/demonstrations/0")["signs"] == [
        {"points": sign["points"], "times": [t - sign["times"][0] for t in sign["times"]]} for sign in redrawn["signs"]
    ]
    session = dict(page.ask("DELETE", f"{base}/demonstrations/1?revision={session['revision']}").json())
    assert [len(session["demonstrations"]), len(session["belief"]["focus"])] == [1, 1]
    for expected in (2, 2, 1, 0):
        session = page.post(f"{base}/undo", {"revision": session["revision"]})
        assert len(session["demonstrations"]) == expected
    assert session["belief"] is None
    assert not session["can_undo"]
    session = page.post(f"{base}/redo", {"revision": session["revision"]})
    assert len(session["belief"]["focus"]) == 1
    refused = page.ask("DELETE", f"{base}/demonstrations/7?revision={session['revision']}")
    assert (refused.status_code, refused.json()) == (404, {"error": "There is no such demonstration."})


def test_undo_brings_back_what_was_believed_without_learning_again(
    page: Any, session: Json, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = page.teach(session, 1)
    after = page.teach(before, 1)
    monkeypatch.setattr("signimit_envs.studio.open_session.learn_session", None)
    undone = page.post(f"sessions/{session['id']}/undo", {"revision": after["revision"]})
    assert undone["belief"] == before["belief"]
    assert undone["next"] == before["next"]
    redone = page.post(f"sessions/{session['id']}/redo", {"revision": undone["revision"]})
    assert redone["belief"] == after["belief"]


def test_a_session_takes_only_so_many_events(page: Any, session: Json, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.open_session.LIMITS", Limits(events=3))
    where = f"sessions/{session['id']}/title"
    codes = [page.ask("POST", where, json={"revision": n, "title": "new"}).status_code for n in range(4)]
    assert codes == [200, 200, 422, 409]


def test_too_many_figures_at_once_are_refused(page: Any, taught_id: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.studio.LIMITS", Limits(waiting=0))
    assert page.ask("GET", f"sessions/{taught_id}/similarities").status_code == 429


def test_what_was_not_prompted_keeps_no_prompt(page: Any, session: Json) -> None:
    body = {**page.demonstration(session), "prompted": False}
    session = page.post(f"sessions/{session['id']}/demonstrations", body)
    assert session["demonstrations"][0]["prompt"] is None
    assert session["next"]["left"] == 12


def test_the_tab_that_comes_second_is_told_and_changes_nothing(page: Any, session: Json) -> None:
    bodies = [page.demonstration(session) for _ in range(6)]
    with ThreadPoolExecutor(6) as tabs:
        where = f"sessions/{session['id']}/demonstrations"
        answers = list(tabs.map(lambda body: page.ask("POST", where, json=body), bodies))
    assert sorted(answer.status_code for answer in answers) == [200, 409, 409, 409, 409, 409]
    stale = next(answer.json() for answer in answers if answer.status_code == 409)
    assert stale == {"error": "Another tab changed this session: it is at revision 1, not 0.", "revision": 1}
    assert len(page.get(f"sessions/{session['id']}")["demonstrations"]) == 1


def test_looking_while_another_tab_edits_sees_the_session_before_or_after(page: Any, session: Json) -> None:
    base = f"sessions/{session['id']}"
    with ThreadPoolExecutor(1) as tab:
        teaching = tab.submit(page.teach, session, 4)
        while not teaching.done():
            seen = page.get(base)
            assert len(seen["demonstrations"]) == seen["revision"] == len((seen["belief"] or {"focus": []})["focus"])


def test_merging_appends_the_demonstrations_of_another_session(page: Any, session: Json) -> None:
    other = page.teach(page.post("sessions", {"seed": 4}), 2)
    session = page.teach(session, 1)
    base = f"sessions/{session['id']}"
    merged = page.post(f"{base}/merge", {"revision": session["revision"], "other": other["id"]})
    assert [d["prompt"] for d in merged["demonstrations"][1:]] == [d["prompt"] for d in other["demonstrations"]]
    assert len(page.post(f"{base}/undo", {"revision": merged["revision"]})["demonstrations"]) == 1
    five = page.post("sessions", {"language": "free", "objects": 5})
    refused = page.ask("POST", f"sessions/{five['id']}/merge", json={"revision": 0, "other": other["id"]})
    assert (refused.status_code, refused.json()["error"]) == (422, "demonstration 1: objects: expected 5, found 3.")


def test_a_session_in_made_up_signs_has_no_prompts_and_no_built_in_people(page: Any) -> None:
    session = page.post("sessions", {"language": "free", "objects": 4})
    assert session["next"]["prompt"] is None
    assert len(session["next"]["scene"]["objects"]) == 4
    body = {"part": "signs", "movement": 0, "focus": 0}
    refused = page.ask("POST", f"sessions/{session['id']}/people", json=body)
    assert refused.status_code == 422
    assert "one in made-up signs" in refused.json()["error"]


@pytest.mark.slow
def test_the_simulated_hand_draws_the_right_movement_about_the_right_object_for_a_pair_never_shown(
    page: Any, taught_id: str
) -> None:
    session, base = page.get(f"sessions/{taught_id}"), f"sessions/{taught_id}"
    request = session["language"]["unseen"][2]
    assert request not in [d["prompt"] for d in session["demonstrations"]]
    page.post(f"{base}/table", {})
    answer = page.post(f"{base}/ask", {"signs": page.signs(taught_id, request, 99), "request": request})
    assert answer["focus"] == request["focus"]
    assert answer["text"].startswith(f"movement {answer['movement'] + 1} (circle) about the blue object, ")
    for _ in range(240):
        time.sleep(0.25)
        track = page.get(f"{base}/answers/{answer['number']}")
        if len(track["path"]) < 100:
            continue
        done = si.performed(track["path"], track["objects"][-1][1], templates("paper", 7))
        if (done.movement, done.focus) == (request["movement"], request["focus"]):
            break
    else:
        pytest.fail(f"the hand did {done}")
    page.post(f"{base}/stop", {})
    judged = page.post(f"{base}/answers/{answer['number']}/verdict", {"good": True})
    assert judged["answers"][answer["number"]]["verdict"] is True
    assert track["times"][1] == 0.02


def test_nothing_can_be_asked_before_anything_was_shown(page: Any, session: Json) -> None:
    request = {"movement": 0, "focus": 0}
    refused = page.ask("POST", f"sessions/{session['id']}/ask", json={"signs": page.signs(session["id"], request, 0)})
    assert refused.status_code == 422
    assert "at least one demonstration" in refused.json()["error"]


def test_an_arm_that_is_not_sure_asks_back_and_moves_when_a_person_insists(
    page: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("signimit_envs.studio.studio.LEAST_CONFIDENCE", 1.1)
    session = page.teach(page.post("sessions", {"seed": 5}), 3)
    base = f"sessions/{session['id']}"
    page.post(f"{base}/table", {})
    asked = page.post(f"{base}/ask", {"signs": page.signs(session["id"], session["demonstrations"][0]["prompt"], 3)})
    assert (asked["held"], asked["running"]) == (True, False)
    assert page.post(f"{base}/answers/0/insist", {})["held"] is False
    assert page.get(base)["answers"][0]["held"] is False
    refused = page.ask("POST", f"{base}/answers/0/insist", json={})
    assert refused.json()["error"] == "answer 1: expected one that the arm has asked back about, found another."


def test_movements_have_names_that_stay_with_their_demonstrations(page: Any, session: Json) -> None:
    session = page.teach(session, 1)
    base = f"sessions/{session['id']}"
    assert session["belief"]["names"] == [
        session["language"]["movements"][session["demonstrations"][0]["prompt"]["movement"]]
    ]
    named = page.post(f"{base}/movements/0/name", {"revision": session["revision"], "title": " wave "})
    assert named["belief"]["names"] == ["wave"]
    assert "wave" in page.teach(named, 1)["belief"]["names"]
    missing = page.ask("POST", f"{base}/movements/9/name", json={"revision": 2, "title": "wave"})
    assert (missing.status_code, missing.json()["error"]) == (404, "There is no such movement.")


def test_a_deleted_session_is_gone_for_good(page: Any, session: Json) -> None:
    page.teach(session, 1)
    assert page.ask("DELETE", f"sessions/{session['id']}").status_code == 200
    assert page.ask("GET", f"sessions/{session['id']}").status_code == 404
    assert session["id"] not in [one["id"] for one in page.get("sessions")["sessions"]]


def test_sessions_are_listed_the_newest_first_with_their_titles(page: Any) -> None:
    session = page.post("sessions", {"title": " Grandmother's signs "})
    page.post(f"sessions/{session['id']}/title", {"revision": 0, "title": "Grandfather's signs"})
    listed = page.get("sessions")["sessions"]
    assert listed[0]["id"] >= listed[-1]["id"]
    assert {"Grandfather's signs"} == {one["title"] for one in listed if one["id"] == session["id"]}


@pytest.mark.parametrize("name", FORMATS)
def test_an_exported_session_can_be_imported(name: str, page: Any, pair_id: str) -> None:
    pytest.importorskip("defusedxml", reason="InkML needs signimit[strokes]")
    exported = page.ask("GET", f"sessions/{pair_id}/export/{name}")
    assert exported.headers["content-disposition"].startswith("attachment; filename=")
    imported = page.ask("POST", f"import?format={name}&title=again", content=exported.content)
    assert imported.status_code == 201, imported.text
    assert imported.json()["title"] == "again"
    assert imported.json()["belief"]["labels"] == page.get(f"sessions/{pair_id}")["belief"]["labels"]


def test_a_broken_import_leaves_no_session(page: Any) -> None:
    before = len(page.get("sessions")["sessions"])
    refused = page.ask("POST", "import?format=strokes.npz", content=b"nonsense")
    assert refused.status_code == 422
    assert refused.json()["error"].startswith("the file: expected a signimit stroke library file")
    assert len(page.get("sessions")["sessions"]) == before


@pytest.mark.parametrize("name", ["4.png", "5.svg", "6.png"])
def test_the_figures_of_a_session_are_drawn(name: str, page: Any, pair_id: str) -> None:
    pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")
    figure = page.ask("GET", f"sessions/{pair_id}/figures/{name}")
    assert figure.content.startswith(b"\x89PNG" if name.endswith("png") else b"<?xml")


def test_similarities_can_be_hovered_over(page: Any, taught_id: str) -> None:
    matrices = page.get(f"sessions/{taught_id}/similarities")
    assert [len(matrices["maximum"]), len(matrices["frames"]), len(matrices["frames"][0][0])] == [12, 3, 12]
    labels = [matrices["labels"][n] for n in matrices["order"]]
    assert labels == sorted(labels)


@pytest.mark.slow
@pytest.mark.usefixtures("opengl")
def test_pictures_and_films_are_what_they_say(page: Any, session: Json) -> None:
    base = f"sessions/{session['id']}"
    assert page.ask("GET", f"{base}/scene.jpg").content.startswith(b"\xff\xd8")
    page.post(f"{base}/demonstrations", SHORT)
    assert page.ask("GET", f"{base}/demonstrations/0/scene.jpg").content.startswith(b"\xff\xd8")
    film = page.ask("GET", f"{base}/demonstrations/0/film.mp4")
    assert (film.headers["content-type"], film.content[4:8]) == ("video/mp4", b"ftyp")


@pytest.mark.parametrize(
    ("method", "path", "status"),
    [
        ("GET", "sessions/20200101-000000-00000000", 404),
        ("GET", "sessions/..%2f..%2fetc%2fpasswd", 404),
        ("GET", "nothing", 404),
        ("DELETE", "sessions", 405),
        ("GET", "sessions/ID/figures/9.png", 422),
        ("GET", "sessions/ID/figures/4.gif", 422),
        ("GET", "sessions/ID/figures/4.png", 422),
        ("GET", "sessions/ID/similarities", 422),
        ("GET", "sessions/ID/export/strokes.exe", 422),
        ("GET", "sessions/ID/export/strokes.csv", 422),
        ("GET", "sessions/ID/demonstrations/0", 404),
        ("GET", "sessions/ID/demonstrations/0/film.mp4", 404),
        ("GET", "sessions/ID/demonstrations/-1", 422),
        ("GET", "sessions/ID/answers/0", 404),
        ("GET", "sessions/ID/answers/0/film.mp4", 404),
        ("POST", "sessions/ID/undo", 422),
        ("POST", "import?format=nonsense", 422),
    ],
)
def test_what_cannot_be_is_refused_with_a_code_and_a_sentence(
    method: str, path: str, status: int, page: Any, session: Json
) -> None:
    answer = page.ask(method, path.replace("ID", session["id"]), json={"revision": 0} if method == "POST" else None)
    assert answer.status_code == status
    assert set(answer.json()) == {"error"}
    assert "Traceback" not in answer.text


@pytest.mark.parametrize(
    "changed",
    [
        {"signs": [_stroke()]},
        {"signs": [_stroke(), _stroke(), _stroke()]},
        {"signs": [_stroke(), _stroke(points=[[0, 0]] * 5)]},
        {"signs": [_stroke(), _stroke(times=[0, 1])]},
        {"signs": [_stroke(), _stroke(times=[4, 3, 2, 1, 0])]},
        {"signs": [_stroke(), _stroke(times=[0, 1, 2, 3, 4000])]},
        {"signs": [_stroke(), _stroke(5001)]},
        {"signs": [_stroke(), _stroke(points=[[0, 1, 2]] * 5)]},
        {"signs": [_stroke(), _stroke(points=[["a", "b"]] * 5)]},
        {"signs": [_stroke(), _stroke(points=[[0, 1e300]] * 5)]},
        {"hand": _stroke()},
        {"hand": None},
        {"revision": -1},
        {"revision": "zero"},
        {"more": 1},
    ],
)
def test_a_demonstration_that_cannot_be_is_refused_and_not_kept(changed: Json, page: Any, session: Json) -> None:
    where = f"sessions/{session['id']}/demonstrations"
    refused = page.ask("POST", where, json={**SHORT, **changed})
    assert refused.status_code == 422, refused.text
    assert page.get(f"sessions/{session['id']}")["demonstrations"] == []
    assert page.ask("POST", where, json=SHORT).status_code == 200


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe", b"[" * 100_000, b'{"revision": NaN}', b"null", b"[]"])
def test_what_is_no_json_is_refused(content: bytes, page: Any, session: Json) -> None:
    headers = {"Content-Type": "application/json"}
    where = f"sessions/{session['id']}/demonstrations"
    answer = page.ask("POST", where, content=content, headers=headers)
    assert answer.status_code in (400, 422)
    assert set(answer.json()) == {"error"}


def test_points_that_share_a_time_stamp_are_taken(page: Any, session: Json) -> None:
    signs = [_stroke(times=[0, 0, 1, 1, 1]), _stroke(times=[5, 5, 5, 6, 7])]
    page.post(f"sessions/{session['id']}/demonstrations", {**SHORT, "signs": signs})
    times = page.get(f"sessions/{session['id']}/demonstrations/0")["signs"][1]["times"]
    assert times[0] == 0
    assert all(a < b for a, b in itertools.pairwise(times))


@pytest.mark.parametrize(
    ("key", "told"),
    [("\x1b]0;title\x07\n", r"\x1b]0;title\x07\n: "), ("\u202egro.live", r"\u202egro.live: "), ("größe", "größe: ")],
)
def test_what_is_quoted_in_an_answer_and_the_log_moves_no_terminal(
    page: Any, caplog: pytest.LogCaptureFixture, key: str, told: str
) -> None:
    answer = page.ask("POST", "sessions", json={key: 1})
    assert answer.json() == {"error": f"{told}Extra inputs are not permitted"}
    assert caplog.messages == [f"refused with 422: {told}Extra inputs are not permitted"]


def test_what_is_quoted_is_not_longer_than_a_sentence(page: Any) -> None:
    answer = page.ask("POST", "sessions", json={"k" * 100_000: 1})
    assert answer.json() == {"error": f"{'k' * 500} ..."}


def test_only_so_many_files_are_read_at_once(page: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.studio.LIMITS", Limits(waiting=0))
    assert page.ask("POST", "import?format=strokes.csv", content=b"").status_code == 429


def test_who_asks_for_the_head_of_the_page_gets_it(page: Any) -> None:
    for path in ("", "index.html", "icon.svg"):
        whole, head = page.browser.get(path), page.browser.head(path)
        assert (head.status_code, head.content) == (200, b"")
        assert head.headers["content-length"] == str(len(whole.content))
