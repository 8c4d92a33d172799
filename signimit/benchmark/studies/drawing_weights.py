"""The weights of the features of drawings, learned from people who draw one thing and people who draw others.

`signimit.learners.joint.drawing_dissimilarity` compares drawings by features. What a feature says is learned here, by
logistic regression on pairs of drawings: of one writer who drew things several times, and of strangers who drew one
thing each.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import expit
from scipy.stats import rankdata

from signimit.benchmark.studies.varied_demonstrations import rotation
from signimit.exceptions import InvalidInputError
from signimit.learners.joint.drawing_dissimilarity import DrawingWeights, describe_ink, pair_features
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.people.relabelling import with_both_triangles
from signimit.teaching.scenes import drawn_path

Array = NDArray[np.float64]

STRANGERS = "strangers"
STRANGERS_WEIGHT = 6.0  # of all strangers of a library, against 1 of a writer who drew things several times
DRAWN = 6  # drawings of a label by a writer that are compared
PENALTY = 5e-4  # of half the squared norm against the mean loss: what C = 0.01 of scikit-learn is for 200,000 pairs
_LEAST = 2  # drawings of a label that a writer must have made, and labels, to be compared alone
_HALF_SIZE = 0.1  # m; features do not depend on it
_MIRRORED = ("triangle up", "circle")  # a session also asks for them the other way round
_LEFT_RIGHT = np.array([-1.0, 1.0])


class DrawingPairs(NamedTuple):
    """Pairs of drawings by one writer, or by strangers.

    Attributes:
        source: Who drew them.
        features: As `pair_features` computes them, shape (P, 13).
        equal: Whether both show one thing, shape (P,).
        weight: Of all these pairs against those of other sources; pairs of one thing have half of it.
    """

    source: str
    features: Array
    equal: NDArray[np.bool_]
    weight: float = 1.0


def compare_people(
    library: StrokeLibrary, rng: np.random.Generator, without: Collection[str] = ()
) -> list[DrawingPairs]:
    """Compare the drawings of each writer who drew several things several times, or else those of all strangers.

    Circles and triangles of a writer are also mirrored, as another thing. Drawings of strangers are all made
    counter-clockwise by mirroring.

    Args:
        library: Drawings of people.
        rng: Chooses among many drawings of one thing by a writer.
        without: Labels that are left out where all are strangers: what is to be tested on.

    Raises:
        InvalidInputError: If there are no two drawings of one thing, or none of another.
    """
    counts = Counter(zip(library.writers, library.labels, strict=True))
    often = Counter(writer for (writer, _), count in counts.items() if count >= _LEAST)
    alone = sorted(writer for writer, labels in often.items() if labels >= _LEAST)
    if not alone:
        return [_compare(_of_strangers(library, without), f"{library.source} {STRANGERS}".lstrip(), STRANGERS_WEIGHT)]
    return [_compare(_of_writer(library.select(writer=w), rng), f"{library.source} {w}".lstrip(), 1.0) for w in alone]


def _of_strangers(library: StrokeLibrary, without: Collection[str]) -> list[tuple[str, Array]]:
    """Return label and path of each drawing, all counter-clockwise."""
    paths = [(label, drawn_path(s, _HALF_SIZE)) for s, label in zip(library, library.labels, strict=True)]
    return [(label, p if rotation(p) > 0 else p * _LEFT_RIGHT) for label, p in paths if label not in without]


def _of_writer(library: StrokeLibrary, rng: np.random.Generator) -> list[tuple[str, Array]]:
    """Return label and path of up to `DRAWN` drawings of each label, and of mirror images."""
    library, chosen = with_both_triangles(library), []
    strokes: dict[str, list[Stroke]] = {}
    for stroke, label in zip(library, library.labels, strict=True):
        strokes.setdefault(label, []).append(stroke)
    for label, mine in sorted(strokes.items()):
        image = f"{label}, other way"
        flips = {label: np.ones(2)}
        if label in _MIRRORED and image not in strokes:
            flips[image] = _LEFT_RIGHT
        for name, flip in flips.items():
            for i in rng.permutation(len(mine))[:DRAWN]:
                chosen.append((name, drawn_path(mine[i], _HALF_SIZE) * flip))
    return chosen


def _compare(drawings: Sequence[tuple[str, Array]], source: str, weight: float) -> DrawingPairs:
    labels = np.array([label for label, _ in drawings])
    first, second = np.triu_indices(len(drawings), 1)
    equal = labels[first] == labels[second]
    if not equal.any() or equal.all():
        found = f"{len(drawings)} with {len(set(labels))} labels"
        raise InvalidInputError(f"drawings of {source}", "several of one thing, and others", found)
    features = pair_features([describe_ink(path) for _, path in drawings])
    return DrawingPairs(source, features[first, second], equal, weight)


def fit_drawing_weights(people: Sequence[DrawingPairs], penalty: float = PENALTY) -> DrawingWeights:
    """Fit what features say about two drawings being two things, by logistic regression.

    Within each source, pairs of one thing and pairs of two count the same. The squared norm of the weights of
    standardised features is penalised, as scikit-learn does.

    Args:
        people: Pairs of one source or more.
        penalty: Of half the squared norm against the mean loss of pairs, nats.

    Returns:
        Weights of features as they are, and the offset, nats.
    """
    features = np.concatenate([p.features for p in people])
    equal = np.concatenate([p.equal for p in people])
    share = np.concatenate([p.weight / 2 / np.where(p.equal, p.equal.sum(), (~p.equal).sum()) for p in people])
    share /= share.sum()
    middle = share @ features
    spread = np.sqrt(share @ (features - middle) ** 2)
    spread[spread == 0] = 1.0  # a feature in which all pairs are the same
    design = np.column_stack([(features - middle) / spread, np.ones(len(features))])
    sign = np.where(equal, -1.0, 1.0)

    def loss(coefficients: Array) -> tuple[float, Array]:
        margin = sign * (design @ coefficients)
        norm = np.append(coefficients[:-1], 0.0)  # the offset is free
        slope = penalty * norm - design.T @ (share * sign * expit(-margin))
        return float(share @ np.logaddexp(0.0, -margin) + penalty * norm @ norm / 2), slope

    found = minimize(
        loss, np.zeros(design.shape[1]), jac=True, method="L-BFGS-B", options={"gtol": 1e-7, "ftol": 1e-12}
    )
    weights = found.x[:-1] / spread
    return DrawingWeights(weights, float(found.x[-1] - weights @ middle))


def area_under_curve(pairs: DrawingPairs, model: DrawingWeights) -> float:
    """Compute the probability that of a pair of one thing and a pair of two, the latter is more unlike."""
    ranks = rankdata(pairs.features @ model.weights)
    ones = int(pairs.equal.sum())
    others = len(ranks) - ones
    return float((ranks[~pairs.equal].sum() - others * (others + 1) / 2) / (ones * others))
