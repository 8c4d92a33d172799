"""Language and people of an environment, from the arguments of `gymnasium.make` (JSON types)."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from signimit import InvalidInputError, UnknownNameError
from signimit.teaching.languages import Language, Request
from signimit.teaching.people.choosing import SYNTHETIC, Source
from signimit_envs.arm.scene import check_object_count

MOVEMENTS = ("triangle up", "triangle down", "circle")
_DIGITS = "1234567890"
_FIELDS = tuple(field.name for field in dataclasses.fields(Language))
_NUMBERS = ("fillers", "focus_word", "movement_word", "repetitions", "rounds")


def choose_language(
    language: Language | Mapping[str, Any] | None, objects: int | None, movements: Sequence[str] | None
) -> Language:
    """Return the language of an environment.

    Args:
        language: The language, or its fields by name; left out, `digit_language` of the next two arguments.
        objects: Number of objects; left out, as many as the language has signs for, or 3.
        movements: Labels of the movements; left out, the language's, or the paper's three.

    Raises:
        InvalidInputError: If it is not a language, or contradicts ``objects`` or ``movements``.
        UnknownNameError: If a language has no such field.
    """
    if language is None:
        return digit_language(3 if objects is None else objects, MOVEMENTS if movements is None else movements)
    spoken = language if isinstance(language, Language) else language_from_fields(language)
    if objects not in (None, spoken.objects):
        raise InvalidInputError("objects", f"the {spoken.objects} of the language, or none", f"{objects!r}")
    if movements is not None and tuple(movements) != spoken.movements:
        raise InvalidInputError("movements", f"those of the language, {list(spoken.movements)}", f"{list(movements)}")
    return spoken


def digit_language(objects: int, movements: Sequence[str]) -> Language:
    """Return the language whose signs are digits: first one for the object, then one for the movement.

    Raises:
        InvalidInputError: If there are no movements, or more objects and movements than digits.
    """
    check_object_count(objects)
    words = len(_DIGITS) - objects
    if isinstance(movements, str) or not 1 <= len(movements) <= words:
        found = repr(movements) if isinstance(movements, str) else f"{len(movements)}"
        raise InvalidInputError("movements", f"1 to {words} labels", found)
    return Language(
        focus_signs=tuple(_DIGITS[:objects]),
        movement_signs=tuple(_DIGITS[objects : objects + len(movements)]),
        movements=tuple(movements),
    )


def language_from_fields(fields: Mapping[str, Any]) -> Language:
    """Make a language from its fields in JSON types (lists for tuples).

    Raises:
        InvalidInputError: If a field has another type, or the fields do not make a language.
        UnknownNameError: If there is no such field.
    """
    if not isinstance(fields, Mapping):
        raise InvalidInputError("language", "a Language or a mapping of its fields", type(fields).__name__)
    for name in fields:
        if name not in _FIELDS:
            raise UnknownNameError("field of a language", name, _FIELDS)
    return Language(**{name: _field(name, value) for name, value in fields.items()})


def _field(name: str, value: Any) -> Any:
    """Convert one field of a language from JSON types."""
    if name in _NUMBERS:
        return _whole(value, name)
    if name == "unseen":
        if value is None:
            return None
        requests = []
        for pair in _items(value, name):
            numbers = [_whole(number, name) for number in _items(pair, name)]
            if len(numbers) != len(Request._fields):
                raise InvalidInputError("language: unseen", "pairs of a movement and an object", f"{pair!r:.60}")
            requests.append(Request(*numbers))
        return tuple(requests)
    labels = _items(value, name)
    if not all(isinstance(label, str) for label in labels):
        raise InvalidInputError(f"language: {name}", "labels", f"{value!r:.60}")
    return tuple(labels)


def _whole(value: Any, name: str) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise InvalidInputError(f"language: {name}", "whole numbers", f"{value!r:.60}")
    return value


def _items(value: Any, name: str) -> list[Any]:
    if not isinstance(value, list | tuple):
        raise InvalidInputError(f"language: {name}", "a list", f"{value!r:.60}")
    return list(value)


def choose_person(value: Source | Sequence[str | None] | str | None, role: str) -> Source:
    """Return the source of a person's strokes.

    Args:
        value: File of a stroke library, or the file and a person in it; None for a synthetic person.
        role: ``"signer"`` or ``"mover"``, for the error message.

    Raises:
        InvalidInputError: If it is neither.
    """
    if value is None:
        return SYNTHETIC
    if isinstance(value, str):
        return Source(value)
    parts = list(value) if isinstance(value, list | tuple) else []
    if not 1 <= len(parts) <= 2 or not isinstance(parts[0], str) or not isinstance(parts[-1], str | None):
        raise InvalidInputError(role, "a stroke library file, or that and a person in it", f"{value!r:.60}")
    return Source(*parts)
