"""Built-in people of a session: synthetic interactant and demonstrator, the same for the same seed."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from signimit.signs import normalised_sign
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.composition import compose_loops, compose_path, movement_templates
from signimit.teaching.languages import Request
from signimit.teaching.people.choosing import People, choose_people
from signimit.teaching.scenes import sample_times
from signimit.teaching.stroke_sampler import StrokeSampler
from signimit_envs.studio.page.prompts import LANGUAGES, sign_labels
from signimit_envs.studio.store.events import Signs


def draw_utterance(language: str, seed: int, request: Request, attempt: int) -> Signs:
    """Draw the signs of a request; every attempt is another drawing."""
    spoken, people = LANGUAGES[language], _people(language, seed)
    rng, sampler = _generator(seed, 4, request, attempt), StrokeSampler(people.signs)
    return tuple(sampler.draw(label, rng) for label in sign_labels(spoken, request))


def draw_answer(
    language: str, seed: int, request: Request, attempt: int, scene: tuple[NDArray[np.float64], NDArray[np.float64]]
) -> Stroke:
    """Draw the movement of a request in a scene of objects (O, 2) and a hand (2,), m."""
    objects, hand = scene
    sampler, rng = StrokeSampler(_people(language, seed).movements), _generator(seed, 5, request, attempt)
    loops = compose_loops(LANGUAGES[language], sampler, request.movement, rng)
    path = compose_path(hand, [loop + objects[request.focus] for loop in loops])
    return Stroke(path, sample_times(len(path)))


def examples(language: str, seed: int, request: Request) -> tuple[Sequence[NDArray[np.float64]], NDArray[np.float64]]:
    """Return how the signs and the movement of a request look, each (64, 2), within [-1, 1]."""
    spoken, people = LANGUAGES[language], _people(language, seed)
    signs = [normalised_sign(people.signs.select(label)[0].points) for label in sign_labels(spoken, request)]
    return signs, normalised_sign(people.movements.select(spoken.movements[request.movement])[0].points)


def templates(language: str, seed: int) -> tuple[tuple[NDArray[np.float64], ...], ...]:
    """Return how the session's built-in demonstrator draws each movement, to judge performances by."""
    rng = np.random.default_rng([seed, 6])
    return movement_templates(LANGUAGES[language], _people(language, seed).movements, rng)


@functools.lru_cache(maxsize=8)
def _people(language: str, seed: int) -> People[StrokeLibrary]:
    """Choose the people of a session."""
    return choose_people(LANGUAGES[language], np.random.default_rng([seed, 3]))


def _generator(seed: int, role: int, request: Request, attempt: int) -> np.random.Generator:
    return np.random.default_rng([seed, role, request.movement, request.focus, attempt])
