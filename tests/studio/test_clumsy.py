"""What clumsy and hostile people do with the page: it neither breaks nor keeps what they did not mean."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

expect = pytest.importorskip("playwright.sync_api", reason="the page is tested with playwright").expect
Visit = Callable[..., Any]
NewSession = Callable[..., str]
PAD, TABLE = "#teach-pads figure:nth-child(1) canvas", "#teach-stage .sheet"


def from_the_hand(visitor: Any, in_picture: Any, *places: tuple[float, float]) -> Any:
    """A movement over the table, in shares of its picture, that begins at the hand."""
    start = in_picture(visitor.api("studio")["picture"], np.array(visitor.session()["next"]["scene"]["hand"]))
    return np.array([start, *places])


def draw_from_the_hand(visitor: Any, in_picture: Any, *places: tuple[float, float], lift: bool = True) -> None:
    visitor.page.locator("#teach-stage .stage:not(.waiting)").wait_for()
    path = from_the_hand(visitor, in_picture, *places)
    visitor.draw(TABLE, path, np.linspace(0, 0.4, len(path)), lift=lift)


def test_a_shaky_click_draws_nothing_and_a_table_that_changes_under_the_pen_forgets_the_stroke(
    visit: Visit, new_session: NewSession, in_picture: Any
) -> None:
    visitor = visit()
    visitor.open("teach", new_session(1))
    visitor.draw(PAD, np.array([[0.5, 0.5], [0.53, 0.51], [0.51, 0.52]]), np.linspace(0, 0.2, 3))  # a shaky click
    expect(visitor.page.locator(f"{PAD}[aria-label$=empty]")).to_be_visible()
    draw_from_the_hand(visitor, in_picture, (0.5, 0.4), (0.6, 0.5), lift=False)
    visitor.page.keyboard.press("Control+z")
    visitor.see("#session-facts", "0 demonstrations")
    for what in ("Move", "End"):
        visitor.event(what, 600, 400, visitor.clock + 0.1)
    draw_from_the_hand(visitor, in_picture, (0.5, 0.4), (0.6, 0.5))
    visitor.until_kept("hand")
    expect(visitor.page.locator("#alert")).to_be_hidden()


def test_a_movement_goes_along_the_edge_of_the_picture_and_ends_with_the_longest_time_and_can_be_taught(
    visit: Visit, new_session: NewSession, in_picture: Any
) -> None:
    visitor = visit()
    visitor.open("teach", new_session())
    draw_from_the_hand(visitor, in_picture, (0.5, 0.4), (40.0, -30.0), (-50.0, 60.0), (0.5, 0.5))
    kept = teach_twice_clicked(visitor, 1)
    places = in_picture(visitor.api("studio")["picture"], np.array(kept["points"]))
    assert places.min() == pytest.approx(0, abs=1e-6)
    assert places.max() == pytest.approx(1, abs=1e-6)

    visitor.page.locator("#teach-stage .stage:not(.waiting)").wait_for()
    path = from_the_hand(visitor, in_picture, (0.5, 0.4), (0.6, 0.5), (0.4, 0.6))
    visitor.draw(TABLE, path, np.array([0.0, 1.0, 500.0, 650.0]))
    visitor.see("#alert", "A drawing takes at most ten minutes; what was drawn by then is kept.")
    assert teach_twice_clicked(visitor, 2)["times"][-1] == pytest.approx(500, abs=1)


def teach_twice_clicked(visitor: Any, count: int) -> Any:
    """Draw two signs and teach the demonstration with a double click; return the hand's stroke of the only one new."""
    for number in (1, 2):
        visitor.sign("teach", number, np.array([[0.0, 0.0], [1.0, 0.3], [0.2, 1.0]]))
    visitor.page.locator("#teach-it").dblclick()
    visitor.see("#teach-count", f"Demonstration {count + 1}")
    session = visitor.session()
    assert len(session["demonstrations"]) == count
    return visitor.api(f"sessions/{session['id']}/demonstrations/{count - 1}")["hand"]


def test_back_goes_to_the_view_before_and_another_address_to_another_session(
    visit: Visit, new_session: NewSession
) -> None:
    visitor = visit()
    one, other = new_session(1), new_session()
    visitor.open("teach", one)
    visitor.page.locator("#tab-keep").click()
    expect(visitor.page.locator("#keep")).to_be_visible()
    visitor.page.go_back()
    expect(visitor.page.locator("#teach")).to_be_visible()
    visitor.page.evaluate("(to) => { location.hash = to }", f"keep/{other}")
    visitor.see("#session-facts", "0 demonstrations")
    expect(visitor.page.locator("#keep")).to_be_visible()
