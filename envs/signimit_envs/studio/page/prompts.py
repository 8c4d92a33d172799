"""Prompts: languages of the studio, the request to demonstrate next, and its sentence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from signimit.exceptions import UnknownNameError
from signimit.names import object_name
from signimit.teaching.languages import PAPER_LANGUAGE, Language, Request

FREE = "free"
LANGUAGES: Mapping[str, Language] = MappingProxyType(
    {
        "paper": PAPER_LANGUAGE,
        "movement first": Language(focus_word=1, movement_word=0),
        "five movements": Language(
            movement_signs=("4", "5", "6", "7", "8"),
            movements=("triangle up", "triangle down", "circle", "square", "figure eight"),
            prototypes=("9", "0"),
        ),
    }
)


class NextRequest(NamedTuple):
    """The request to demonstrate next.

    Attributes:
        request: What the interactant is to ask for.
        left: How many requests of the language wait, this one counted; 0 if all were demonstrated.
    """

    request: Request
    left: int


def get_language(name: str) -> Language | None:
    """Return the language of that name; none for made-up signs.

    Raises:
        UnknownNameError: If there is none.
    """
    if name == FREE:
        return None
    if name not in LANGUAGES:
        raise UnknownNameError("language", name, (*LANGUAGES, FREE))
    return LANGUAGES[name]


def next_request(language: Language, seed: int, prompts: Sequence[Request | None]) -> NextRequest:
    """Return the first request that was not demonstrated yet; after the last they begin again.

    Args:
        language: What is spoken.
        seed: The session's; decides the order.
        prompts: What was demonstrated already.
    """
    rng = np.random.default_rng([seed, 2])
    order = [language.seen[i] for _ in range(language.repetitions) for i in rng.permutation(len(language.seen))]
    done, waiting = Counter(prompts), []
    for request in order:
        if done[request] > 0:
            done[request] -= 1
        else:
            waiting.append(request)
    return NextRequest(waiting[0], len(waiting)) if waiting else NextRequest(order[len(prompts) % len(order)], 0)


def sign_labels(language: Language, request: Request) -> tuple[str, str]:
    """Return the labels of the two signs that make a request, in the order they are made."""
    words = (language.focus_signs[request.focus], language.movement_signs[request.movement])
    return words if language.focus_word < language.movement_word else (words[1], words[0])


def prompt_text(language: Language, request: Request) -> str:
    """Say what to draw, e.g. "Sign 1, then 6. Then draw a circle about the red object; once is enough."."""
    first, second = sign_labels(language, request)
    movement = language.movements[request.movement]
    about = f"about the {object_name(request.focus)} object; once is enough."
    return f"Sign {first}, then {second}. Then draw a {movement} {about}"
