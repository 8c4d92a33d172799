"""Scores of sessions on the physics: commands obeyed, restarts of Algorithm 1, the first step that failed (III)."""

from __future__ import annotations

import numpy as np

from signimit.benchmark.scoring import judge_inference, same_partition
from signimit.benchmark.statistics import Share
from signimit.evaluation import performed
from signimit.grouping import group_movements
from signimit.policies import run_policy
from signimit.similarity import maximum_similarities, policy_distances
from signimit_envs.sessions.session import Reproduction, SessionResult

RESTARTS = 51  # the paper's own run and 50 more
STAGES = ("grouping", "focus", "word order", "sign", "policy", "physics")


def obeyed_shares(result: SessionResult) -> dict[str, Share]:
    """Count the commands that were obeyed: all, those about seen pairs and about unseen ones."""
    reproductions, seen = result.reproductions, result.plan.language.seen
    return {
        "all": Share.of(r.obeyed for r in reproductions),
        "seen": Share.of(r.obeyed for r in reproductions if r.command.request in seen),
        "unseen": Share.of(r.obeyed for r in reproductions if r.command.request not in seen),
    }


def algorithm_reading(result: SessionResult) -> str:
    """Return how Algorithm 1 is read: as the session's method does, as "paper" if that is without it."""
    method = result.plan.method
    return method if method in ("paper", "paper-literal") else "paper"


def restart_grouping(result: SessionResult, restarts: int = RESTARTS) -> Share:
    """Run Algorithm 1 again and again on one similarity, from other initial memberships M_1.

    The paper did so 50 times besides its own run, and was right in 49 of them and in its own.

    Args:
        result: A session; the first run is its own if its method uses Algorithm 1.
        restarts: How many runs.
    """
    seed, truth, method = result.plan.seed, result.session.truth, algorithm_reading(result)
    demonstrations = result.session.demonstrations
    similarity = maximum_similarities(policy_distances(demonstrations.paths, demonstrations.objects))
    rngs = [np.random.default_rng(seed), *np.random.default_rng([seed, 1]).spawn(restarts - 1)]
    return Share.of(
        same_partition(group_movements(similarity, method=method, rng=rng).labels, truth.movement) for rng in rngs
    )


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
    members = session.truth.movement[model.labels == reproduction.answer.movement]
    meant = int(np.bincount(members).argmax())  # a movement that was found stands for what most of its members show
    if (meant, reproduction.answer.focus) != command.request:
        return "sign"
    policy = model.respond(command.signs, command.objects).policy
    ideal_path = run_policy(policy, command.hand, result.plan.seconds)
    ideal = performed(ideal_path, command.objects, session.truth.templates)
    return "physics" if (ideal.movement, ideal.focus) == command.request else "policy"
