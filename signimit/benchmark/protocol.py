"""The interface of benchmark entries: a protocol of three methods, and the records that are passed to them.

An `Entry` sees a `DemonstrationSet`, signs, objects and a hand, nothing else. What was meant reaches only an `Oracle`,
whose maker takes it as an argument of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.teaching.composition import GroundTruth
from signimit.teaching.languages import Request


@one_line
class Observation(NamedTuple):
    """Input of an entry at a control step.

    Attributes:
        hand: Where its hand is, shape (2,), m, table frame.
        velocity: How the hand moved during the last control period, shape (2,), m/s; zero at the first step.
        seconds: Time since `Entry.begin`, s; 0 at the first step.
    """

    hand: NDArray[np.float64]
    velocity: NDArray[np.float64]
    seconds: float


class Entry(Protocol):
    """A learner in the benchmark; made anew for every session.

    An entry may also say what it thinks, to have its stages scored; what it does not say is shown as "-":

    * ``understanding``: a `signimit.learners.base.Understanding` (groups, focus, word order), read after `observe`;
    * ``reading``: a `signimit.learners.base.Reading` of the last utterance, read after each `begin`. Movements are
      numbered as in ``understanding.labels``, so that one without the other says nothing of movements.
    """

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Watch the demonstrations of a session; called once, before anything else."""
        ...

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Receive a command.

        Args:
            signs: The W signs in the order they were made, each of shape (T_s, 2), any unit.
            objects: Object positions, shape (O, 2), m, table frame.
        """
        ...

    def act(self, observation: Observation) -> ArrayLike:
        """Return the velocity of the hand for the next control period, shape (2,), m/s, table frame."""
        ...


@one_line
class Kit(NamedTuple):
    """Arguments of the maker of an entry for a session.

    Attributes:
        prototypes: Signs of the session's signer that span the paper's sign space, each (T_s, 2); they mean nothing.
        rng: For entries that draw at random; the same session gives the same generator.
    """

    prototypes: tuple[NDArray[np.float64], ...]
    rng: np.random.Generator


@one_line
class Truth(NamedTuple):
    """Ground truth of a session, for judges and oracles.

    Attributes:
        shown: Movements and foci of the demonstrations, the language, and the drawings to judge by.
        asked: What each command asks for, in the order in which `Entry.begin` will be called.
    """

    shown: GroundTruth
    asked: tuple[Request, ...]


@dataclass(frozen=True, kw_only=True)
class Entrant:
    """A named entry of the leaderboard: how it is made for a session.

    Attributes:
        name: Short, also the name of its file of results.
        title: What it is, in a few words.
        make: Makes the entry.
        demonstrations: Where the same people shall show more than the split says: how many demonstrations at least.
    """

    name: str
    title: str
    make: Callable[[Kit], Entry]
    demonstrations: int = 0


@dataclass(frozen=True, kw_only=True)
class Oracle:
    """A named entry that is told the ground truth, to show what a stage costs.

    Attributes:
        name: Short, also the name of its file of results.
        title: What it is, and what it is told, in a few words.
        make: Makes the entry, knowing the truth.
        demonstrations: As of `Entrant`.
    """

    name: str
    title: str
    make: Callable[[Kit, Truth], Entry]
    demonstrations: int = 0
