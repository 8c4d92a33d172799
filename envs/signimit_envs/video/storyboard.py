"""Storyboard of a session: the shots of a film in the phases of the paper's figure 1, not drawn yet.

A: the interactant signs. B: the demonstrator answers. After all demonstrations a card says what the robot understood.
C: the interactant signs again, in a new scene. D: the robot answers. Demonstrations are counted from 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import Demonstration
from signimit.display import one_line
from signimit.explanation import ordinal
from signimit.names import object_name
from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.sessions.session import ArmAnswer, Reproduction, SessionResult

FRAME_RATE = 25  # frames/s of a film
STRIDE = CONTROL_RATE // FRAME_RATE  # control steps a frame
SIGN_FRAMES = 24  # frames in which a sign is drawn
PAUSE_FRAMES = 12  # frames after signs and after a demonstration
CARD_FRAMES = 5 * FRAME_RATE
SPEEDUP = 8  # of all demonstrations but the first
ANSWER_SECONDS = 6.0  # simulated time of a reproduction that is shown
PARKED = np.array([-1.9, 2.4, 2.2])  # rad, joint angles of an arm that only watches
NO_POINTS = np.zeros((0, 2))
for _array in (PARKED, NO_POINTS):
    _array.setflags(write=False)


@one_line
@dataclass(frozen=True, kw_only=True, eq=False)
class Shot:
    """Content of one frame of a film.

    Attributes:
        phase: A, B, C or D of the paper's figure 1; empty for a card.
        caption: Text below the picture.
        signs: The signs as far as they are drawn, each (T, 2), any unit.
        boxes: The complete signs, which fix the scale.
        objects: Object positions, shape (O, 2), m.
        joints: The arm's joint angles, shape (3,), rad.
        human_hand: Position of the demonstrator's hand, shape (2,), m; None where it is not shown.
        trail: Path of the moving hand so far, shape (T, 2), m.
        card: Lines of a card that is shown instead of the scene.
    """

    phase: str
    caption: str
    signs: tuple[NDArray[np.float64], ...] = ()
    boxes: tuple[NDArray[np.float64], ...] = ()
    objects: NDArray[np.float64] = field(default_factory=lambda: NO_POINTS)
    joints: NDArray[np.float64] = field(default_factory=lambda: PARKED)
    human_hand: NDArray[np.float64] | None = None
    trail: NDArray[np.float64] = field(default_factory=lambda: NO_POINTS)
    card: tuple[str, ...] = ()


def show_session(result: SessionResult) -> Iterator[Shot]:
    """Show a session: demonstrations, what was understood, and a reproduction of each request never demonstrated.

    Of several reproductions of a request the first is shown, obeyed or not.
    """
    yield from show_demonstration(result, 0, 1)
    for number in range(1, len(result.session.demonstrations)):
        yield from show_demonstration(result, number, SPEEDUP)
    yield from show_card(result)
    asked, shown = set(), result.plan.language.seen
    for reproduction in result.reproductions:
        request = reproduction.command.request
        if request not in shown and request not in asked:
            asked.add(request)
            yield from show_reproduction(result, reproduction)


def show_demonstration(result: SessionResult, number: int, speedup: int) -> Iterator[Shot]:
    """Show the signs being made (A) and the demonstrator's answer (B), ``speedup`` times faster than they were."""
    demonstrations = result.session.demonstrations
    title = f"Demonstration {number + 1} of {len(demonstrations)}"
    if speedup > 1:
        title += f", {speedup} times faster"
    yield from show_exchange(demonstrations[number], title, speedup)


def show_exchange(demonstration: Demonstration, title: str, speedup: int = 1) -> Iterator[Shot]:
    """Show a demonstration under a title: the signs being made (A), then the demonstrator's answer (B)."""
    scene = Shot(phase="A", caption=f"{title}: the interactant signs", objects=demonstration.objects)
    yield from _signing(scene, demonstration.signs, speedup)
    scene = replace(
        scene,
        phase="B",
        caption=f"{title}: the demonstrator answers, the robot watches",
        signs=demonstration.signs,
        boxes=demonstration.signs,
    )
    for end in _ends(len(demonstration.hand), STRIDE * speedup):
        yield replace(scene, human_hand=demonstration.hand[end - 1], trail=demonstration.hand[:end])
    yield from [replace(scene, trail=demonstration.hand)] * (PAUSE_FRAMES // speedup)


def show_card(result: SessionResult) -> Iterator[Shot]:
    """Show a card with what the robot understood: the groups of movements and the word order of its model."""
    model = result.model
    order = model.word_order
    groups = [", ".join(str(t + 1) for t in movement.members) for movement in model.movements]
    beside = ", ".join(str(t + 1) for t in np.flatnonzero(model.labels < 0))
    lines = (
        "What the robot understood, without having been told anything:",
        "",
        f"The demonstrator knows {len(groups)} movements:",
        *(f"    {model.names.movement(m)}, in demonstrations {members}" for m, members in enumerate(groups)),
        *([f"    none of them in demonstrations {beside}"] if beside else []),
        "",
        f"The {ordinal(order.focus)} sign names the object,",
        f"the {ordinal(order.movement)} sign names the movement.",
    )
    yield from [Shot(phase="", caption="After the demonstrations", card=lines)] * CARD_FRAMES


def show_reproduction(result: SessionResult, reproduction: Reproduction) -> Iterator[Shot]:
    """Show a command being given to the robot (C), and what it does (D)."""
    command, language = reproduction.command, result.plan.language
    shown = "shown in a demonstration" if command.request in language.seen else "never shown in any demonstration"
    asked = f"{language.movements[command.request.movement]}, {object_name(command.request.focus)}"
    verdict = "obeyed" if reproduction.obeyed else "not obeyed"
    captions = f"New scene, a pair of signs {shown}", f"The robot answers. Asked for: {asked}"
    end = round(ANSWER_SECONDS * CONTROL_RATE) + 1
    answer = reproduction.answer._replace(path=reproduction.answer.path[:end], joints=reproduction.answer.joints[:end])
    shots = list(show_answer(command.signs, command.objects, answer, captions))
    yield from shots
    yield from [replace(shots[-1], caption=f"{captions[1]}: {verdict}")] * FRAME_RATE


def show_answer(
    signs: Sequence[NDArray[np.float64]], objects: NDArray[np.float64], answer: ArmAnswer, captions: tuple[str, str]
) -> Iterator[Shot]:
    """Show signs being made to the robot (C), and what it does (D), each with its caption."""
    scene = Shot(phase="C", caption=captions[0], objects=objects, joints=answer.joints[0])
    yield from _signing(scene, signs, 1)
    scene = replace(scene, phase="D", caption=captions[1], signs=tuple(signs), boxes=tuple(signs))
    for end in _ends(len(answer.path), STRIDE):
        yield replace(scene, joints=answer.joints[end - 1], trail=answer.path[:end])


def _signing(scene: Shot, signs: Sequence[NDArray[np.float64]], speedup: int) -> Iterator[Shot]:
    """Draw the signs one after the other, then pause."""
    done: tuple[NDArray[np.float64], ...] = ()
    scene = replace(scene, boxes=tuple(signs))
    for sign in signs:
        for end in _ends(len(sign), max(1, round(len(sign) * speedup / SIGN_FRAMES))):
            yield replace(scene, signs=(*done, sign[:end]))
        done = (*done, sign)
    yield from [replace(scene, signs=done)] * (PAUSE_FRAMES // speedup)


def _ends(length: int, stride: int) -> list[int]:
    """Return for each frame how many samples of a sequence are shown; all of them in the last."""
    return [*range(1, length, stride), length]
