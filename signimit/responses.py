"""What a model finds and answers: movements, and responses to commands (paper, section II-D)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.names import UNNAMED, Names
from signimit.notebook import response_html
from signimit.policies.base import PlacedPolicy


@one_line
class Movement(NamedTuple):
    """A movement that was found: the demonstrations that show it, and their paths seen from their objects.

    Attributes:
        members: Numbers of the demonstrations that show it.
        paths: Their hand paths in the frame of the object they were about, each (T_t, 2), m.
        times: Their time stamps, each (T_t,), s.
    """

    members: tuple[int, ...]
    paths: tuple[NDArray[np.float64], ...]
    times: tuple[NDArray[np.float64], ...]


@one_line
class Response(NamedTuple):
    """The model's answer to a command.

    Attributes:
        movement: Number of the movement that was asked for, an index of ``model.movements``.
        focus: Number of the object that was asked for.
        policy: Velocity, m/s, of a hand at (2,) or hands at (B, 2), m, table frame; ``policy.at(place)`` is the same
            about another place.
        confidence: Probability, in the learner's eyes, that both are right.
        names: What objects and movements are called.
    """

    movement: int
    focus: int
    policy: PlacedPolicy
    confidence: float
    names: Names = UNNAMED

    @property
    def place(self) -> NDArray[np.float64]:
        """The place that was asked for, shape (2,), m, table frame: where the object of the focus is."""
        return self.policy.place

    @property
    def meaning(self) -> str:
        """What was asked for, in words, e.g. "movement 2 (like a circle, clockwise) about the red object"."""
        return self.names.request(self.movement, self.focus)

    def _repr_html_(self) -> str:
        """Say what was asked for and draw what the policy does, as notebooks show it."""
        return response_html(self)


def find_landmarks(demonstrations: DemonstrationSet, focus: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return where the object of each demonstration was, shape (N, 2), m, table frame, read-only.

    Args:
        demonstrations: What was seen, N.
        focus: Number of the object of each, shape (N,); its place is NaN where that is -1.
    """
    places = demonstrations.objects[np.arange(len(focus)), focus]
    places[focus < 0] = np.nan
    places.setflags(write=False)
    return places


def find_movements(
    demonstrations: DemonstrationSet, labels: NDArray[np.int64], landmarks: NDArray[np.float64]
) -> tuple[Movement, ...]:
    """Collect the demonstrations of each movement, seen from their places.

    Args:
        demonstrations: What was seen, N.
        labels: Movement of each, shape (N,), -1 for none.
        landmarks: Place that each was about, shape (N, 2), m, table frame.
    """
    found = []
    for m in range(int(labels.max()) + 1):
        members = tuple(np.flatnonzero(labels == m).tolist())
        paths = tuple(demonstrations[t].hand - landmarks[t] for t in members)
        found.append(Movement(members, paths, tuple(demonstrations[t].times for t in members)))
    return tuple(found)
