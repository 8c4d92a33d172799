"""Built-in people of a session: synthetic interactant and demonstrator, the same for the same seed."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from signimit.signs import normalised_sign
from signimit.strokes import Stroke
from signimit.teaching.composition import compose_loops, compose_path, movement_templates
from signimit.teaching.languages import Request
from signimit.teaching.people.casting import Cast, cast_people
from signimit.teaching.scenes import sample_times
from signimit.teaching.stroke_sampler import StrokeSampler
from signimit_envs.studio.page.prompts import LANGUAGES, sign_labels
from signimit_envs.studio.store.events import Signs


def draw_utterance(language: str, seed: int, request: Request, attempt: int) -> Signs:
    """Draw the signs of a request; every attempt is another drawing."""
    spoken, cast = LANGUAGES[language], _cast(language, seed)
    rng, deck = _generator(seed, 4, request, attempt), StrokeSampler(cast.signs)
    return tuple(deck.draw(label, rng)[0] for label in sign_labels(spoken, request))


def draw_answer(
    language: str, seed: int, request: Request, attempt: int, scene: tuple[NDArray[np.float64], NDArray[np.float64]]
) -> Stroke:
    """Draw the movement of a request in a scene of objects (O, 2) and a hand (2,), m."""
    objects, hand = scene
    deck, rng = StrokeSampler(_cast(language, seed).movements), _generator(seed, 5, request, attempt)
    loops = compose_loops(LANGUAGES[language], deck, request.movement, rng)
    path = compose_path(hand, [loop + objects[request.focus] for loop in loops])
    return Stroke(path, sample_times(len(path)))


def examples(language: str, seed: int, request: Request) -> tuple[Sequence[NDArray[np.float64]], NDArray[np.float64]]:
    """Return how the signs and the movement of a request look, each (64, 2), within [-1, 1]."""
    spoken, cast = LANGUAGES[language], _cast(language, seed)
    signs = [normalised_sign(cast.signs.select(label)[0].points) for label in sign_labels(spoken, request)]
    return signs, normalised_sign(cast.movements.select(spoken.movements[request.movement])[0].points)


def templates(language: str, seed: int) -> tuple[tuple[NDArray[np.float64], ...], ...]:
    """Return how the session's built-in demonstrator draws each movement, to judge performances by."""
    rng = np.random.default_rng([seed, 6])
    return movement_templates(LANGUAGES[language], _cast(language, seed).movements, rng)


@functools.lru_cache(maxsize=8)
def _cast(language: str, seed: int) -> Cast:
    """Choose the people of a session."""
    return cast_people(LANGUAGES[language], np.random.default_rng([seed, 3]))


def _generator(seed: int, role: int, request: Request, attempt: int) -> np.random.Generator:
    return np.random.default_rng([seed, role, request.movement, request.focus, attempt])
