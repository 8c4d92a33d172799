"""Few-shot sign classification: how often a new sign is read right after a few examples of each, by three distances."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.splits import FILLER_SIGNS
from signimit.benchmark.statistics import wilson_interval
from signimit.benchmark.studies.conditions import SAMPLES
from signimit.inference import WordOrder
from signimit.learners.base import Understanding
from signimit.learners.joint.sign_distance import VocabularyReader, sign_features
from signimit.learners.paper import NearestSignReader
from signimit.signs import SignSpace, normalised_sign, pairwise_dtw
from signimit.strokes import StrokeLibrary
from signimit.teaching.people import synthetic_library
from signimit.teaching.people.choosing import CROWD, Source, load_person
from signimit.teaching.stroke_sampler import StrokeSampler

Points = Sequence[NDArray[np.float64]]


class Quiz(NamedTuple):
    """A classification task.

    Attributes:
        signs: Which are to be told apart.
        shown: Examples of each.
        crowd: Whether each sign is another person's.
    """

    signs: tuple[str, ...]
    shown: int
    crowd: bool


class SignRow(NamedTuple):
    """Number of signs never shown that were read right, with Wilson's 95 % interval."""

    people: str
    signs: str
    shown: int
    signers: str
    method: str
    asked: int
    right: int
    low: float
    high: float


DIGITS = tuple("0123456")
QUIZZES = tuple(
    Quiz(signs, shown, crowd)
    for crowd in (False, True)
    for signs, shown in ((DIGITS[1:4], 4), (DIGITS[4:7], 4), (DIGITS, 4), (DIGITS, 2))
)
METHODS = ("joint", "warping", "three prototypes")


def run_quizzes(library: StrokeLibrary | None, quizzes: int) -> Iterator[SignRow]:
    """Hold quizzes of each kind among real people or, without a library, synthetic ones; seeds are 0, 1, ...

    Args:
        library: Signs of real people.
        quizzes: How many of each kind; in each, every sign is asked for once.
    """
    for kind in QUIZZES:
        right = sum((_hold(kind, seed, library) for seed in range(quizzes)), np.zeros(len(METHODS), dtype=np.int64))
        asked = quizzes * len(kind.signs)
        for method, count in zip(METHODS, right.tolist(), strict=True):
            interval = (round(share, 4) for share in wilson_interval(count, asked))
            who, signers = ("real" if library else "synthetic"), ("many" if kind.crowd else "one")
            yield SignRow(who, " ".join(kind.signs), kind.shown, signers, method, asked, count, *interval)


def _hold(kind: Quiz, seed: int, library: StrokeLibrary | None) -> NDArray[np.int64]:
    """Count right readings of each method, shape (3,)."""
    rng = np.random.default_rng([seed, kind.shown, len(kind.signs)])
    labels = (*kind.signs, *FILLER_SIGNS)
    if library is None:
        writers = CROWD if kind.crowd else 1
        library = synthetic_library(labels, writers=writers, samples=SAMPLES // writers, rng=rng)
    elif not kind.crowd:
        library, _ = load_person(Source(library), labels, rng, kind.shown + 1)
    sampler = StrokeSampler(library)
    shown = [sampler.draw(sign, rng).points for sign in kind.signs for _ in range(kind.shown)]
    asked = [sampler.draw(sign, rng).points for sign in kind.signs]
    prototypes = [sampler.draw(sign, rng).points for sign in FILLER_SIGNS]
    truth = np.arange(len(asked))
    said = Understanding(np.repeat(truth, kind.shown), np.repeat(truth, kind.shown), WordOrder(0, 0))
    ours = VocabularyReader((sign_features(shown),), said, len(truth))
    space = SignSpace(prototypes)
    papers = NearestSignReader(space, space.embed_all(shown)[:, None], said, len(truth))
    readings = [[int(reader.read([sign]).focus.argmax()) for sign in asked] for reader in (ours, papers)]
    known, heard = (np.stack([normalised_sign(sign) for sign in signs]) for signs in (shown, asked))
    nearest = pairwise_dtw(heard, known).argmin(axis=1) // kind.shown
    answers = (readings[0], nearest, readings[1])
    return np.array([(np.asarray(answer) == truth).sum() for answer in answers])
