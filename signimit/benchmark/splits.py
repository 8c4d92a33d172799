"""The splits: each is the paper's session with one thing changed, and the same seed is the same people in all."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.casts import Casting, another_style, same_people, strangers, wavering_people
from signimit.benchmark.commands import Ask, ask_counterfactually, ask_every_pair, ask_unseen_pairs
from signimit.benchmark.studies.cells import FILLER_SIGNS, FOCUS_SIGNS, MOVEMENT_SIGNS, SYNTHETIC_MOVEMENTS
from signimit.exceptions import UnknownNameError
from signimit.teaching.composition import SceneSampler
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.scenes import sample_scene

CROWDED = 0.25  # times the usual distances between objects


@dataclass(frozen=True, kw_only=True)
class Split:
    """A kind of sessions.

    Attributes:
        name: What it is called.
        change: What differs from the paper's session, in words.
        language: What is spoken.
        casting: Who takes part.
        shown_scenes: Where objects are in demonstrations.
        asked_scenes: Where objects are in commands.
        ask: What is asked for.
    """

    name: str
    change: str
    language: Language = PAPER_LANGUAGE
    casting: Casting = same_people
    shown_scenes: SceneSampler = sample_scene
    asked_scenes: SceneSampler = sample_scene
    ask: Ask = ask_every_pair


def crowded_scene(rng: np.random.Generator, objects: int) -> NDArray[np.float64]:
    """Draw a scene, and bring all objects nearer to their centre: at least 3.5 cm apart, in each other's drawings."""
    scene = sample_scene(rng, objects)
    centre = scene.mean(axis=0)
    return np.asarray(centre + CROWDED * (scene - centre))


def left_scene(rng: np.random.Generator, objects: int) -> NDArray[np.float64]:
    """Draw a scene with all objects in the left half of the table."""
    while True:
        scene = sample_scene(rng, objects)
        if (scene[:, 0] < 0).all():
            return scene


def right_scene(rng: np.random.Generator, objects: int) -> NDArray[np.float64]:
    """Draw a scene with all objects in the right half of the table."""
    return left_scene(rng, objects) * (-1.0, 1.0)


_LARGE = Language(focus_signs=FOCUS_SIGNS, movement_signs=MOVEMENT_SIGNS, movements=SYNTHETIC_MOVEMENTS, repetitions=1)
_NOT_SHOWN = tuple(pair for pair in _LARGE.requests if sum(pair) % 3)
_ALL = (
    Split(name="paper", change="nothing: six of nine pairs shown twice, all nine asked for"),
    Split(name="unseen-pair", change="only the pairs that were never shown are asked for", ask=ask_unseen_pairs),
    Split(
        name="unseen-scene",
        change="shown in the left half of the table, asked for in the right half",
        shown_scenes=left_scene,
        asked_scenes=right_scene,
    ),
    Split(
        name="unseen-style",
        change="the signer asks with larger, faster and more slanted signs than were shown",
        casting=another_style,
    ),
    Split(
        name="unseen-person",
        change="every sign and movement may be another one's of a crowd, and a stranger asks",
        casting=strangers,
    ),
    Split(
        name="word-order",
        change="the movement is signed first, the object second",
        language=replace(PAPER_LANGUAGE, focus_word=1, movement_word=0),
    ),
    Split(
        name="filler-word",
        change="a third word between the two means nothing, one of three signs at random",
        language=replace(PAPER_LANGUAGE, filler_signs=FILLER_SIGNS, movement_word=2),
    ),
    Split(
        name="many",
        change="8 movements, 6 objects, 16 of 48 pairs shown once, any 16 asked for",
        language=replace(_LARGE, unseen=_NOT_SHOWN),
    ),
    Split(name="few", change="every pair is shown once only", language=replace(PAPER_LANGUAGE, repetitions=1)),
    Split(name="noisy", change="a slow waver in all that is drawn", casting=wavering_people),
    Split(
        name="ambiguous",
        change="objects at a quarter of the usual distances, within each other's drawings",
        shown_scenes=crowded_scene,
        asked_scenes=crowded_scene,
    ),
    Split(
        name="counterfactual",
        change="asked in families: a command, one sign changed, the other one changed, the objects permuted",
        ask=ask_counterfactually,
    ),
)
SPLITS: dict[str, Split] = {split.name: split for split in _ALL}


def get_split(name: str) -> Split:
    """Return the split of that name.

    Raises:
        UnknownNameError: If there is none.
    """
    if name not in SPLITS:
        raise UnknownNameError("split", name, SPLITS)
    return SPLITS[name]


def choose_splits(names: Iterable[str]) -> tuple[Split, ...]:
    """Return the splits of these names, or all if none is named.

    Raises:
        UnknownNameError: If there is none of a name.
    """
    return tuple(get_split(name) for name in dict.fromkeys(names)) or tuple(SPLITS.values())
