"""Films of a session: all of it in order, or one reproduction of every request side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.names import object_name
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
            A copy goes on from where the original is.
        length: Number of frames.
    """

    frames: Iterator[Frame]
    length: int


def film_story(result: SessionResult) -> Film:
    """Film a session: demonstrations, what was understood, and reproductions."""
    return film_shots(list(show_session(result)), result.plan.language.objects)


def film_shots(shots: Sequence[Shot], objects: int) -> Film:
    """Film shots of scenes with ``objects`` objects, in frames of shape (544, 960, 3)."""
    renderer = SceneRenderer(objects, *SCENE_SIZE, orthographic=True)
    return Film(_DrawnFrames(_draw_shot, shots, renderer), len(shots))


def film_grid(result: SessionResult) -> Film:
    """Film the first reproduction of every request side by side: rows are movements, columns objects."""
    first: dict[Request, Reproduction] = {}
    for reproduction in result.reproductions:
        first.setdefault(reproduction.command.request, reproduction)
    steps = min(len(r.answer.path) for r in first.values())
    ends = range(1, min(steps, round(GRID_SECONDS * CONTROL_RATE)) + 1, STRIDE)
    language = result.plan.language
    renderer = SceneRenderer(language.objects, TILE, TILE, orthographic=True)
    return Film(_DrawnFrames(partial(_draw_tiles, list(first.values()), language), ends, renderer), len(ends))


class _DrawnFrames(Iterator[Frame]):
    """Iterator over frames that are drawn as they are taken; unlike a generator it can be copied."""

    def __init__(self, draw: Callable[[Any, SceneRenderer], Frame], moments: Sequence[Any], renderer: SceneRenderer):
        self._draw, self._moments, self._renderer = draw, moments, renderer
        self._count = 0

    def __next__(self) -> Frame:
        if self._count == len(self._moments):
            self._renderer.close()
            raise StopIteration
        self._count += 1
        return self._draw(self._moments[self._count - 1], self._renderer)


def _draw_shot(shot: Shot, renderer: SceneRenderer) -> Frame:
    """Draw a shot: signs to the left, the scene from above to the right, the caption below."""
    width, height = SIGNS_WIDTH + SCENE_SIZE[0], SCENE_SIZE[1]
    caption = draw_caption((width, CAPTION_HEIGHT), shot.phase, shot.caption)
    if shot.card:
        return np.vstack([draw_card((width, height), shot.card), caption])
    signs = draw_signs((SIGNS_WIDTH, height), shot.signs, shot.boxes)
    return np.vstack([np.hstack([signs, renderer.picture(shot)]), caption])


def _draw_tiles(reproductions: Sequence[Reproduction], language: Language, end: int, renderer: SceneRenderer) -> Frame:
    """Draw the grid as it is after ``end`` control steps."""
    tiles = [_draw_tile(r, end, language, renderer) for r in reproductions]
    rows = np.array(tiles).reshape(len(language.movements), language.objects, TILE, TILE, 3)
    return np.ascontiguousarray(rows.swapaxes(1, 2).reshape(len(rows) * TILE, -1, 3))


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
