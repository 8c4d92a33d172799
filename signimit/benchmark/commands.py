"""What an entry is asked for in a split: which pairs, in which scenes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.teaching.composition import SceneSampler, compose_utterance
from signimit.teaching.languages import Language, Request
from signimit.teaching.scenes import sample_hand
from signimit.teaching.stroke_sampler import StrokeSampler

PER_UNSEEN_PAIR = 3
AT_MOST = 16  # commands of a session whose language has more pairs
FAMILIES = 3  # counterfactual ones of a session


class Command(NamedTuple):
    """A request made of an entry.

    Attributes:
        request: What is asked for; an entry is not told.
        signs: How, W signs of shape (T_s, 2), m.
        objects: Where the objects are, shape (O, 2), m, table frame.
        hand: Where its hand starts, shape (2,), m, table frame.
        family: Commands of one family differ in one thing only.
    """

    request: Request
    signs: tuple[NDArray[np.float64], ...]
    objects: NDArray[np.float64]
    hand: NDArray[np.float64]
    family: int


class Asking(NamedTuple):
    """Who asks, in which language, in which scenes."""

    language: Language
    signs: StrokeSampler
    scenes: SceneSampler
    rng: np.random.Generator

    def command(self, request: Request, family: int) -> Command:
        """Ask for a pair with fresh signs in a fresh scene."""
        utterance = compose_utterance(self.language, self.signs, *request, self.rng)
        objects = self.scenes(self.rng, self.language.objects)
        return Command(request, utterance, objects, sample_hand(self.rng), family)


Ask = Callable[[Asking], list[Command]]


def ask_every_pair(asking: Asking) -> list[Command]:
    """Ask for every pair once, or for sixteen of them, in random order."""
    return _ask(asking, asking.language.requests)[:AT_MOST]


def ask_unseen_pairs(asking: Asking) -> list[Command]:
    """Ask three times for every pair that was never demonstrated, in random order."""
    return _ask(asking, sorted(asking.language.held_back) * PER_UNSEEN_PAIR)


def _ask(asking: Asking, requests: Sequence[Request]) -> list[Command]:
    order = asking.rng.permutation(len(requests))[:AT_MOST]
    return [asking.command(requests[i], family) for family, i in enumerate(order)]


def ask_counterfactually(asking: Asking) -> list[Command]:
    """Ask in families of four, in random order.

    A family is a command; the same with one sign changed, once the movement's and once the object's; and the same
    signs where the objects have changed places, none staying where it was.
    """
    commands = [command for family in range(FAMILIES) for command in _family(asking, family)]
    return [commands[i] for i in asking.rng.permutation(len(commands))]


def _family(asking: Asking, family: int) -> list[Command]:
    language, rng = asking.language, asking.rng
    first = asking.command(language.requests[int(rng.integers(len(language.requests)))], family)
    movement, focus = first.request
    other_movement = (movement + int(rng.integers(1, len(language.movements)))) % len(language.movements)
    other_focus = (focus + int(rng.integers(1, language.objects))) % language.objects
    moved = np.roll(first.objects, int(rng.integers(1, language.objects)), axis=0)
    return [
        first,
        _changed(asking, first, Request(other_movement, focus), language.movement_word),
        _changed(asking, first, Request(movement, other_focus), language.focus_word),
        first._replace(objects=moved),
    ]


def _changed(asking: Asking, command: Command, request: Request, word: int) -> Command:
    """Ask for something else by changing one sign only, to the same stroke's place."""
    fresh = compose_utterance(asking.language, asking.signs, *request, asking.rng)
    signs = tuple(fresh[w] if w == word else sign for w, sign in enumerate(command.signs))
    return command._replace(request=request, signs=signs)
