"""The page of the studio: reloads, two tabs, phones, keyboards, and what is not a stroke."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit_envs.studio.load import studio_process
from signimit_envs.studio.web.serving import StudioPlan, running_studio

expect = pytest.importorskip("playwright.sync_api", reason="the page is tested with playwright").expect
Visit = Callable[..., Any]
NewSession = Callable[..., str]
NewActor = Callable[[int], Any]
PHONE = {"width": 390, "height": 844}
VIEWS = ("teach", "ask", "look", "keep")


def drawn(visitor: Any, number: int) -> Any:
    return visitor.page.locator(f"#teach-pads figure:nth-child({number}) canvas[aria-label$=drawn]")


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system has no kill -9")
def test_what_is_half_drawn_is_there_after_a_reload_and_in_a_new_tab_after_a_kill_minus_nine(
    visit: Visit, new_session: NewSession, actor: NewActor, tmp_path: Path
) -> None:
    person = actor(6)
    with studio_process(tmp_path) as (address, process):
        first = visit(address=address)
        name = new_session(1, tmp_path)
        first.open("teach", name)
        first.sign("teach", 1, person.signer.draw("1", person.rng).points)
        first.until_kept("sign 1")
        first.page.reload()
        expect(drawn(first, 1)).to_be_visible()
        first.page.locator("#tab-ask").click()
        first.sign("ask", 1, person.signer.draw("2", person.rng).points)
        first.until_kept("question")
        os.kill(process, signal.SIGKILL)
        first.see("#connection", "No connection")
        first.page.close()
        first.problems.clear()  # the browser reported each attempt to connect
    with running_studio(StudioPlan(folder=tmp_path)) as address:
        second = visit(address=address)
        second.open("teach", name)
        expect(drawn(second, 1)).to_be_visible()
        expect(drawn(second, 2)).to_have_count(0)
        second.sign("teach", 2, person.signer.draw("4", person.rng).points)
        second.hand(person.path(second.session()))
        second.page.locator("#teach-it").click()
        second.see("#teach-count", "Demonstration 3")
        signs = second.api(f"sessions/{name}/demonstrations/1")["signs"]
        assert [len(sign["points"]) for sign in signs] == [8, 8]
        expect(drawn(second, 1)).to_have_count(0)
        second.page.locator("#tab-ask").click()
        expect(second.page.locator("#ask-pads canvas[aria-label='First sign: drawn']")).to_be_visible()
        second.sign("ask", 2, person.signer.draw("4", person.rng).points)
        second.see("#ask-sentence", "object, ")
        assert second.session()["draft"]["drawn"] == {}
        second.page.close()  # or the studio waits for it


def test_a_demonstration_can_be_undone_redone_deleted_and_redrawn(
    visit: Visit, new_session: NewSession, actor: NewActor
) -> None:
    visitor, person = visit(), actor(2)
    visitor.open("teach", new_session(3))
    for control, left in (("#undo", 2), ("#redo", 3)):
        visitor.page.locator(control).click()
        visitor.see("#session-facts", f"{left} demonstrations")
    visitor.page.get_by_role("button", name="Delete demonstration 3").click()
    visitor.see("#session-facts", "2 demonstrations")
    visitor.page.keyboard.press("Control+z")
    visitor.see("#session-facts", "3 demonstrations")

    before = visitor.api(f"sessions/{visitor.session()['id']}/demonstrations/1")
    visitor.page.get_by_role("button", name="Demonstration 2.").click()
    visitor.page.get_by_role("button", name="Redraw demonstration 2").click()
    visitor.see("#teach-count", "Redraw demonstration 2")
    visitor.sign("teach", 1, person.signer.draw("1", person.rng).points)
    visitor.page.get_by_role("button", name="Save demonstration 2").click()
    visitor.see("#teach-count", "Demonstration 4")
    after = visitor.api(f"sessions/{visitor.session()['id']}/demonstrations/1")
    assert after["hand"]["points"] == before["hand"]["points"]
    assert len(after["signs"][0]["points"]) == 8 != len(before["signs"][0]["points"])


def test_taps_and_cancelled_fingers_draw_nothing_and_a_movement_off_the_hand_starts_where_it_begins(
    visit: Visit, new_session: NewSession, in_picture: Callable[..., Any]
) -> None:
    visitor = visit(touch=True, viewport=PHONE)
    visitor.open("teach", new_session())
    pad, line = "#teach-pads figure:nth-child(1) canvas", np.linspace(0.3, 0.7, 8)[:, None] * [1, 1]
    visitor.draw(pad, line[:1], np.zeros(1))
    visitor.draw(pad, line, np.linspace(0, 0.4, 8), lift=False)
    visitor.event("Cancel", 0, 0, visitor.clock)
    visitor.page.locator("#teach-stage .stage:not(.waiting)").wait_for()
    visitor.draw("#teach-stage .sheet", np.full((1, 2), 0.05), np.zeros(1))
    visitor.see("#teach-hint strong", "Begin at the hand")
    expect(drawn(visitor, 1)).to_have_count(0)
    corner = np.array([[0.2, 0.05], [0.3, 0.1], [0.35, 0.3]])
    visitor.draw("#teach-stage .sheet", corner, np.linspace(0, 0.2, 3))
    visitor.until_kept("hand")
    begun = visitor.session()["draft"]["drawn"]["hand"][0]["points"]
    found = in_picture(visitor.api("studio")["picture"], np.array(begun))
    np.testing.assert_allclose(found, corner, atol=0.01)
    visitor.draw(pad, line, np.linspace(0, 0.4, 8))
    expect(drawn(visitor, 1)).to_be_visible()
    expect(visitor.page.locator("#teach-it")).to_be_disabled()


def test_a_finger_draws_a_demonstration_on_a_phone_and_nothing_is_cut_off(
    visit: Visit, new_session: NewSession, actor: NewActor
) -> None:
    visitor, person = visit(touch=True, viewport=PHONE), actor(3)
    visitor.open("teach", new_session(2))
    person.demonstrate(visitor, visitor.session())
    visitor.see("#belief", "What the robot believes")
    for view in VIEWS:
        visitor.page.locator(f"#tab-{view}").tap()
        expect(visitor.page.locator(f"#{view}")).to_be_visible()
        assert visitor.page.evaluate("document.documentElement.scrollWidth") == PHONE["width"], view


def test_two_tabs_do_not_corrupt_one_session(visit: Visit, new_session: NewSession, actor: NewActor) -> None:
    first, second, person = visit(), visit(), actor(4)
    name = new_session(1)
    first.open("teach", name)
    second.open("teach", name)
    person.speak(second, "teach", second.session()["next"]["prompt"])
    second.hand(person.path(second.session()))
    second.page.route(re.compile(rf"/api/sessions/{name}$"), lambda route: route.abort())  # news does not reach it
    person.demonstrate(first, first.session())
    second.page.locator("#alert").wait_for()
    second.page.unroute_all()
    second.page.locator("#teach-it").click()
    second.see("#alert", "Somebody changed this session meanwhile.")
    second.see("#teach-count", "Demonstration 3")
    expect(second.page.locator("#teach-it")).to_be_disabled()
    assert len(second.session()["demonstrations"]) == 2
    person.speak(second, "teach", second.session()["next"]["prompt"])
    expect(drawn(first, 2)).to_be_visible()
    second.hand(person.path(second.session()))
    second.page.locator("#teach-it").click()
    first.see("#teach-count", "Demonstration 4")
    expect(drawn(first, 2)).to_have_count(0)
    expect(first.page.locator("#alert")).to_be_hidden()
    assert any("409" in problem for problem in second.problems)
    second.problems.clear()  # the browser reports each refused request


def test_everything_is_reached_with_the_keyboard_and_built_in_people_play(
    visit: Visit, new_session: NewSession
) -> None:
    visitor = visit()
    name = new_session(10)
    visitor.open("teach", name)
    keyboard = visitor.page.keyboard
    visitor.page.locator("#tab-teach").focus()
    keyboard.press("ArrowLeft")
    expect(visitor.page.locator("#tab-keep")).to_be_focused()
    keyboard.press("Home")
    press_tab_until(visitor, "SUMMARY")
    keyboard.press("Enter")
    for _ in range(2):  # who signs, and who moves: somebody built in
        press_tab_until(visitor, "SELECT")
        keyboard.press("a")
    visitor.see("#teach-count", "Demonstration 13 · all were shown")
    visitor.page.locator("#tab-teach").focus()
    keyboard.press("ArrowRight")
    visitor.page.locator(".handle").nth(2).wait_for()
    press_tab_until(visitor, "BUTTON.handle")
    before = visitor.page.evaluate("document.activeElement.style.left")
    keyboard.press("ArrowRight")
    visitor.page.wait_for_function("(before) => document.activeElement.style.left !== before", arg=before)
    press_tab_until(visitor, "BUTTON#ask-for-it")
    keyboard.press("Enter")
    visitor.see("#ask-sentence", "about the red object")
    assert visitor.session()["answers"][0]["request"] == {"movement": 0, "focus": 0}


def test_a_demonstration_is_drawn_with_the_keyboard(
    visit: Visit, new_session: NewSession, in_picture: Callable[..., Any]
) -> None:
    visitor = visit()
    visitor.open("teach", new_session())
    visitor.page.locator("#teach-stage .stage:not(.waiting)").wait_for()
    keyboard = visitor.page.keyboard
    strokes = (["ArrowRight", "ArrowUp"], ["ArrowDown", "ArrowLeft"], ["ArrowUp", "ArrowRight", "ArrowDown"])
    for wanted, keys in zip(("CANVAS.pad-canvas", "CANVAS.pad-canvas", "CANVAS.sheet"), strokes, strict=True):
        press_tab_until(visitor, wanted)
        keyboard.press("Enter")
        for key in keys:
            for _ in range(4):
                keyboard.press(key)
        keyboard.press("Enter")
    press_tab_until(visitor, "BUTTON#teach-it")
    scene = visitor.session()["next"]["scene"]
    keyboard.press("Enter")
    visitor.see("#teach-count", "Demonstration 2")
    drawn = visitor.api(f"sessions/{visitor.session()['id']}/demonstrations/0")
    assert np.ptp(drawn["signs"][0]["points"], axis=0) == pytest.approx([8 / 24, 8 / 24])
    hand = np.array(drawn["hand"]["points"])
    np.testing.assert_allclose(hand[0], scene["hand"], atol=1e-6)
    shares = in_picture(visitor.api("studio")["picture"], hand)
    np.testing.assert_allclose(shares[-1] - shares[0], [4 / 64, 0], atol=1e-6)
    assert (np.diff(drawn["hand"]["times"]) > 0).all()


def press_tab_until(visitor: Any, wanted: str) -> None:
    for _ in range(60):
        visitor.page.keyboard.press("Tab")
        if visitor.page.evaluate("(wanted) => document.activeElement.matches(wanted)", wanted.lower()):
            return
    raise AssertionError(f"{wanted} is not reached with the Tab key")


def test_a_session_is_looked_at_exported_imported_and_merged(
    visit: Visit, new_session: NewSession, tmp_path: Any
) -> None:
    visitor = visit()
    visitor.open("look", new_session(4))
    page = visitor.page
    visitor.see("#matrix-told", "Point at a cell")
    page.locator(".matrix").focus()
    page.keyboard.press("ArrowRight")
    visitor.see("#matrix-told", "with itself")
    page.locator(".matrix").hover(position={"x": 200, "y": 10})
    visitor.see("#matrix-told", "/ rad²")
    page.locator("#look-figures details[open] img").wait_for()
    page.locator("#look-figures details[open] .enlarge").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog").get_by_role("img", name="Figure 4")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.locator("#replay-choice").select_option("demonstrations/3")
    visitor.see("#replay-sentence", "Understood: movement")

    page.locator("#tab-keep").click()
    with page.expect_download() as download:
        page.get_by_role("link", name="Demonstration set").click()
    file = tmp_path / "demonstrations.npz"
    download.value.save_as(file)
    page.locator("#import-file").set_input_files(file)
    page.locator("#import-it").click()
    visitor.see("#session-title", "demonstrations.npz")
    visitor.see("#session-facts", "4 demonstrations")
    page.locator("#tab-keep").click()
    page.get_by_role("button", name="Merge A test into").first.click()
    page.wait_for_function("() => document.querySelector('#session-facts').textContent !== '4 demonstrations'")
    assert len(visitor.session()["demonstrations"]) >= 5


def test_a_dropped_connection_comes_back(visit: Visit, new_session: NewSession) -> None:
    visitor = visit()
    servers: list[Any] = []
    visitor.page.route_web_socket(re.compile(r"/ws$"), lambda socket: servers.append(socket.connect_to_server()))
    visitor.open("ask", new_session(2))
    visitor.page.locator(".handle").nth(2).wait_for()
    visitor.page.evaluate("document.querySelectorAll('.handle').forEach((one) => { one.style.left = '' })")
    servers[0].close()
    visitor.page.wait_for_function("() => document.querySelector('.handle').style.left !== ''")
    expect(visitor.page.locator("#connection")).to_be_empty()
