"""The baselines of the study: clustering methods, the paper's, and chance, all from the same distances."""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Callable
from functools import cached_property
from types import ModuleType

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import squareform

from signimit.exceptions import MissingDependencyError
from signimit.grouping import canonical_labels, group_movements
from signimit.inference import WordOrder, infer_focus, infer_word_order
from signimit.learners.base import Understanding
from signimit.learners.joint.measurements import measure
from signimit.learners.joint.objective import Assumptions
from signimit.signs import SignSpace
from signimit.similarity import maximum_similarities, policy_distances
from signimit.teaching.sessions import Session

Labels = NDArray[np.int64]
Table = NDArray[np.float64]


class SharedDistances:
    """The distances of a session that several methods share, each computed when first used."""

    def __init__(self, session: Session, seed: int) -> None:
        """Store the session, and the seed of methods that draw at random."""
        self.session, self.seed = session, seed

    @cached_property
    def policies(self) -> Table:
        """The paper's Δ, shape (N, N, O, O)."""
        demos = self.session.demonstrations
        return policy_distances(demos.paths, demos.objects)

    @cached_property
    def drawings(self) -> Table:
        """The default learner's dissimilarity of drawings in place of Δ, shape (N, N, O, O).

        γ = 1 / Δ is then the odds of two drawings being one movement: log γ is how alike they are, in nats, less what
        their places about the two objects say against it, as far as the learner lets places speak.
        """
        seen, assumed = measure(self.session.demonstrations), Assumptions()
        away = seen.offsets[:, None, :, None] - seen.offsets[None, :, None, :]  # (N, N, O, O, 2)
        apart = (away**2).sum(axis=-1) / (4 * assumed.offset_spread**2)
        apart = np.minimum(apart, assumed.most_offset - assumed.least_offset)
        return np.asarray(np.exp(seen.drawings[:, :, None, None] + apart))

    @cached_property
    def sign_points(self) -> Table:
        """Signs in the paper's space, shape (N, W, P)."""
        demos = self.session.demonstrations
        space = SignSpace([p.points for p in self.session.prototypes])
        return space.embed_all([s for d in demos for s in d.signs]).reshape(len(demos), -1, len(space.prototypes))


def _sklearn_cluster() -> ModuleType:
    try:
        return importlib.import_module("sklearn.cluster")
    except ImportError:
        raise MissingDependencyError("scikit-learn", "study", "Comparing with clustering methods") from None


Cluster = Callable[[Table, int, int], Labels]


def by_affinity_propagation(gamma: Table, true_count: int, seed: int) -> Labels:
    """B. J. Frey and D. Dueck, Science 315, 2007 (doi:10.1126/science.1136800), on log γ."""
    table = _log(gamma)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = (
            _sklearn_cluster()
            .AffinityPropagation(affinity="precomputed", damping=0.9, max_iter=1000, random_state=seed)
            .fit(table)
        )
    return _noise_alone(found.labels_)


def by_eigengap(gamma: Table, true_count: int, seed: int) -> Labels:
    """Spectral clustering with as many groups as the largest gap of the Laplacian's eigenvalues says.

    U. von Luxburg, Statistics and Computing 17, 2007 (doi:10.1007/s11222-007-9033-z).
    """
    weights = gamma / np.median(gamma[~np.eye(len(gamma), dtype=bool)])
    root = 1 / np.sqrt(np.maximum(weights.sum(axis=1), 1e-12))
    values = np.linalg.eigvalsh(np.eye(len(gamma)) - root[:, None] * weights * root)
    count = int(np.diff(values[: max(2, len(gamma) // 2 + 1)]).argmax()) + 1
    if count == 1:
        return np.zeros(len(gamma), dtype=np.int64)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = (
            _sklearn_cluster()
            .SpectralClustering(n_clusters=count, affinity="precomputed", random_state=seed)
            .fit(weights)
        )
    return _noise_alone(found.labels_)


def by_hdbscan(gamma: Table, true_count: int, seed: int) -> Labels:
    """R. J. G. B. Campello, D. Moulavi and J. Sander, PAKDD 2013 (doi:10.1007/978-3-642-37456-2_14).

    Groups have two members or more; what it calls noise is alone.
    """
    found = _sklearn_cluster().HDBSCAN(metric="precomputed", min_cluster_size=2, copy=True).fit(_distances(gamma))
    return _noise_alone(found.labels_)


def by_linkage_with_the_true_count(gamma: Table, true_count: int, seed: int) -> Labels:
    """Average linkage, told how many movements there are: an oracle."""
    if len(gamma) == 1:
        return np.zeros(1, dtype=np.int64)
    tree = linkage(squareform(_distances(gamma), checks=False), "average")
    return np.asarray(fcluster(tree, true_count, "maxclust"), dtype=np.int64)


def _log(gamma: Table) -> Table:
    table = np.log(np.maximum(gamma, 1e-12))
    np.fill_diagonal(table, table.max())
    return np.asarray(table)


def _distances(gamma: Table) -> Table:
    """Return non-negative distances that order as γ does: differences of log γ from the largest."""
    table = _log(gamma)
    gaps = table.max() - table
    np.fill_diagonal(gaps, 0.0)
    return np.asarray(gaps)


def _noise_alone(labels: NDArray[np.integer]) -> Labels:
    """Give each demonstration without a group, -1, a group of its own."""
    alone = labels < 0
    return np.where(alone, labels.max() + 1 + np.cumsum(alone), labels).astype(np.int64)


CLUSTERINGS: dict[str, Cluster] = {
    "affinity propagation": by_affinity_propagation,
    "spectral, eigengap": by_eigengap,
    "HDBSCAN": by_hdbscan,
    "linkage, count given": by_linkage_with_the_true_count,
}
BASELINES = (
    "paper",
    "paper-literal",
    *CLUSTERINGS,
    *(f"{name}, drawings" for name in CLUSTERINGS),
    "chance",
)


def infer(distances: SharedDistances, method: str) -> Understanding:
    """Infer by a baseline; methods of clusters are followed by the paper's focus and the ratio's word order."""
    if method == "chance":  # guesses, knowing how many movements and objects there are
        rng, truth = np.random.default_rng([distances.seed, 7]), distances.session.truth
        count, language = len(truth.movement), truth.language
        order = WordOrder(*rng.permutation(language.words)[:2].tolist())
        labels = rng.integers(0, len(language.movements), count)
        return Understanding(canonical_labels(labels), rng.integers(0, language.objects, count), order)
    name = method.removesuffix(", drawings")
    table = distances.drawings if method.endswith(", drawings") else distances.policies
    gamma = maximum_similarities(table)
    if name in CLUSTERINGS:
        count = len(np.unique(distances.session.truth.movement))
        labels, reading = canonical_labels(CLUSTERINGS[name](gamma, count, distances.seed)), "ratio"
    else:
        labels, reading = group_movements(gamma, method=name, rng=distances.seed).labels, "paper"
    focus = infer_focus(table, labels)
    return Understanding(labels, focus, infer_word_order(distances.sign_points, labels, focus, method=reading))
