"""A figure is drawn once for each state of its session, whoever looks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from signimit_envs.studio.page.pictures import FigureCache

Json = dict[str, Any]


def test_a_picture_is_made_once_and_the_oldest_go() -> None:
    figures, made = FigureCache(most=2), []

    def make(name: str) -> Callable[[], bytes]:
        def draw() -> bytes:
            made.append(name)
            return name.encode()

        return draw

    for name in ("a", "b", "a", "c", "b", "a"):
        assert figures.find_or_draw(name, make(name)) == name.encode()
    assert made == ["a", "b", "c", "a"]
    assert (figures.find("b"), figures.find("c"), figures.find("a")) == (None, b"c", b"a")


def test_a_figure_is_drawn_again_only_when_the_demonstrations_have_changed(
    page: Any, session: Json, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[int] = []

    def draw(number: int, suffix: str, model: Any, answers: Any) -> bytes:
        drawn.append(len(model.demonstrations))
        return b"%d" % len(drawn)

    monkeypatch.setattr("signimit_envs.studio.web.routes.look.draw_figure", draw)
    base = f"sessions/{session['id']}"

    def look(number: int) -> bytes:
        return bytes(page.ask("GET", f"{base}/figures/{number}.png").content)

    session = page.teach(session, 2)
    assert [look(6), look(6), look(5), look(6)] == [b"1", b"1", b"2", b"1"]
    page.teach(session, 1)
    assert [look(6), look(6)] == [b"3", b"3"]
    assert [look(7), look(7)] == [b"4", b"5"]  # the arm may have gone on
    assert drawn == [2, 2, 3, 3, 3]
