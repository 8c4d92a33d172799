"""Sign languages: which sign asks for which object and which movement, at which place of the utterance (II-A)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from signimit.display import one_line
from signimit.exceptions import InvalidInputError


class Request(NamedTuple):
    """A request: what an utterance asks for.

    Attributes:
        movement: Index into `Language.movements`.
        focus: Index of the object.
    """

    movement: int
    focus: int


@one_line
@dataclass(frozen=True, kw_only=True)
class Language:
    """A sign language of the interactant, known to the demonstrator and not to the imitator.

    Attributes:
        focus_signs: Label of the sign that asks for each object.
        movement_signs: Label of the sign that asks for each movement.
        movements: Label of each movement.
        filler_signs: Labels of words that mean nothing, each drawn at random each time; none in the paper.
        fillers: How many such words there are, where there are signs for them.
        focus_word: Place in the utterance of the sign that asks for the object, from 0.
        movement_word: Place of the sign that asks for the movement; fillers take the places that are left.
        prototypes: Labels of the signs that span the sign space.
        unseen: Requests that are never demonstrated. Left out: movement m about object m mod O, the paper's diagonal.
        repetitions: How often each other request is demonstrated.
        rounds: How often a demonstrator draws a movement in one demonstration.
    """

    focus_signs: tuple[str, ...] = ("1", "2", "3")
    movement_signs: tuple[str, ...] = ("4", "5", "6")
    movements: tuple[str, ...] = ("triangle up", "triangle down", "circle")
    filler_signs: tuple[str, ...] = ()
    fillers: int = 1
    focus_word: int = 0
    movement_word: int = 1
    prototypes: tuple[str, ...] = ("7", "8", "9")
    unseen: tuple[Request, ...] | None = None
    repetitions: int = 2
    rounds: int = 2

    def __post_init__(self) -> None:
        """Check that every word has a place and every movement a sign.

        Raises:
            InvalidInputError: If it is not a language.
        """
        if not self.focus_signs or not self.movements:
            raise InvalidInputError("language", "at least one object and one movement", "none")
        if len(self.movement_signs) != len(self.movements):
            raise InvalidInputError(
                "language: movement_signs", f"{len(self.movements)}, one a movement", f"{len(self.movement_signs)}"
            )
        if self.fillers < 1:
            raise InvalidInputError("language: fillers", "at least 1; no filler_signs, no fillers", f"{self.fillers}")
        places = {self.focus_word, self.movement_word}
        if len(places) < 2 or not places <= set(range(self.words)):
            raise InvalidInputError(
                "language: focus_word, movement_word",
                f"two places out of {list(range(self.words))}",
                f"{self.focus_word}, {self.movement_word}",
            )
        if self.rounds < 1:
            raise InvalidInputError("language: rounds", "at least 1", f"{self.rounds}")
        if self.repetitions < 1 or not self.seen:
            raise InvalidInputError("language", "at least one demonstration", f"{len(self.seen)} x {self.repetitions}")

    @property
    def words(self) -> int:
        """Number of signs in an utterance, W."""
        return 2 + (self.fillers if self.filler_signs else 0)

    @property
    def objects(self) -> int:
        """Number of objects, O."""
        return len(self.focus_signs)

    @property
    def signs(self) -> tuple[str, ...]:
        """Labels of all signs that are made in it or span its sign space, once each."""
        words = (*self.focus_signs, *self.movement_signs, *self.filler_signs, *self.prototypes)
        return tuple(dict.fromkeys(words))

    @property
    def requests(self) -> tuple[Request, ...]:
        """Everything that can be asked for, movement by movement."""
        return tuple(Request(m, f) for m in range(len(self.movements)) for f in range(self.objects))

    @property
    def held_back(self) -> frozenset[Request]:
        """The requests that are never demonstrated."""
        if self.unseen is not None:
            return frozenset(Request(*pair) for pair in self.unseen)
        if self.objects == 1:
            return frozenset()
        return frozenset(Request(m, m % self.objects) for m in range(len(self.movements)))

    @property
    def seen(self) -> tuple[Request, ...]:
        """The requests that are demonstrated, each `repetitions` times."""
        return tuple(request for request in self.requests if request not in self.held_back)


PAPER_LANGUAGE = Language()
"""The paper's: first sign the object, second the movement; six of nine requests shown, twice each."""
