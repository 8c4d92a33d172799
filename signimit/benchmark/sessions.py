"""Sessions of a split, composed from a seed. What is evaluated went through `frozen` in addition."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.commands import Asking, Command
from signimit.benchmark.splits import Split
from signimit.demonstrations import DemonstrationSet
from signimit.teaching.composition import GroundTruth, compose_demonstrations, compose_prototypes
from signimit.teaching.stroke_sampler import StrokeSampler

RECIPE = 1  # changes when the same seed gives another session
SAMPLES = 16  # drawings of each label by each person
_WHO, _HOW, _SHOWN, _ASKED, _MORE_HOW, _MORE_SHOWN = range(6)  # independent streams of random numbers


@dataclass(frozen=True, eq=False, kw_only=True)
class BenchmarkSession:
    """What happens in a session, and what was meant.

    Attributes:
        split: Its kind.
        seed: Its number.
        demonstrations: What an entry sees.
        prototypes: Signs that span the paper's sign space, each (T_s, 2).
        truth: What the demonstrations were. For judges and oracles.
        commands: What an entry is asked for, in order.
    """

    split: Split
    seed: int
    demonstrations: DemonstrationSet
    prototypes: tuple[NDArray[np.float64], ...]
    truth: GroundTruth
    commands: tuple[Command, ...]


def compose_session(split: Split, seed: int) -> BenchmarkSession:
    """Compose a session; the same split and seed give the same one, up to the last digits of other processors."""
    cast = split.casting(split.language, SAMPLES, _stream(seed, _WHO), _stream(seed, _HOW))
    signs, rng = StrokeSampler(cast.signs), _stream(seed, _SHOWN)
    demonstrations, truth = compose_demonstrations(split.language, signs, cast.movements, rng, split.shown_scenes)
    prototypes = tuple(p.points for p in compose_prototypes(split.language, signs, rng))
    asking = signs if cast.asking is cast.signs else StrokeSampler(cast.asking)
    commands = split.ask(Asking(split.language, asking, split.asked_scenes, _stream(seed, _ASKED)))
    return BenchmarkSession(
        split=split,
        seed=seed,
        demonstrations=demonstrations,
        prototypes=prototypes,
        truth=truth,
        commands=tuple(commands),
    )


class Lesson(NamedTuple):
    """Demonstrations, and what they were."""

    demonstrations: DemonstrationSet
    truth: GroundTruth


def with_more_demonstrations(session: BenchmarkSession, count: int) -> Lesson:
    """Let the same people show more, until there are at least ``count`` demonstrations; the first are the session's."""
    shown, truth, language = session.demonstrations, session.truth, session.split.language
    missing = count - len(shown)
    if missing <= 0:
        return Lesson(shown, truth)
    more = replace(language, repetitions=-(-missing // len(language.seen)))
    samples = 2 * -(-missing // min(len(language.movements), language.objects)) + SAMPLES
    cast = session.split.casting(more, samples, _stream(session.seed, _WHO), _stream(session.seed, _MORE_HOW))
    rng = _stream(session.seed, _MORE_SHOWN)
    added, meant = compose_demonstrations(more, cast.signs, cast.movements, rng, session.split.shown_scenes)
    templates = tuple(a + b for a, b in zip(truth.templates, meant.templates, strict=True))
    movement, focus = (np.concatenate(pair) for pair in ((truth.movement, meant.movement), (truth.focus, meant.focus)))
    return Lesson(DemonstrationSet([*shown, *added]), GroundTruth(language, movement, focus, templates))


def entry_stream(session: BenchmarkSession) -> np.random.Generator:
    """Return the generator of the entry that takes part in a session; what it was seeded with does not tell which."""
    name = f"{RECIPE} {session.seed} {session.split.name}".encode()
    return np.random.default_rng(int.from_bytes(hashlib.sha256(name).digest()))


def _stream(seed: int, which: int) -> np.random.Generator:
    return np.random.default_rng([RECIPE, seed, which])
