"""Messages of the page, of HTTP and of the socket, as pydantic models."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from signimit.exceptions import InvalidInputError
from signimit.io.formats.pen_clock import spread_ties
from signimit.strokes import Stroke
from signimit.teaching.languages import Request
from signimit_envs.arm.scene import OBJECT_COUNTS, TABLE
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.store.events import Drafted, Signs

_WORDS = 2


def _printable(text: str) -> str:
    if not text.isprintable():
        raise ValueError("characters that can be printed only")
    return text


Coordinate = Annotated[float, Field(ge=-LIMITS.coordinate, le=LIMITS.coordinate)]
Seconds = Annotated[float, Field(ge=0, le=LIMITS.coordinate * 1e6)]
Point = tuple[Coordinate, Coordinate]
Revision = Annotated[int, Field(ge=0, le=10 * LIMITS.events)]
Title = Annotated[str, Field(max_length=LIMITS.title), AfterValidator(_printable)]
Number = Annotated[int, Field(ge=0, le=LIMITS.answers)]


class Strict(BaseModel):
    """A message with these fields and no others."""

    model_config = ConfigDict(extra="forbid", strict=False, allow_inf_nan=False)


class StrokeMessage(Strict):
    """A stroke as it was drawn."""

    points: Annotated[list[Point], Field(min_length=2, max_length=LIMITS.points)]
    times: Annotated[list[Seconds], Field(min_length=2, max_length=LIMITS.points)]

    def stroke(self, where: str) -> Stroke:
        """Return the stroke, times from 0; points that share a time stamp share the time to the next.

        Raises:
            InvalidInputError: If it does not move, its clock runs backwards, or it lasts too long.
        """
        try:
            times = spread_ties(np.array(self.times))
            stroke = Stroke(np.array(self.points), times - times[0])
        except InvalidInputError as error:
            raise error.inside(where) from None
        if stroke.times[-1] > LIMITS.seconds:
            raise InvalidInputError(where, f"at most {LIMITS.seconds:g} s", f"{stroke.times[-1]:g} s")
        return stroke


Place = Literal["sign 1", "sign 2", "hand", "question"]
Drawing = Annotated[list[StrokeMessage], Field(max_length=LIMITS.lifts)]
Utterance = Annotated[list[StrokeMessage], Field(min_length=_WORDS, max_length=_WORDS)]


def signs_of(utterance: list[StrokeMessage]) -> Signs:
    """Return the signs of an utterance."""
    return tuple(message.stroke(f"sign {word}") for word, message in enumerate(utterance, 1))


class NewSession(Strict):
    """POST api/sessions."""

    title: Title = ""
    language: Annotated[str, Field(max_length=LIMITS.title)] = "paper"
    objects: Annotated[int, Field(ge=OBJECT_COUNTS[0], le=OBJECT_COUNTS[-1])] = 3
    seed: Annotated[int, Field(ge=0, lt=2**32)] | None = None


class Revised(Strict):
    """A change without anything else to say."""

    revision: Revision


class NewTitle(Revised):
    """POST title."""

    title: Title


class Merge(Revised):
    """POST merge."""

    other: Annotated[str, Field(max_length=64)]


class NewDemonstration(Revised):
    """POST and PUT demonstrations."""

    signs: Utterance
    hand: StrokeMessage
    prompted: bool = True  # whether it is what the prompt asked for
    by: Literal["person", "built-in people", "person and built-in people"] = "person"

    def hand_stroke(self) -> Stroke:
        """Return the hand's path.

        Raises:
            InvalidInputError: If it is none, or leaves the table.
        """
        return _over_table(self.hand.stroke("hand"))


class NewDraft(Revised):
    """PUT draft."""

    number: Number | None = None
    drawn: Annotated[dict[Place, Drawing], Field(min_length=1)]

    def event(self) -> Drafted:
        """Return the change of the draft.

        Raises:
            InvalidInputError: If a stroke is none, or there are too many or too long ones at a place.
        """
        strokes: dict[str, Signs] = {
            place: tuple(part.stroke(place) for part in parts) for place, parts in self.drawn.items()
        }
        for place, parts in strokes.items():
            if sum(len(part.times) for part in parts) > LIMITS.points:
                raise InvalidInputError(place, f"at most {LIMITS.points} points", "more")
        for part in strokes.get("hand", ()):
            _over_table(part)
        return Drafted(self.number, strokes)


def _over_table(hand: Stroke) -> Stroke:
    if (np.abs(hand.points) > TABLE + 0.2).any():
        raise InvalidInputError("hand", "positions over the table, m", "others")
    return hand


class RequestMessage(Strict):
    """A movement about an object."""

    movement: Number
    focus: Number

    def request(self) -> Request:
        """Return it."""
        return Request(self.movement, self.focus)


class PeopleRequest(RequestMessage):
    """POST people."""

    part: Literal["signs", "movement"]
    attempt: Annotated[int, Field(ge=0, lt=2**32)] = 0


class Ask(Strict):
    """POST ask."""

    signs: Utterance
    request: RequestMessage | None = None


class NewVerdict(Strict):
    """POST verdict."""

    good: bool | None


class Watch(Strict):
    """Socket: send frames, or do not."""

    type: Literal["watch"]
    on: bool


class Drag(Strict):
    """Socket: an object is dragged."""

    type: Literal["drag"]
    object: Annotated[int, Field(ge=0, lt=LIMITS.objects)]
    to: Point


class Shove(Strict):
    """Socket: the hand is shoved."""

    type: Literal["shove"]
    velocity: Point


SocketMessage = Watch | Drag | Shove
_SOCKET: TypeAdapter[SocketMessage] = TypeAdapter(Annotated[SocketMessage, Field(discriminator="type")])


def read_socket_message(text: str) -> SocketMessage:
    """Read a message of the socket.

    Raises:
        InvalidInputError: If it is none.
    """
    try:
        return _SOCKET.validate_python(json.loads(text))
    except ValidationError as error:
        raise InvalidInputError("message", "watch, drag or shove", describe_errors(error.errors())) from None
    except (ValueError, RecursionError):
        raise InvalidInputError("message", "JSON", f"{text[:40]!r}") from None


def printable(sentence: str) -> str:
    """Return a sentence that may quote what was sent, cut, and without what a terminal that shows the log obeys."""
    whole = sentence if len(sentence) <= LIMITS.sentence else f"{sentence[: LIMITS.sentence]} ..."
    return "".join(mark if mark.isprintable() else repr(mark)[1:-1] for mark in whole)


def describe_errors(errors: Any) -> str:
    """Return the first of pydantic's errors as a phrase."""
    first = errors[0]
    place = ".".join(str(part) for part in first["loc"] if part != "body")
    return f"{place}: {first['msg']}" if place else str(first["msg"])
