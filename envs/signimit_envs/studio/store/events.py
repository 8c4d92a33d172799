"""Events of a session: immutable values, which check what comes from a file.

A session is the list of its events. The journal has the names of classes and fields, so neither may change; a field
that is new has a default, for journals without it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import Demonstration
from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke
from signimit.teaching.languages import Request
from signimit.validation import finite_array, plain_text
from signimit_envs.arm.scene import OBJECT_COUNTS

Signs = tuple[Stroke, ...]
QUESTION = "question"
PLACES = ("sign 1", "sign 2", "hand", QUESTION)  # where a stroke of a draft can be; the last is the first sign in Ask


@dataclass(frozen=True, eq=False)
class DrawnDemonstration:
    """A demonstration with the strokes that it was drawn with.

    Attributes:
        signs: The utterance, any unit, y up.
        objects: Object positions, shape (O, 2), m, table frame; read-only.
        hand: The demonstrator's hand, m, table frame.
        prompt: What was asked for; none where people made up their own signs. Never told to the learner.
        by: Who drew it, e.g. ``"person"``.
    """

    signs: Signs
    objects: NDArray[np.float64]
    hand: Stroke
    prompt: Request | None = None
    by: str = "person"

    def __post_init__(self) -> None:
        """Check what comes from a file.

        Raises:
            InvalidInputError: If the learner could not take it, or ``by`` is no text.
        """
        object.__setattr__(self, "objects", finite_array(self.objects, "objects", (None, 2)))
        plain_text(self.by, "by")
        _ = self.demonstration

    @property
    def demonstration(self) -> Demonstration:
        """What the learner sees of it."""
        return Demonstration(tuple(s.points for s in self.signs), self.objects, self.hand.points, self.hand.times)


@dataclass(frozen=True, eq=False)
class Created:
    """A session began; always the first event.

    Attributes:
        title: What it is called at first.
        created: When, ISO 8601, local time.
        language: Name of the language, or that there is none.
        objects: Objects in a scene.
        seed: Decides scenes, prompts and built-in people.
    """

    title: str
    created: str
    language: str
    objects: int
    seed: int

    def __post_init__(self) -> None:
        """Check what comes from a file.

        Raises:
            InvalidInputError: If it is something else.
        """
        texts = all(isinstance(text, str) for text in (self.title, self.created, self.language))
        if not texts or not all(map(_is_index, (self.objects, self.seed))) or self.objects not in OBJECT_COUNTS:
            found = f"{(self.title, self.created, self.language, self.objects, self.seed)!r:.80}"
            raise InvalidInputError("session", "a title, a time, a language, 2 to 6 objects and a seed", found)
        plain_text(self.title + self.created + self.language, "session")


@dataclass(frozen=True, eq=False)
class Demonstrated:
    """Demonstrations were added at the end."""

    shown: tuple[DrawnDemonstration, ...]


@dataclass(frozen=True, eq=False)
class Redrawn:
    """A demonstration took the place of an earlier one."""

    number: int
    shown: DrawnDemonstration


@dataclass(frozen=True, eq=False)
class Deleted:
    """A demonstration was taken out."""

    number: int


@dataclass(frozen=True, eq=False)
class Drafted:
    """A part of a demonstration or question that is not sent yet was drawn or cleared.

    Attributes:
        number: Of the demonstration that is drawn again; none for a new one.
        drawn: What is drawn now at places out of `PLACES`, one stroke for each time that the pen was down.
    """

    number: int | None
    drawn: Mapping[str, Signs]


@dataclass(frozen=True, eq=False)
class Undone:
    """The last edit was taken back."""


@dataclass(frozen=True, eq=False)
class Redone:
    """The last undo was taken back."""


@dataclass(frozen=True, eq=False)
class Titled:
    """The session was given another title."""

    title: str

    def __post_init__(self) -> None:
        """Check what comes from a file."""
        plain_text(self.title, "title")


@dataclass(frozen=True, eq=False)
class Asked:
    """The arm was asked for something, and understood it so.

    Attributes:
        signs: The utterance.
        movement: Number of the movement understood, in the model's numbering of that moment.
        focus: Number of the object understood.
        confidence: Probability that both are right, by the model.
        request: What a built-in interactant meant; unknown of a person.
        held: Whether the arm asked back instead of moving, as the confidence was too low.
        name: What people called the movement then; empty without a name.
    """

    signs: Signs
    movement: int
    focus: int
    confidence: float
    request: Request | None = None
    held: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        """Check what comes from a file.

        Raises:
            InvalidInputError: If it is something else.
        """
        check_indices("asked: movement, focus", self.movement, self.focus)
        if not 0 <= finite_array(self.confidence, "asked: confidence", ()) <= 1 + 1e-9:
            raise InvalidInputError("asked: confidence", "a probability", f"{self.confidence:g}")
        if not isinstance(self.held, bool):
            raise InvalidInputError("asked: held", "true or false", f"{self.held!r:.40}")
        plain_text(self.name, "asked: name")


@dataclass(frozen=True, eq=False)
class Insisted:
    """A person let the arm do what it had asked back about."""

    number: int


@dataclass(frozen=True, eq=False)
class Named:
    """The movement that a demonstration shows was given a name; an empty one takes the name away."""

    number: int
    name: str

    def __post_init__(self) -> None:
        """Check what comes from a file."""
        plain_text(self.name, "named: name")


@dataclass(frozen=True, eq=False)
class Judged:
    """A person said whether an answer was right; none takes the verdict back."""

    number: int
    good: bool | None

    def __post_init__(self) -> None:
        """Check what comes from a file."""
        if self.good is not None and not isinstance(self.good, bool):
            raise InvalidInputError("judged: good", "true, false or null", f"{self.good!r:.40}")


def _is_index(value: Any) -> bool:
    return type(value) is int and value >= 0


def check_indices(where: str, *values: Any) -> None:
    """Refuse what is no number that counts from 0.

    Raises:
        InvalidInputError: If one is none.
    """
    if not all(map(_is_index, values)):
        raise InvalidInputError(where, "whole numbers, 0 or more", f"{values!r:.80}")


Event = (
    Created | Demonstrated | Redrawn | Deleted | Drafted | Undone | Redone | Titled | Named | Asked | Insisted | Judged
)
