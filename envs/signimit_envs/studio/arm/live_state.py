"""Values of the live arm: its task, its state after a control step, and the parts of its track."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.policies import Policy

Array = NDArray[np.float64]


class Task(NamedTuple):
    """An answer that the arm is to carry out.

    Attributes:
        session: Name of the session that asks.
        answer: Number of the answer in it.
        policy: Policy of the movement, in the object's frame.
        focus: Number of the object.
        text: What was understood, in words.
    """

    session: str
    answer: int
    policy: Policy
    focus: int
    text: str


class TrackPart(NamedTuple):
    """A second of the track of an answer, or the rest of it.

    Attributes:
        task: The task that it belongs to.
        first: Number of the control step that the part begins with.
        path: Where the hand was, shape (T, 2), m.
        joints: The joint angles, shape (T, 3), rad.
        objects: Where the objects were, shape (T, O, 2), m.
    """

    task: Task
    first: int
    path: Array
    joints: Array
    objects: Array


@dataclass(frozen=True, eq=False)
class LiveState:
    """The arm and its table after a control step; the arrays are not written to.

    Attributes:
        session: Name of the session whose table it is.
        task: What the arm carries out; none while it rests.
        done: Number of the last answer, if its movement came to its end by itself; none otherwise.
        time: Simulated time since the arm was started, s.
        clock: Time since then on the clock, s.
        joints: Joint angles, shape (3,), rad.
        hand: Position of the hand, shape (2,), m.
        objects: Object positions, shape (O, 2), m.
        trail: Where the hand was, the latest last, m.
        shoved: Whether a push lasts.
        lost: How much of that time was never simulated, as the whole machine was held up, s.
    """

    session: str | None
    task: Task | None
    done: int | None
    time: float
    clock: float
    joints: Array
    hand: Array
    objects: Array
    trail: tuple[tuple[float, float], ...]
    shoved: bool
    lost: float


def is_alike(one: LiveState, other: LiveState) -> bool:
    """Tell whether two states look the same: a frame of the one will do for the other."""
    return (
        one.task is other.task
        and one.done == other.done
        and one.session == other.session
        and np.array_equal(one.objects, other.objects)
        and float(np.abs(one.joints - other.joints).max()) < 1e-5
    )
