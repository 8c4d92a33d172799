"""A figure is drawn once for each state of its session, whoever looks."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from signimit import Demonstration, DemonstrationSet, InvalidInputError, Stroke
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page import pictures
from signimit_envs.studio.page.pictures import (
    FigureCache,
    draw_figure,
    film_answer,
    film_demonstration,
    similarities_json,
)
from signimit_envs.studio.store.events import Asked, DrawnDemonstration
from signimit_envs.studio.store.history import Answer
from signimit_envs.video.storyboard import FRAME_RATE

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

    def draw(number: int, suffix: str, model: Any, answers: Any, look: str) -> bytes:
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


def _drawn(points: int, objects: int = 3) -> DrawnDemonstration:
    turn = np.linspace(0, 12, points)
    stroke = Stroke(0.1 * np.column_stack([np.sin(turn), np.cos(turn)]), np.linspace(0, 100, points))
    return DrawnDemonstration((stroke, stroke), np.arange(2.0 * objects).reshape(-1, 2) / 20, stroke)


@pytest.mark.parametrize(("count", "points", "objects", "compared"), [(12, 300, 3, 300), (60, LIMITS.points, 6, 166)])
def test_long_paths_are_compared_at_so_many_points_that_it_takes_seconds(
    count: int, points: int, objects: int, compared: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    lengths: set[int] = set()

    def measure(paths: Any, places: Any) -> Any:
        lengths.update(map(len, paths))
        assert all((path[[0, -1]] == _drawn(points).hand.points[[0, -1]]).all() for path in paths)
        return np.ones((count, count, objects, objects))

    monkeypatch.setattr(pictures, "policy_distances", measure)
    demonstrations = DemonstrationSet([_drawn(points, objects).demonstration] * count)
    similarities_json(SimpleNamespace(demonstrations=demonstrations, labels=np.zeros(count, int)))  # type: ignore[arg-type]
    assert lengths == {compared}


def test_thinned_paths_are_as_similar_as_whole_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    turn, objects = np.linspace(0, 12, 2000), _drawn(9).objects
    shapes = (np.sin(turn), np.sin(2 * turn), np.sin(3 * turn))
    paths = [0.1 * np.column_stack([shape, np.cos(turn)]) for shape in shapes]
    drawn = [replace(_drawn(9), hand=Stroke(path, turn)) for path in paths]
    demonstrations = DemonstrationSet(one.demonstration for one in drawn)
    model: Any = SimpleNamespace(demonstrations=demonstrations, labels=np.zeros(3, int))
    whole = similarities_json(model)["maximum"]
    monkeypatch.setattr(pictures, "_COMPARED", len(drawn) * len(objects) * 400)
    np.testing.assert_allclose(similarities_json(model)["maximum"], whole, rtol=0.1)


def test_a_long_demonstration_is_filmed_in_so_many_frames_that_it_takes_seconds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    films: list[list[Any]] = []

    def film(shots: Any, objects: int) -> bytes:
        films.append(list(shots))
        return b""

    monkeypatch.setattr(pictures, "_film", film)
    for points in (300, LIMITS.points):
        film_demonstration(_drawn(points), 0)
    short, long = films
    assert len(short) < len(long) < 30 * FRAME_RATE
    assert short[-1].caption == "Demonstration 1: the demonstrator answers, the robot watches"
    assert long[-1].caption == "Demonstration 1, 5 times as fast: the demonstrator answers, the robot watches"
    assert len(long[-1].trail) == LIMITS.points


def test_demonstrations_of_no_movement_are_compared_last() -> None:
    turn = np.linspace(0, 2 * np.pi, 40)
    circle = 0.1 * np.column_stack([np.cos(turn), np.sin(turn)])
    shown = Demonstration((circle, circle), np.zeros((1, 2)), circle, np.linspace(0.0, 2.0, 40))
    model = SimpleNamespace(demonstrations=DemonstrationSet([shown] * 4), labels=np.array([-1, 1, 0, -1]))
    found = similarities_json(model)  # type: ignore[arg-type]
    assert found["order"] == [2, 1, 0, 3]
    assert found["labels"] == [-1, 1, 0, -1]


def test_a_figure_for_a_dark_page_is_dark_and_no_less_is_seen_in_it() -> None:
    pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")
    shown = DemonstrationSet([_drawn(20).demonstration] * 2)
    model: Any = SimpleNamespace(demonstrations=shown, labels=np.zeros(2, int), focus=np.zeros(2, int))
    light, dark = (
        np.asarray(Image.open(io.BytesIO(draw_figure(4, "png", model, (), look))).convert("L"), float)
        for look in ("light", "dark")
    )
    assert np.median(light) > 250
    assert np.median(dark) < 40
    assert np.mean(np.abs(dark - np.median(dark)) > 60) > 0.7 * np.mean(np.abs(light - np.median(light)) > 60)


def test_a_track_that_does_not_fit_its_answer_is_told_in_a_sentence() -> None:
    """A file may say anything: a hand without an arm, or fewer objects than the answer is about."""
    answer = Answer(Asked(_drawn(20).signs, 0, 1, 1.0))
    track = [{"first": 0, "rate": 50, "path": [[0.0, 0.0], [0.1, 0.0]], "objects": [[[0.1, 0.1]]] * 2}]
    with pytest.raises(
        InvalidInputError, match="answer: expected a movement of the arm with joints, found one without"
    ):
        film_answer(answer, track)
    model: Any = SimpleNamespace(demonstrations=())
    with pytest.raises(InvalidInputError, match="answer: expected a movement of the arm among the session's objects"):
        draw_figure(7, "png", model, [(answer, track)])
