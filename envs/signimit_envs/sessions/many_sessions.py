"""Scores of many sessions: shares of right inferences and obeyed commands, and the steps that failed."""

from __future__ import annotations

import platform
from collections import Counter
from collections.abc import Sequence
from typing import Any, NamedTuple

from signimit.benchmark.judge import CRITERION, judge_hash
from signimit.benchmark.results import installed_versions
from signimit.benchmark.scoring import InferenceVerdict, judge_inference
from signimit.benchmark.statistics import Share
from signimit_envs.sessions.report import PACKAGES, share_entry
from signimit_envs.sessions.scores import STAGES, failing_stage, obeyed_shares, restart_grouping
from signimit_envs.sessions.session import SessionResult


class SessionOutcome(NamedTuple):
    """Scores of one session.

    Attributes:
        seed: Its seed.
        verdict: Whether its inferences were right.
        restarts: How often Algorithm 1 groups its demonstrations right.
        obeyed: Commands obeyed: all, about seen pairs, about unseen pairs.
        stages: The stage that failed, for each command that was not obeyed.
    """

    seed: int
    verdict: InferenceVerdict
    restarts: Share
    obeyed: dict[str, Share]
    stages: tuple[str, ...]


def session_outcome(result: SessionResult) -> SessionOutcome:
    """Judge a session."""
    stages = tuple(failing_stage(result, r) for r in result.reproductions if not r.obeyed)
    verdict = judge_inference(result.model, result.session.truth)
    return SessionOutcome(result.plan.seed, verdict, restart_grouping(result), obeyed_shares(result), stages)


def repeats_paper(outcome: SessionOutcome) -> bool:
    """Tell whether a session went as the paper's: everything understood and obeyed, 50 of 51 groupings right."""
    everything = outcome.verdict.all_right and not outcome.stages
    return everything and 51 * outcome.restarts.count >= 50 * outcome.restarts.total


def study_shares(outcomes: Sequence[SessionOutcome]) -> dict[str, Share]:
    """Count over all sessions."""
    verdicts = [o.verdict for o in outcomes]
    return {
        "grouping right": Share.of(v.grouping for v in verdicts),
        "all foci right": Share.of(v.focus for v in verdicts),
        "word order right": Share.of(v.word_order for v in verdicts),
        "all inferences right": Share.of(v.all_right for v in verdicts),
        "grouping right, restarts": _total(o.restarts for o in outcomes),
        "obeyed": _total(o.obeyed["all"] for o in outcomes),
        "obeyed, seen pairs": _total(o.obeyed["seen"] for o in outcomes),
        "obeyed, unseen pairs": _total(o.obeyed["unseen"] for o in outcomes),
    }


def study_table(outcomes: Sequence[SessionOutcome]) -> str:
    """Say in lines what came out, and which stages failed in which sessions."""
    lines = [f"{name:26s} {share}" for name, share in study_shares(outcomes).items()]
    alike = ", ".join(str(o.seed) for o in outcomes if repeats_paper(o)) or "none"
    lines.append(f"sessions that repeat the paper's result: {alike}")
    for stage in STAGES:
        failed = Counter({o.seed: o.stages.count(stage) for o in outcomes if stage in o.stages})
        if failed:
            where = ", ".join(f"{seed} ({count})" for seed, count in sorted(failed.items()))
            lines.append(f"not obeyed because of {stage}: {failed.total()}, in sessions {where}")
    lines.append(CRITERION)
    return "\n".join(lines)


def study_report(outcomes: Sequence[SessionOutcome], method: str, policy: str) -> dict[str, Any]:
    """Say the same in what JSON can say, session by session."""
    return {
        "method": method,
        "policy": policy,
        "judge": judge_hash(),
        "versions": {"platform": platform.platform(), **installed_versions(*PACKAGES)},
        "shares": {name: share_entry(share) for name, share in study_shares(outcomes).items()},
        "sessions": [
            {
                "seed": o.seed,
                "grouping right": o.verdict.grouping,
                "focus right": o.verdict.focus,
                "word order right": o.verdict.word_order,
                "grouping restarts right": o.restarts.count,
                "obeyed": o.obeyed["all"].count,
                "commands": o.obeyed["all"].total,
                "failed stages": dict(Counter(o.stages)),
            }
            for o in outcomes
        ],
    }


def _total(shares: Any) -> Share:
    counts = list(shares)
    return Share(sum(s.count for s in counts), sum(s.total for s in counts))
