"""What was understood, in words."""

from __future__ import annotations

import numpy as np

from signimit.learners.base import Understanding

OBJECT_NAMES = ("red", "green", "blue", "violet", "orange", "teal")
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")


def object_name(index: int) -> str:
    """Return the colour of an object, or its number where colours have run out."""
    return OBJECT_NAMES[index] if index < len(OBJECT_NAMES) else f"number {index}"


def ordinal(position: int) -> str:
    """Return "first" for position 0, and so on."""
    return _ORDINALS[position] if position < len(_ORDINALS) else f"{position + 1}th"


def summarise(understanding: Understanding, objects: int) -> str:
    """Say how many movements there are, who shows which, about what, and what each word and sign means.

    Args:
        understanding: What was inferred.
        objects: Number of objects in a scene.

    Returns:
        Lines of text; demonstrations are numbered from 0.
    """
    labels, focus, order, _ = understanding
    count = int(labels.max()) + 1
    shown = "1 demonstration shows" if len(labels) == 1 else f"{len(labels)} demonstrations show"
    lines = [f"{shown} {count} movement{'s' * (count != 1)}."]
    for m in range(count):
        numbers = np.flatnonzero(labels == m).tolist()
        members = ", ".join(f"{t} (about {object_name(int(focus[t]))})" for t in numbers)
        lines.append(f"  Movement {m}: {_noun(numbers)} {members}.")
    lines.append(
        f"The {ordinal(order.focus)} word names the object, the {ordinal(order.movement)} word names the movement."
    )
    for i in range(objects):
        lines.append(_meaning(order.focus, f"the {object_name(i)} object", np.flatnonzero(focus == i).tolist()))
    for m in range(count):
        lines.append(_meaning(order.movement, f"movement {m}", np.flatnonzero(labels == m).tolist()))
    return "\n".join(lines)


def _meaning(word: int, meaning: str, members: list[int]) -> str:
    if not members:
        return f"  No sign was seen for {meaning}."
    return f"  Signs like the {ordinal(word)} of {_noun(members)} {', '.join(map(str, members))} mean {meaning}."


def _noun(members: list[int]) -> str:
    return "demonstration" if len(members) == 1 else "demonstrations"
