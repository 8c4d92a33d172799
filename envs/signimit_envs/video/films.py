"""Films of a session: all of it in order, or one reproduction of every request side by side."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import closing
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.explanation import object_name
from signimit.teaching.languages import Language, Request
from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.sessions.session import Reproduction, SessionResult
from signimit_envs.video.overlays import draw_caption, draw_card, draw_label, draw_signs
from signimit_envs.video.scene_renderer import SceneRenderer
from signimit_envs.video.storyboard import STRIDE, Shot, show_session

Frame = NDArray[np.uint8]
SCENE_SIZE, SIGNS_WIDTH, CAPTION_HEIGHT = (640, 480), 320, 64  # pixels
TILE = 320  # pixels, side of a reproduction's picture in the grid
GRID_SECONDS = 8.0  # simulated time that the grid shows at most


class Film(NamedTuple):
    """Frames of a film, drawn one by one as they are taken.

    Attributes:
        frames: Frames, each (height, width, 3); taking the first raises a `RenderingError` if there is no OpenGL.
        length: Number of frames.
    """

    frames: Iterator[Frame]
    length: int


def film_story(result: SessionResult) -> Film:
    """Film a session: demonstrations, what was understood, and reproductions."""
    return film_shots(list(show_session(result)), result.plan.language.objects)


def film_shots(shots: Sequence[Shot], objects: int) -> Film:
    """Film shots of scenes with ``objects`` objects, in frames of shape (544, 960, 3)."""
    return Film(_draw_shots(shots, objects), len(shots))


def film_grid(result: SessionResult) -> Film:
    """Film the first reproduction of every request side by side: rows are movements, columns objects."""
    first: dict[Request, Reproduction] = {}
    for reproduction in result.reproductions:
        first.setdefault(reproduction.command.request, reproduction)
    steps = min(len(r.answer.path) for r in first.values())
    ends = range(1, min(steps, round(GRID_SECONDS * CONTROL_RATE)) + 1, STRIDE)
    return Film(_draw_grid(list(first.values()), result.plan.language, ends), len(ends))


def _draw_shots(shots: Sequence[Shot], objects: int) -> Iterator[Frame]:
    """Draw shots: signs to the left, the scene from above to the right, the caption below."""
    width, height = SIGNS_WIDTH + SCENE_SIZE[0], SCENE_SIZE[1]
    with closing(SceneRenderer(objects, *SCENE_SIZE, orthographic=True)) as renderer:
        for shot in shots:
            caption = draw_caption((width, CAPTION_HEIGHT), shot.phase, shot.caption)
            if shot.card:
                yield np.vstack([draw_card((width, height), shot.card), caption])
            else:
                signs = draw_signs((SIGNS_WIDTH, height), shot.signs, shot.boxes)
                yield np.vstack([np.hstack([signs, renderer.picture(shot)]), caption])


def _draw_grid(reproductions: Sequence[Reproduction], language: Language, ends: range) -> Iterator[Frame]:
    """Draw the grid, one frame for each number of control steps in ``ends``."""
    with closing(SceneRenderer(language.objects, TILE, TILE, orthographic=True)) as renderer:
        for end in ends:
            tiles = [_draw_tile(r, end, language, renderer) for r in reproductions]
            rows = np.array(tiles).reshape(len(language.movements), language.objects, TILE, TILE, 3)
            yield np.ascontiguousarray(rows.swapaxes(1, 2).reshape(len(rows) * TILE, -1, 3))


def _draw_tile(reproduction: Reproduction, end: int, language: Language, renderer: SceneRenderer) -> Frame:
    """Draw a reproduction after ``end`` control steps, seen from above, labelled with its request and signs."""
    command = reproduction.command
    shot = Shot(
        phase="D",
        caption="",
        objects=command.objects,
        joints=reproduction.answer.joints[end - 1],
        trail=reproduction.answer.path[:end],
    )
    movement, focus = command.request
    lines = [f"{language.movements[movement]}, {object_name(focus)}"]
    if unseen := command.request not in language.seen:
        lines.append("never demonstrated")
    return draw_label(renderer.picture(shot), lines, command.signs, framed=unseen)
