"""The story of a session and the films made of it."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit_envs.exceptions import RenderingError
from signimit_envs.sessions.session import SessionResult
from signimit_envs.video.films import Film, film_grid, film_shots, film_story
from signimit_envs.video.overlays import INK, MARK, PAPER, draw_caption, draw_card, draw_label, draw_signs
from signimit_envs.video.storyboard import (
    CARD_FRAMES,
    FRAME_RATE,
    Shot,
    show_demonstration,
    show_reproduction,
    show_session,
)

SIGN = np.array([[0, 0], [1, 2], [3, 1.0]])


def colours(picture: NDArray[np.uint8]) -> set[tuple[int, ...]]:
    return {tuple(int(c) for c in colour) for colour in np.unique(picture.reshape(-1, 3), axis=0)}


def frames_or_skip(film: Film, count: int) -> list[NDArray[np.uint8]]:
    try:
        return list(itertools.islice(film.frames, count))
    except RenderingError as error:
        pytest.skip(str(error))


def test_the_story_goes_through_the_phases_of_figure_1(result: SessionResult) -> None:
    phases = [phase for phase, _ in itertools.groupby(shot.phase for shot in show_session(result))]
    assert phases == ["A", "B"] * 12 + [""] + ["C", "D"] * 3


def test_the_robot_is_asked_what_was_never_demonstrated(result: SessionResult) -> None:
    asked = dict.fromkeys(s.caption.split(":")[1].strip() for s in show_session(result) if s.phase == "D")
    assert list(asked) == ["triangle up, red", "triangle down, green", "circle, blue"]


def test_a_sign_is_drawn_stroke_by_stroke_after_the_one_before_it(result: SessionResult) -> None:
    demonstration = result.session.demonstrations[0]
    drawn = [tuple(map(len, s.signs)) for s in show_demonstration(result, 0, 1) if s.phase == "A"]
    assert drawn == sorted(drawn)
    assert drawn[0] == (1,)
    assert drawn[-1] == tuple(map(len, demonstration.signs))


def test_the_demonstrators_hand_is_where_it_was_and_leaves_a_trail(result: SessionResult) -> None:
    hand = result.session.demonstrations[3].hand
    moving = [s for s in show_demonstration(result, 3, 1) if s.human_hand is not None]
    for shot in moving:
        assert shot.human_hand is not None
        np.testing.assert_array_equal(shot.human_hand, shot.trail[-1])
    np.testing.assert_array_equal(moving[-1].trail, hand)


def test_the_end_of_an_answer_says_whether_it_was_obeyed(result: SessionResult) -> None:
    for reproduction in result.reproductions[:3]:
        last = list(show_reproduction(result, reproduction))[-1]
        assert last.caption.endswith(": obeyed" if reproduction.obeyed else ": not obeyed")


def test_the_card_tells_what_the_model_understood(result: SessionResult) -> None:
    cards = [shot.card for shot in show_session(result) if shot.card]
    assert len(cards) == CARD_FRAMES
    assert f"The demonstrator knows {len(result.model.movements)} movements:" in cards[0]
    members = ", ".join(str(t + 1) for t in result.model.movements[0].members)
    assert f"    {result.model.names.movement(0)}, in demonstrations {members}" in cards[0]


def test_a_sign_grows_as_it_is_drawn_and_a_dot_marks_the_pen() -> None:
    half, whole = (draw_signs((200, 200), [SIGN[:n]], [SIGN]) for n in (2, 3))
    assert half.shape == (200, 200, 3)
    assert MARK in colours(half)
    assert MARK not in colours(whole)
    assert (whole == INK).all(axis=2).sum() > (half == INK).all(axis=2).sum()


def test_signs_are_drawn_upright() -> None:
    low_and_wide = np.array([[0.5, 1], [0.5, 0], [0, 0], [1.0, 0]])
    ink = (draw_signs((200, 200), [low_and_wide], [low_and_wide]) == INK).all(axis=2)[50:]
    widest = ink.sum(axis=1).argmax()
    assert widest > np.flatnonzero(ink.any(axis=1)).mean()


def test_a_caption_too_long_for_its_line_is_made_smaller() -> None:
    picture = draw_caption((400, 64), "A", "a very long caption " * 3)
    assert (picture[:, -15:] == INK).all()
    assert MARK in colours(picture)


def test_a_card_has_its_lines_on_paper() -> None:
    picture = draw_card((400, 300), ["heading", "", "line"])
    assert (picture[:20] == PAPER).all()
    assert INK in colours(picture)


def test_what_was_never_demonstrated_is_framed() -> None:
    scene = np.zeros((320, 320, 3), np.uint8)
    framed, plain = (draw_label(scene, ["circle, red"], [SIGN], framed=f) for f in (True, False))
    assert (framed[-1] == MARK).all()
    assert not (plain[-1] == MARK).any()


def test_a_frame_of_the_story_holds_signs_scene_and_caption(result: SessionResult) -> None:
    (frame,) = frames_or_skip(film_story(result), 1)
    assert frame.shape == (544, 960, 3)
    assert frame.dtype == np.uint8


def test_the_trail_and_the_demonstrators_hand_can_be_seen() -> None:
    objects = np.array([[-0.2, 0.1], [0.0, 0.1], [0.2, 0.1]])
    trail = np.array([[-0.2, -0.1], [0.2, -0.1]])
    empty = Shot(phase="B", caption="", objects=objects)
    with_hand = Shot(phase="B", caption="", objects=objects, trail=trail, human_hand=trail[-1])
    first, second = frames_or_skip(film_shots([empty, with_hand], 3), 2)
    changed = (first != second).any(axis=2)
    assert 200 < changed.sum() < 20_000
    assert not changed[:, :320].any()


def test_the_robots_hand_is_on_its_trail(result: SessionResult) -> None:
    """Seen from above at the height of the hand as at that of the table: the tip hides the trail's end."""
    answer, objects = result.reproductions[0].answer, result.reproductions[0].command.objects
    shot = Shot(phase="D", caption="", objects=objects, joints=answer.joints[100], trail=answer.path[100:101])
    (frame,) = frames_or_skip(film_shots([shot], 3), 1)
    scene = frame[:480, 320:].astype(int)
    yellow = (scene[..., 0] > 220) & (scene[..., 1] > 180) & (scene[..., 2] < 90)
    row, column = np.argwhere(yellow).mean(axis=0)
    metres = 1.08 / 480
    seen = np.array([(column - 320) * metres, (240 - row) * metres - 0.03])  # the camera is 3 cm nearer to the arm
    np.testing.assert_allclose(seen, answer.path[100], atol=2 * metres)


def test_the_grid_shows_all_pairs_at_once(result: SessionResult) -> None:
    film = film_grid(result)
    assert film.length == result.plan.seconds * FRAME_RATE + 1
    (frame,) = frames_or_skip(film, 1)
    assert frame.shape == (960, 960, 3)
    tiles = frame.reshape(3, 320, 3, 320, 3).swapaxes(1, 2)
    framed = (tiles[:, :, -1] == MARK).all(axis=(2, 3))
    np.testing.assert_array_equal(framed, np.eye(3, dtype=bool))
