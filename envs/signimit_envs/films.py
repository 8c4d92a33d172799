"""Films of a session: its story, and one answer to every pair of signs at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import closing

import numpy as np
from numpy.typing import NDArray

from signimit.languages import Request
from signimit.summary import object_name
from signimit_envs.panels import draw_caption, draw_card, draw_label, draw_signs
from signimit_envs.session import Reproduction, SessionResult
from signimit_envs.stage import Stage
from signimit_envs.storyboard import FRAME_RATE, STRIDE, Shot, tell_story

Frame = NDArray[np.uint8]
SCENE_SIZE, SIGNS_WIDTH, CAPTION_HEIGHT = (640, 480), 320, 64  # pixels
TILE = 320  # pixels
GRID_SECONDS = 8.0


def film_story(result: SessionResult) -> Iterator[Frame]:
    """Draw the story of a session, frame by frame.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    return film_shots(tell_story(result), result.session.plan.language.objects)


def film_shots(shots: Iterable[Shot], objects: int) -> Iterator[Frame]:
    """Draw shots of scenes with so many objects, each frame (544, 960, 3).

    Raises:
        RenderingError: If there is no OpenGL.
    """
    with closing(Stage(objects, *SCENE_SIZE)) as stage:
        for shot in shots:
            yield draw_shot(shot, stage)


def draw_shot(shot: Shot, stage: Stage) -> Frame:
    """Draw a shot: signs to the left, the scene to the right, the caption below."""
    width, height = SIGNS_WIDTH + SCENE_SIZE[0], SCENE_SIZE[1]
    caption = draw_caption((width, CAPTION_HEIGHT), shot.phase, shot.caption)
    if shot.card:
        return np.vstack([draw_card((width, height), shot.card), caption])
    signs = draw_signs((SIGNS_WIDTH, height), shot.signs, shot.boxes)
    return np.vstack([np.hstack([signs, stage.picture(shot, "perspective")]), caption])


def film_grid(result: SessionResult) -> Iterator[Frame]:
    """Draw the first answer to every pair of signs, all at once, rows movements and columns objects.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    language = result.session.plan.language
    first: dict[Request, Reproduction] = {}
    for reproduction in result.reproductions:
        first.setdefault(reproduction.command.request, reproduction)
    steps = min(len(r.answer.path) for r in first.values())
    with closing(Stage(language.objects, TILE, TILE)) as stage:
        for end in range(1, min(steps, round(GRID_SECONDS * FRAME_RATE * STRIDE)) + 1, STRIDE):
            tiles = [_tile(first[request], end, language.movements[request.movement], stage) for request in first]
            rows = np.array(tiles).reshape(len(language.movements), language.objects, TILE, TILE, 3)
            yield np.ascontiguousarray(rows.swapaxes(1, 2).reshape(len(rows) * TILE, -1, 3))


def _tile(reproduction: Reproduction, end: int, movement: str, stage: Stage) -> Frame:
    command = reproduction.command
    shot = Shot(
        phase="D",
        caption="",
        objects=command.scene.objects,
        joints=reproduction.answer.joints[end - 1],
        trail=reproduction.answer.path[:end],
    )
    lines = [f"{movement}, {object_name(command.request.focus)}"]
    if not command.seen:
        lines.append("never demonstrated")
    return draw_label(stage.picture(shot, "top"), lines, command.signs, framed=not command.seen)
