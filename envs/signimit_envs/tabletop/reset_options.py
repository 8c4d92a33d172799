"""The start of an episode: scene, request and signs, each given in `reset(options=...)` or drawn at random."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.display import one_line
from signimit.signs import SAMPLES, normalised_sign
from signimit.teaching.languages import Request
from signimit.teaching.people.choosing import People
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit.teaching.stroke_sampler import StrokeSource
from signimit.validation import finite_array
from signimit_envs.arm.scene import TABLE, WORKSPACE

OPTIONS = ("movement", "focus", "objects", "hand", "signs")
WORDS = 2  # signs of an utterance in the paper's language (II-A); a filler makes it three


@one_line
class EpisodeStart(NamedTuple):
    """Scene, request and signs that an episode starts from; metres, table frame.

    Attributes:
        request: Movement and object that are asked for.
        objects: Object positions, shape (O, 2), m.
        hand: Position of the hand, shape (2,), m.
        signs: The signs, shape (W, 64, 2), evenly resampled, centred, within [-1, 1].
    """

    request: Request
    objects: NDArray[np.float64]
    hand: NDArray[np.float64]
    signs: NDArray[np.float64]


def draw_episode_start(
    options: Mapping[str, Any] | None, people: People[StrokeSource], objects: int, rng: np.random.Generator
) -> EpisodeStart:
    """Take the start of an episode from the options, and draw what they leave out.

    Args:
        options: Any of movement, focus, objects, hand and signs.
        people: The signer, and the language of the signs.
        objects: Number of objects O.
        rng: Source of everything that is drawn.

    Raises:
        UnknownNameError: If there is no option of that name.
        InvalidInputError: If an option has another type or shape, or lies outside table or workspace.
    """
    given = {name: value for name, value in (options or {}).items() if value is not None}
    for name in given:
        if name not in OPTIONS:
            raise UnknownNameError("reset option", name, OPTIONS)
    request = Request(
        _given_or_random(given.get("movement"), "movement", len(people.language.movements), rng),
        _given_or_random(given.get("focus"), "focus", objects, rng),
    )
    positions = _checked_positions(given["objects"], "objects", (objects, 2), TABLE) if "objects" in given else None
    hand = _checked_positions(given["hand"], "hand", (2,), WORKSPACE) if "hand" in given else None
    signs = _checked_signs(given["signs"], people.language.words) if "signs" in given else None
    return EpisodeStart(
        request,
        sample_scene(rng, objects) if positions is None else positions,
        sample_hand(rng) if hand is None else hand,
        np.stack([normalised_sign(s) for s in people.speak(request, rng)]) if signs is None else signs,
    )


def _given_or_random(value: object, name: str, count: int, rng: np.random.Generator) -> int:
    """Return a number below ``count``: the option, or a random one if there is none."""
    if value is None:
        return int(rng.integers(count))
    whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if not (whole and 0 <= int(value) < count):  # type: ignore[call-overload]
        raise InvalidInputError(f"reset option {name}", f"a whole number from 0 to {count - 1}", repr(value))
    return int(value)  # type: ignore[call-overload, no-any-return]


def _checked_positions(value: Any, name: str, shape: tuple[int, ...], half: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return positions, m, that lie in the rectangle of half sizes ``half`` about the table's centre."""
    points = finite_array(value, f"reset option {name}", shape)
    outside = np.argwhere((np.abs(points) > half + 1e-9).any(axis=-1))
    if len(outside):
        found = points[tuple(outside[0])]
        area = f"positions with |x| <= {half[0]:g} m and |y| <= {half[1]:g} m"
        raise InvalidInputError(f"reset option {name}", area, f"({found[0]:g}, {found[1]:g})")
    return points


def _checked_signs(value: Any, words: int) -> NDArray[np.float64]:
    """Return as many normalised signs, shape (``words``, 64, 2)."""
    try:
        signs = list(value)
    except TypeError:
        signs = []
    if len(signs) != words:
        found = f"{len(signs)}" if signs else type(value).__name__
        raise InvalidInputError("reset option signs", f"{words} strokes of shape (T, 2)", found)
    out = np.empty((words, SAMPLES, 2))
    for number, sign in enumerate(signs):
        try:
            out[number] = normalised_sign(getattr(sign, "points", sign))
        except InvalidInputError as error:
            raise error.inside(f"reset option signs: {number}") from None
    return out
