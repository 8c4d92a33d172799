"""Leave-people-out cross-validation of the evidence constants.

The constants in `signimit.learners.joint.distance_model` were measured on all people at hand. Here every person is
left out once: the constants are measured anew on the others, and sessions of those left out are learned with both.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import reduce
from operator import add
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.scoring import judge_inference
from signimit.benchmark.studies.conditions import Recordings, compose_study_session, study_condition
from signimit.learners.joint.distance_model import DRAWINGS, SIGNS, DistanceModel
from signimit.learners.joint.distances import measure_distances
from signimit.learners.joint.learner import JointLearner
from signimit.strokes import StrokeLibrary
from signimit.teaching.sessions import Session

MEASURED = ((5, 4, 1, "plain"), (3, 3, 2, "mixed"))  # conditions that constants are measured in
TESTED = ((3, 3, 2), (5, 4, 1), (7, 3, 1))
_MEASURING = 10  # sessions of each condition that constants are measured on
_LEAST_SPREAD = 0.1


class FoldRow(NamedTuple):
    """Results of one condition with people left out.

    Attributes:
        mover: Who was left out of those who move; a share of the signers is left out beside.
        cell: Condition.
        sessions: How many.
        right_without: Of them with every inference right, constants measured without these people.
        right_shipped: The same with the constants that the package has.
        drawings_mean: Typical log distance of equal drawings, measured without these people.
        drawings_spread: Standard deviation about it.
        signs_mean: Typical log distance of equal signs.
        signs_spread: Standard deviation about it.
    """

    mover: str
    cell: str
    sessions: int
    right_without: int
    right_shipped: int
    drawings_mean: float
    drawings_spread: float
    signs_mean: float
    signs_spread: float


def leave_people_out(recordings: Recordings, sessions: int) -> Iterator[FoldRow]:
    """Leave each mover out once, each time with another share of the signers; yields a row for each condition."""
    movers, signers = (sorted(set(library.writers)) for library in (recordings.movements, recordings.signs))
    for number, mover in enumerate(movers):
        out = set(signers[number :: len(movers)])
        others = Recordings(_of(recordings.signs, set(signers) - out), _of(recordings.movements, set(movers) - {mover}))
        learner = measured_learner(others)
        constants = [getattr(m, c) for m in (learner.drawings, learner.signs) for c in ("equal_mean", "equal_spread")]
        absent = Recordings(_of(recordings.signs, out), _of(recordings.movements, {mover}))
        for size in TESTED:
            condition = study_condition(*size, recordings=absent)
            composed = [compose_study_session(condition, seed) for seed in range(sessions)]
            without, shipped = (_count_right(composed, chosen) for chosen in (learner, JointLearner()))
            yield FoldRow(mover, condition.name, sessions, without, shipped, *(round(c, 3) for c in constants))


def measured_learner(recordings: Recordings) -> JointLearner:
    """Measure the means and spreads of the evidence on sessions of these people; shares and prices stay."""
    drawings, signs = [], []
    for movements, objects, repetitions, variant in MEASURED:
        condition = study_condition(movements, objects, repetitions, variant, recordings)
        for seed in range(_MEASURING):
            drawn, said = _equals_and_others(compose_study_session(condition, seed))
            drawings.append(drawn)
            signs.append(said)
    return JointLearner(_fitted(DRAWINGS, drawings), _fitted(SIGNS, signs))


LogDistances = tuple[NDArray[np.float64], NDArray[np.float64]]  # log distances of equals, and of others


def _equals_and_others(session: Session) -> tuple[LogDistances, LogDistances]:
    seen, truth, language = measure_distances(session.demonstrations), session.truth, session.truth.language
    t, k = np.triu_indices(len(session.demonstrations), 1)
    one_movement, one_focus = truth.movement[t] == truth.movement[k], truth.focus[t] == truth.focus[k]
    drawn = np.log(seen.drawings[t, k, truth.focus[t], truth.focus[k]])
    named, asked = (np.log(seen.signs[word][t, k]) for word in (language.focus_word, language.movement_word))
    equal = np.concatenate([named[one_focus], asked[one_movement]])
    other = np.concatenate([named[~one_focus], asked[~one_movement]])
    return (drawn[one_movement], drawn[~one_movement]), (equal, other)


def _fitted(model: DistanceModel, sessions: Sequence[LogDistances]) -> DistanceModel:
    """Replace means and spreads by those of sessions; medians, for some of the others are akin and some equals odd."""
    typical = np.array([np.median(equal) for equal, _ in sessions])
    about = np.concatenate([equal - middle for (equal, _), middle in zip(sessions, typical, strict=True)])
    others = np.concatenate([other for _, other in sessions])
    return replace(
        model,
        equal_mean=float(typical.mean()),
        equal_mean_spread=max(float(typical.std(ddof=1)), _LEAST_SPREAD),
        equal_spread=_robust_spread(about),
        other_mean=float(np.median(others)),
        other_spread=_robust_spread(others),
    )


def _robust_spread(values: NDArray[np.float64]) -> float:
    """Standard deviation of a normal distribution with the same median deviation."""
    return max(1.4826 * float(np.median(np.abs(values - np.median(values)))), _LEAST_SPREAD)


def _count_right(sessions: Sequence[Session], learner: JointLearner) -> int:
    """Count the sessions of which everything is inferred right."""
    found = (learner.infer(session.demonstrations, None, np.random.default_rng(0)) for session in sessions)
    return sum(judge_inference(f, session.truth).all_right for f, session in zip(found, sessions, strict=True))


def _of(library: StrokeLibrary, writers: set[str]) -> StrokeLibrary:
    return reduce(add, (library.select(writer=writer) for writer in sorted(writers)))
