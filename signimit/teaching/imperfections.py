"""Imperfections of demonstrations: wrong answers, drawings beside the point, hands that go home, tremble or stop early.

Each takes the demonstrations of a session and their ground truth, and returns both anew. Words and scenes stay; only
the hand does something else. The truth of a spoilt demonstration is what its words ask for.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.policies import CONTROL_PERIOD
from signimit.teaching.composition import GroundTruth, compose_loops, compose_path, draw_loops
from signimit.teaching.scenes import SCENE_HALF_EXTENT, reaching_path, sample_hand, sample_times
from signimit.teaching.stroke_sampler import StrokeSource

TREMOR = 0.0012  # m, amplitude of a hand that trembles
TREMOR_FREQUENCY = (8.0, 12.0)  # Hz, of physiological tremor
SLOW_PERIOD = 0.1  # s between two samples of a slow camera
LEFT_OUT = (0.05, 0.25)  # of a demonstration of two rounds, by who stops early: less than a round
CLEAR = 0.07  # m from every object to the middle of a drawing that is about none: half of how near objects may be


class Imperfection(Protocol):
    """A way in which demonstrations differ from what they should be."""

    def __call__(
        self,
        demonstrations: DemonstrationSet,
        truth: GroundTruth,
        movements: StrokeSource,
        rng: np.random.Generator,
        /,
    ) -> tuple[DemonstrationSet, GroundTruth]:
        """Change demonstrations.

        Args:
            demonstrations: As they should be; they are not changed.
            truth: What they are.
            movements: Strokes of the demonstrator.
            rng: Decides everything.

        Returns:
            The demonstrations as they are, and what is true of them.
        """
        ...


def answer_wrongly(
    demonstrations: DemonstrationSet,
    truth: GroundTruth,
    movements: StrokeSource,
    rng: np.random.Generator,
    /,
    *,
    count: int = 1,
) -> tuple[DemonstrationSet, GroundTruth]:
    """Let the hand do what another request asks for, in so many demonstrations."""
    chosen, hands, language = _choose(truth, count, rng), {}, truth.language
    for t in chosen:
        others = [request for request in language.requests if request != truth.requests[t]]
        movement, focus = others[int(rng.integers(len(others)))]
        loops = compose_loops(language, movements, movement, rng)
        hands[int(t)] = compose_path(sample_hand(rng), [loop + demonstrations[t].objects[focus] for loop in loops])
    return _with_hands(demonstrations, hands), _spoilt(truth, chosen)


def draw_beside_the_point(
    demonstrations: DemonstrationSet,
    truth: GroundTruth,
    movements: StrokeSource,
    rng: np.random.Generator,
    /,
    *,
    labels: tuple[str, ...],
    count: int = 1,
) -> tuple[DemonstrationSet, GroundTruth]:
    """Let the hand draw one of these shapes, which mean nothing, about no object, in so many demonstrations."""
    chosen, hands = _choose(truth, count, rng), {}
    for t in chosen:
        loops = draw_loops(movements, labels[int(rng.integers(len(labels)))], truth.language.rounds, rng)
        place = _sample_empty_place(demonstrations[t].objects, rng)
        hands[int(t)] = compose_path(sample_hand(rng), [loop + place for loop in loops])
    return _with_hands(demonstrations, hands), _spoilt(truth, chosen)


def go_home(
    demonstrations: DemonstrationSet,
    truth: GroundTruth,
    movements: StrokeSource,
    rng: np.random.Generator,
    /,
) -> tuple[DemonstrationSet, GroundTruth]:
    """Let the hand go back to where it began, in every demonstration; nothing is random."""
    hands = {}
    for t, demonstration in enumerate(demonstrations):
        hand = demonstration.hand
        hands[t] = np.concatenate([hand, reaching_path(hand[-1], hand[0])[1:], hand[:1]])
    return _with_hands(demonstrations, hands), truth


def tremble(
    demonstrations: DemonstrationSet,
    truth: GroundTruth,
    movements: StrokeSource,
    rng: np.random.Generator,
    /,
) -> tuple[DemonstrationSet, GroundTruth]:
    """Let every hand tremble, and be seen ten times a second only."""
    changed = []
    for demonstration in demonstrations:
        frequency, phase = rng.uniform(*TREMOR_FREQUENCY, 2), rng.uniform(0.0, 2 * np.pi, 2)
        shaken = TREMOR * np.sin(2 * np.pi * frequency * demonstration.times[:, None] + phase)
        seen = np.arange(0, len(demonstration.hand), round(SLOW_PERIOD / CONTROL_PERIOD))
        hand, times = (demonstration.hand + shaken)[seen], demonstration.times[seen]
        changed.append(Demonstration(demonstration.signs, demonstration.objects, hand, times))
    return DemonstrationSet(changed), truth


def stop_early(
    demonstrations: DemonstrationSet,
    truth: GroundTruth,
    movements: StrokeSource,
    rng: np.random.Generator,
    /,
) -> tuple[DemonstrationSet, GroundTruth]:
    """Let every hand stop before its last round is whole."""
    hands = {}
    for t, demonstration in enumerate(demonstrations):
        length = len(demonstration.hand)
        hands[t] = demonstration.hand[: length - round(rng.uniform(*LEFT_OUT) * length)]
    return _with_hands(demonstrations, hands), truth


def _choose(truth: GroundTruth, count: int, rng: np.random.Generator) -> NDArray[np.int64]:
    """Choose demonstrations that are sound, shape (count,)."""
    sound = np.flatnonzero(truth.sound)
    if not 0 <= count <= len(sound):
        raise InvalidInputError("imperfections", f"at most {len(sound)} demonstrations that are spoilt", f"{count}")
    return np.asarray(rng.choice(sound, count, replace=False))


def _with_hands(demonstrations: DemonstrationSet, hands: Mapping[int, NDArray[np.float64]]) -> DemonstrationSet:
    """Replace hand paths, by the numbers of the demonstrations."""
    changed = list(demonstrations)
    for t, hand in hands.items():
        changed[t] = Demonstration(changed[t].signs, changed[t].objects, hand, sample_times(len(hand)))
    return DemonstrationSet(changed)


def _spoilt(truth: GroundTruth, chosen: NDArray[np.int64]) -> GroundTruth:
    return replace(truth, spoilt=np.sort(np.concatenate([truth.spoilt, chosen])))


def _sample_empty_place(objects: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Draw a place on the table, shape (2,), m, that is near no object."""
    while True:
        place = rng.uniform(-1.0, 1.0, 2) * SCENE_HALF_EXTENT
        if (np.linalg.norm(objects - place, axis=1) >= CLEAR).all():
            return place
