"""Sessions: demonstrations to learn from, and commands to obey afterwards (paper, section III)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.strokes import Stroke
from signimit.teaching.composition import (
    GroundTruth,
    SceneSampler,
    Strokes,
    compose_demonstrations,
    compose_prototypes,
    compose_utterance,
)
from signimit.teaching.imperfections import Imperfection
from signimit.teaching.languages import PAPER_LANGUAGE, Language, Request
from signimit.teaching.people.choosing import People, PeopleChooser, same_people
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit.teaching.stroke_sampler import StrokeSource, SynonymSource, as_source

MOST_COMMANDS = 16  # of a session whose language has more pairs


@one_line
class Command(NamedTuple):
    """A request made of the imitator, in a scene.

    Attributes:
        request: What is asked for; the imitator is not told.
        signs: The utterance, W signs of shape (T_s, 2), any unit.
        objects: Where the objects are, shape (O, 2), m, table frame.
        hand: Where the hand starts, shape (2,), m, table frame.
        family: Commands of one family differ in one thing only.
    """

    request: Request
    signs: tuple[NDArray[np.float64], ...]
    objects: NDArray[np.float64]
    hand: NDArray[np.float64]
    family: int = 0


@one_line
class Asker(NamedTuple):
    """A signer who gives commands.

    Attributes:
        language: What the signer speaks.
        signs: Strokes of the signer.
        scenes: Draws where the objects are.
        rng: Decides everything.
    """

    language: Language
    signs: StrokeSource
    scenes: SceneSampler
    rng: np.random.Generator

    def command(self, request: Request, family: int = 0) -> Command:
        """Ask for a pair with fresh signs, in a fresh scene."""
        utterance = compose_utterance(self.language, self.signs, *request, self.rng)
        objects = self.scenes(self.rng, self.language.objects)
        return Command(request, utterance, objects, sample_hand(self.rng), family)


Ask = Callable[[Asker], Sequence[Command]]


def ask_at_random(asker: Asker, requests: Sequence[Request], most: int = MOST_COMMANDS) -> list[Command]:
    """Ask for so many of these pairs, in random order."""
    order = asker.rng.permutation(len(requests))[:most]
    return [asker.command(requests[i], family) for family, i in enumerate(order)]


def ask_every_pair(asker: Asker) -> list[Command]:
    """Ask for every pair once, or for sixteen of them, in random order."""
    return ask_at_random(asker, asker.language.requests)


def ask_in_order(asker: Asker, attempts: int = 1) -> list[Command]:
    """Ask for every pair so many times in a row, movement by movement."""
    return [asker.command(request) for request in asker.language.requests for _ in range(attempts)]


@one_line
@dataclass(frozen=True, kw_only=True)
class Condition:
    """A kind of sessions: the paper's, or one that differs from it.

    Attributes:
        name: What it is called.
        change: What differs from the paper's session, in words.
        language: What is spoken.
        choose_people: Chooses who takes part.
        shown_scenes: Draws where objects are in demonstrations.
        asked_scenes: Draws where objects are in commands.
        ask: Gives the commands.
        shown_times: How often each request is demonstrated; left out, `Language.repetitions` times.
        imperfections: What people do otherwise than they should, one after the other.
        synonyms: Signs that are written in two ways, in turn, and the label of the second way.
    """

    name: str = "paper"
    change: str = "nothing"
    language: Language = PAPER_LANGUAGE
    choose_people: PeopleChooser = same_people
    shown_scenes: SceneSampler = sample_scene
    asked_scenes: SceneSampler = sample_scene
    ask: Ask = ask_every_pair
    shown_times: Callable[[Request], int] | None = None
    imperfections: tuple[Imperfection, ...] = ()
    synonyms: tuple[tuple[str, str], ...] = ()

    def written(self, signs: Strokes) -> StrokeSource:
        """Return the signer's strokes, some signs in two ways where there are synonyms."""
        source = as_source(signs)
        return SynonymSource(source, dict(self.synonyms)) if self.synonyms else source

    def make_imperfect(
        self, demonstrations: DemonstrationSet, truth: GroundTruth, movements: StrokeSource, rng: np.random.Generator
    ) -> tuple[DemonstrationSet, GroundTruth]:
        """Let people do otherwise than they should in a session's demonstrations."""
        for imperfection in self.imperfections:
            demonstrations, truth = imperfection(demonstrations, truth, movements, rng)
        return demonstrations, truth


@one_line
@dataclass(frozen=True, eq=False, kw_only=True)
class Session:
    """What happens in a session, and what was meant.

    Attributes:
        condition: Its kind.
        seed: Its number.
        demonstrations: What the imitator sees.
        prototypes: Signs that span the paper's sign space.
        truth: What the demonstrations were; for judges and oracles only.
        commands: What the imitator is asked for, in order.
    """

    condition: Condition
    seed: int
    demonstrations: DemonstrationSet
    prototypes: tuple[Stroke, ...]
    truth: GroundTruth
    commands: tuple[Command, ...]


def compose_session(
    condition: Condition,
    seed: int,
    people: People[Strokes],
    rng: np.random.Generator,
    *,
    asking_rng: np.random.Generator | None = None,
    prototypes: tuple[Stroke, ...] | None = None,
) -> Session:
    """Compose a session: demonstrations, prototype signs, and the commands that follow.

    Args:
        condition: Its kind.
        seed: Its number; ``people`` and ``rng`` were made from it.
        people: Who takes part.
        rng: Decides everything that happens.
        asking_rng: Decides what happens in commands; left out, ``rng`` does.
        prototypes: Signs that span the sign space; left out, the signer draws them after the demonstrations.

    Raises:
        UnknownNameError: If the people cannot draw what the language needs.
    """
    language, signs, movements = condition.language, condition.written(people.signs), as_source(people.movements)
    times = condition.shown_times
    shown = language if times is None else replace(language, repetitions=max(map(times, language.seen)))
    demonstrations, truth = compose_demonstrations(shown, signs, movements, rng, condition.shown_scenes)
    if times is not None:
        demonstrations, truth = _keep_first(demonstrations, truth, times)
    demonstrations, truth = condition.make_imperfect(demonstrations, truth, movements, rng)
    if prototypes is None:
        prototypes = compose_prototypes(language, signs, rng)
    asking = signs if people.asking is None else as_source(people.asking)
    commands = condition.ask(Asker(language, asking, condition.asked_scenes, asking_rng or rng))
    return Session(
        condition=condition,
        seed=seed,
        demonstrations=demonstrations,
        prototypes=prototypes,
        truth=truth,
        commands=tuple(commands),
    )


def _keep_first(
    demonstrations: DemonstrationSet, truth: GroundTruth, times: Callable[[Request], int]
) -> tuple[DemonstrationSet, GroundTruth]:
    """Keep the first so many demonstrations of each request."""
    kept, counts = [], Counter[Request]()
    for t, request in enumerate(truth.requests):
        counts[request] += 1
        if counts[request] <= times(request):
            kept.append(t)
    return DemonstrationSet([demonstrations[t] for t in kept]), truth.select(np.array(kept))
