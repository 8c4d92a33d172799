"""Leave-people-out cross-validation of the evidence constants.

The constants in `signimit.learners.joint.drawing_dissimilarity` and `signimit.learners.joint.distance_model` were
measured on all people at hand. Here every person is left out once: the constants are measured anew on the others, and
sessions of those left out are learned with both.
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
from signimit.benchmark.studies.drawing_weights import (
    DrawingPairs,
    area_under_curve,
    compare_people,
    fit_drawing_weights,
)
from signimit.exceptions import InvalidInputError
from signimit.learners.joint.distance_model import SIGNS, DistanceModel
from signimit.learners.joint.drawing_dissimilarity import DRAWINGS
from signimit.learners.joint.learner import JointLearner
from signimit.learners.joint.sign_distance import sign_distances, sign_features
from signimit.strokes import StrokeLibrary
from signimit.teaching.sessions import Session

MEASURED = ((5, 4, 1, "plain"), (3, 3, 2, "mixed"))  # conditions that distances of signs are measured in
TESTED = ((3, 3, 2), (5, 4, 1), (7, 3, 1))
_MEASURING = 10  # sessions of each condition that they are measured on
_LEAST_SPREAD = 0.1


class FoldRow(NamedTuple):
    """Results of one condition with people left out.

    Attributes:
        mover: Who was left out of those who move; a share of the signers is left out beside.
        cell: Condition.
        sessions: How many.
        right_without: Of them with every inference right, constants measured without these people.
        right_shipped: The same with the constants that the package has.
        drawings_without: How well the mover's drawings of one thing and of two are told apart, as the area under the
            curve, by weights that were fitted without the mover.
        drawings_shipped: The same by the weights that the package has.
        signs_mean: Typical log distance of equal signs, measured without these people.
        signs_spread: Standard deviation about it.
    """

    mover: str
    cell: str
    sessions: int
    right_without: int
    right_shipped: int
    drawings_without: float
    drawings_shipped: float
    signs_mean: float
    signs_spread: float


def leave_people_out(
    recordings: Recordings, sessions: int, strangers: Sequence[DrawingPairs] = ()
) -> Iterator[FoldRow]:
    """Leave each mover out once, each time with another share of the signers; yields a row for each condition.

    Args:
        recordings: Signs and movements of people.
        sessions: How many of each condition.
        strangers: Drawings of other people, which weights of drawings are fitted to as well.

    Raises:
        InvalidInputError: If fewer than two people move or sign.
    """
    movers, signers = (sorted(set(library.writers)) for library in (recordings.movements, recordings.signs))
    if min(len(movers), len(signers)) < 2:
        found = f"{len(movers)} and {len(signers)}"
        raise InvalidInputError("people to leave out", "at least 2 who move and 2 who sign", found)
    for number, mover in enumerate(movers):
        out = set(signers[number :: len(movers)])
        others = Recordings(_of(recordings.signs, set(signers) - out), _of(recordings.movements, set(movers) - {mover}))
        learner = measured_learner(others, strangers)
        absent = Recordings(_of(recordings.signs, out), _of(recordings.movements, {mover}))
        drawn = compare_people(absent.movements, np.random.default_rng(0))[0]
        told = [area_under_curve(drawn, weights) for weights in (learner.drawings, DRAWINGS)]
        constants = (*told, learner.signs.equal_mean, learner.signs.equal_spread)
        for size in TESTED:
            condition = study_condition(*size, recordings=absent)
            composed = [compose_study_session(condition, seed) for seed in range(sessions)]
            without, shipped = (_count_right(composed, chosen) for chosen in (learner, JointLearner()))
            yield FoldRow(mover, condition.name, sessions, without, shipped, *(round(c, 4) for c in constants))


def measured_learner(recordings: Recordings, strangers: Sequence[DrawingPairs] = ()) -> JointLearner:
    """Fit the weights of drawings and the means and spreads of signs to these people; shares and prices stay.

    Args:
        recordings: Signs and movements of people.
        strangers: Drawings of other people, besides.
    """
    drawings = [*compare_people(recordings.movements, np.random.default_rng(0)), *strangers]
    signs = [
        _equals_and_others(compose_study_session(study_condition(*size, recordings=recordings), seed))
        for size in MEASURED
        for seed in range(_MEASURING)
    ]
    return JointLearner(drawings=fit_drawing_weights(drawings), signs=_fitted(SIGNS, signs))


LogDistances = tuple[NDArray[np.float64], NDArray[np.float64]]  # log distances of equals, and of others


def _equals_and_others(session: Session) -> LogDistances:
    truth, language = session.truth, session.truth.language
    t, k = np.triu_indices(len(session.demonstrations), 1)
    equal, other = [], []
    for word, meaning in ((language.focus_word, truth.focus), (language.movement_word, truth.movement)):
        distances = sign_distances(sign_features([d.signs[word] for d in session.demonstrations]))[t, k]
        same = meaning[t] == meaning[k]
        equal.append(np.log(distances[same]))
        other.append(np.log(distances[~same]))
    return np.concatenate(equal), np.concatenate(other)


def _fitted(model: DistanceModel, sessions: Sequence[LogDistances]) -> DistanceModel:
    """Replace means and spreads by those of sessions; medians, for some of the others are akin and some equals odd."""
    typical = np.array([np.median(equal) for equal, _ in sessions])
    about = np.concatenate([equal - middle for (equal, _), middle in zip(sessions, typical, strict=True)])
    others = np.concatenate([other for _, other in sessions])
    return replace(
        model,
        equal_mean=float(typical.mean()),
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
