"""Events as the journal has them: JSON with the name of the class in lower case and the names of its fields.

Journals of every version are read for ever.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, get_args

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke
from signimit.teaching.languages import Request
from signimit_envs.studio.store.events import DrawnDemonstration, Event, Signs, check_indices

_KINDS: Mapping[str, type[Event]] = {kind.__name__.lower(): kind for kind in get_args(Event)}


def event_to_json(event: Event) -> dict[str, Any]:
    """Return an event as JSON can say it, exactly."""
    values = {field.name: _value_to_json(getattr(event, field.name)) for field in dataclasses.fields(event)}
    return {"event": type(event).__name__.lower(), **values}


def event_from_json(value: Mapping[str, Any]) -> Event:
    """Read what `event_to_json` made.

    Raises:
        InvalidInputError: If it is something else.
    """
    try:
        kind = _KINDS[value["event"]]
        given = [field for field in dataclasses.fields(kind) if field.name in value or _is_needed(field)]
        fields = [(field.name, _READERS.get(str(field.type))) for field in given]
        return kind(**{name: read(value[name]) if read else value[name] for name, read in fields})
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
        if isinstance(error, InvalidInputError):
            raise
        raise InvalidInputError("event", f"one of {', '.join(_KINDS)}, whole", f"{error!r:.80}") from None


def _is_needed(field: dataclasses.Field[Any]) -> bool:
    """Whether every journal has the field: one with a default may be missing, as older ones are without it."""
    return field.default is dataclasses.MISSING


def stroke_to_json(stroke: Stroke) -> dict[str, Any]:
    """Return a stroke as lists of points and of times."""
    return {"points": stroke.points.tolist(), "times": stroke.times.tolist()}


def _value_to_json(value: Any) -> Any:
    if isinstance(value, Stroke):
        return stroke_to_json(value)
    if isinstance(value, DrawnDemonstration):
        return {field.name: _value_to_json(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {name: _value_to_json(item) for name, item in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Request):
        return list(value)
    return [_value_to_json(item) for item in value] if isinstance(value, tuple) else value


def _demonstration_from_json(value: Mapping[str, Any]) -> DrawnDemonstration:
    objects = np.asarray(value["objects"])
    return DrawnDemonstration(
        _strokes_from_json(value["signs"]),
        objects,
        _stroke_from_json(value["hand"]),
        _request_from_json(value["prompt"]),
        value["by"],
    )


def _stroke_from_json(value: Mapping[str, Any]) -> Stroke:
    return Stroke(np.asarray(value["points"]), np.asarray(value["times"]))


def _strokes_from_json(values: Sequence[Mapping[str, Any]]) -> Signs:
    return tuple(_stroke_from_json(value) for value in values)


def _request_from_json(value: Sequence[int] | None) -> Request | None:
    if value is None:
        return None
    movement, focus = value
    check_indices("request", movement, focus)
    return Request(movement, focus)


_READERS: Mapping[str, Callable[[Any], Any]] = {
    "DrawnDemonstration": _demonstration_from_json,
    "tuple[DrawnDemonstration, ...]": lambda values: tuple(map(_demonstration_from_json, values)),
    "Signs": _strokes_from_json,
    "Mapping[str, Signs]": lambda drawn: {place: _strokes_from_json(strokes) for place, strokes in drawn.items()},
    "Request | None": _request_from_json,
}
"""Readers of the fields of events by their declared types; the events check numbers and texts themselves."""
