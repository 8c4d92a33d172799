"""Was the imitator right, and where it was not, which step went wrong first (paper, section III)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.evaluation import performed
from signimit.grouping import group_movements
from signimit.intervals import wilson_interval
from signimit.learning import ImitationModel
from signimit.policies import run_policy
from signimit.similarity import maximum_similarities, policy_distances
from signimit.teaching.composition import GroundTruth
from signimit_envs.sessions.session import Reproduction, SessionResult

RESTARTS = 51  # the paper's own run and 50 more
STAGES = ("grouping", "focus", "word order", "sign", "policy", "physics")


@dataclass(frozen=True)
class Share:
    """So many of so many.

    Attributes:
        count: How many.
        total: Of how many.
    """

    count: int
    total: int

    @classmethod
    def of(cls, verdicts: Iterable[bool]) -> Share:
        """Count what is true."""
        known = [bool(v) for v in verdicts]
        return cls(sum(known), len(known))

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval of the share; (0, 1) of none."""
        return wilson_interval(self.count, self.total)

    def __str__(self) -> str:
        """Say e.g. ``36 of 36 (95 % interval 0.90 to 1.00)``."""
        low, high = self.interval
        return f"{self.count} of {self.total} (95 % interval {low:.2f} to {high:.2f})"


class InferenceVerdict(NamedTuple):
    """Whether what was inferred is true.

    Attributes:
        grouping: Demonstrations of one movement, and only they, are in one group.
        focus: Every demonstration's object is right.
        word_order: Both words are right.
        foci_right: How many demonstrations' objects are right.
    """

    grouping: bool
    focus: bool
    word_order: bool
    foci_right: Share

    @property
    def all_right(self) -> bool:
        """Whether nothing was inferred wrong."""
        return self.grouping and self.focus and self.word_order


def judge_inference(model: ImitationModel, truth: GroundTruth) -> InferenceVerdict:
    """Compare what a model understood with the truth."""
    foci = Share.of(model.focus == truth.focus)
    order = tuple(model.word_order) == (truth.language.focus_word, truth.language.movement_word)
    return InferenceVerdict(same_partition(model.labels, truth.movement), foci.count == foci.total, order, foci)


def same_partition(labels: ArrayLike, others: ArrayLike) -> bool:
    """Tell whether two labellings, shape (N,) each, part the demonstrations in the same way."""
    a, b = np.asarray(labels).tolist(), np.asarray(others).tolist()
    return len(set(zip(a, b, strict=True))) == len(set(a)) == len(set(b))


def obeyed_shares(result: SessionResult) -> dict[str, Share]:
    """Count the commands that were obeyed: all, those about seen pairs and about unseen ones."""
    reproductions = result.reproductions
    return {
        "all": Share.of(r.obeyed for r in reproductions),
        "seen": Share.of(r.obeyed for r in reproductions if r.command.seen),
        "unseen": Share.of(r.obeyed for r in reproductions if not r.command.seen),
    }


def algorithm_reading(result: SessionResult) -> str:
    """Return how Algorithm 1 is read: as the session's method does, as "paper" if that is without it."""
    method = result.session.plan.method
    return method if method in ("paper", "paper-literal") else "paper"


def restart_grouping(result: SessionResult, restarts: int = RESTARTS) -> Share:
    """Run Algorithm 1 again and again on one similarity, from other initial memberships M_1.

    The paper did so 50 times besides its own run, and was right in 49 of them and in its own.

    Args:
        result: A session; the first run is its own if its method uses Algorithm 1.
        restarts: How many runs.
    """
    seed, truth, method = result.session.plan.seed, result.session.truth, algorithm_reading(result)
    similarity = maximum_similarities(session_distances(result))
    rngs = [np.random.default_rng(seed), *np.random.default_rng([seed, 1]).spawn(restarts - 1)]
    return Share.of(
        same_partition(group_movements(similarity, method=method, rng=rng).labels, truth.movement) for rng in rngs
    )


def session_distances(result: SessionResult) -> NDArray[np.float64]:
    """Return Δ of the demonstrations, shape (N, N, O, O), rad², whatever the method."""
    demonstrations = result.session.demonstrations
    return policy_distances(demonstrations.paths, demonstrations.objects)


def failing_stage(result: SessionResult, reproduction: Reproduction) -> str:
    """Name the first step that went wrong on the way to a command that was not obeyed, one of `STAGES`.

    Returns:
        The stage; empty if the command was obeyed.
    """
    if reproduction.obeyed:
        return ""
    session, model, command = result.session, result.model, reproduction.command
    verdict = judge_inference(model, session.truth)
    for stage, right in zip(STAGES, verdict[:3], strict=False):
        if not right:
            return stage
    meant = session.truth.movement[int(np.flatnonzero(model.labels == reproduction.answer.movement)[0])]
    if (int(meant), reproduction.answer.focus) != command.request:
        return "sign"
    policy = model.respond(command.signs, command.scene.objects).policy
    ideal_path = run_policy(policy, command.scene.hand, session.plan.seconds)
    ideal = performed(ideal_path, command.scene.objects, session.truth.templates)
    return "physics" if (ideal.movement, ideal.focus) == command.request else "policy"
