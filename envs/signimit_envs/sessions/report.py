"""Reports of a session: a table to read, and an object for JSON."""

from __future__ import annotations

import json
import platform
from typing import Any

import numpy as np

from signimit.benchmark.results import installed_versions
from signimit.benchmark.scoring import judge_inference
from signimit.benchmark.statistics import Share
from signimit.explanation import object_name
from signimit.teaching.composition import Strokes
from signimit.teaching.languages import Request
from signimit.teaching.people.choosing import People
from signimit.teaching.sessions import Session
from signimit_envs.sessions.scores import algorithm_reading, failing_stage, obeyed_shares, restart_grouping
from signimit_envs.sessions.session import Reproduction, SessionResult

FORMAT = 2  # 1 called the misfit path_error
PACKAGES = ("signimit", "numpy", "scipy", "mujoco", "mink", "gymnasium", "imageio", "matplotlib")


def session_report(result: SessionResult, people: People[Strokes]) -> dict[str, Any]:
    """Tell everything about a session in what JSON can say; the same session gives the same object."""
    plan, language = result.plan, result.plan.language
    rows = [_reproduction_entry(result, r) for r in result.reproductions]
    verdict = judge_inference(result.model, result.session.truth)
    return {
        "format": FORMAT,
        "plan": {name: getattr(plan, name) for name in ("method", "policy", "seed", "attempts", "seconds")},
        "people": {"interactant": people.names[0], "demonstrator": people.names[1]},
        "versions": {"platform": platform.platform(), **installed_versions(*PACKAGES)},
        "movements": list(language.movements),
        "inference": {
            "grouping right": verdict.grouping,
            "focus right": verdict.focus,
            "word order right": verdict.word_order,
            "demonstrations with the right focus": share_entry(verdict.foci_right),
            "reading of Algorithm 1": algorithm_reading(result),
            "grouping restarts right": share_entry(restart_grouping(result)),
        },
        "obeyed": {name: share_entry(share) for name, share in obeyed_shares(result).items()},
        "summary": result.model.summary(),
        "reproductions": rows,
    }


def session_table(result: SessionResult) -> str:
    """Say in a table how each pair of signs was obeyed."""
    lines = ["movement       about  shown   obeyed      misfit  coverage  turns"]
    for request in result.plan.language.requests:
        lines.append(_row(request, result))
    for name, share in obeyed_shares(result).items():
        lines.append(f"obeyed, {name}: {share}")
    return "\n".join(lines)


def inference_lines(result: SessionResult) -> str:
    """Say whether grouping, focus and word order are right, and how often grouping is from other starts."""
    verdict = judge_inference(result.model, result.session.truth)
    return "\n".join(
        [
            f"grouping: {_word(verdict.grouping)}",
            f"focus: {_word(verdict.focus)}, {verdict.foci_right.count} of {verdict.foci_right.total} demonstrations",
            f"word order: {_word(verdict.word_order)}",
            f"Algorithm 1, {algorithm_reading(result)}, from other starts: right in {restart_grouping(result)}",
        ]
    )


def truth_text(session: Session) -> str:
    """Say the truth about demonstrations as JSON text: for each the movement and the object that were asked for."""
    truth = session.truth
    entries = [
        {"movement": name, "object": object_name(int(focus))}
        for name, focus in zip(truth.movement_names, truth.focus, strict=True)
    ]
    order = {"focus": truth.language.focus_word, "movement": truth.language.movement_word}
    return json.dumps({"word order": order, "demonstrations": entries}, indent=1) + "\n"


def _row(request: Request, result: SessionResult) -> str:
    mine = [r for r in result.reproductions if r.command.request == request]
    obeyed = Share.of(r.obeyed for r in mine)
    error, coverage, turns = np.median([r.performance[2:5] for r in mine], axis=0)
    movement = result.plan.language.movements[request.movement]
    shown = "yes" if request in result.plan.language.seen else "never"
    return (
        f"{movement:14s} {object_name(request.focus):6s} {shown:6s} {obeyed.count:>4d}/{obeyed.total:<2d} "
        f"{error:>11.2f} {coverage:>9.2f} {turns:>6.1f}"
    )


def _reproduction_entry(result: SessionResult, reproduction: Reproduction) -> dict[str, Any]:
    command, performance = reproduction.command, reproduction.performance
    return {
        "movement asked for": result.plan.language.movements[command.request.movement],
        "object asked for": object_name(command.request.focus),
        "demonstrated": command.request in result.plan.language.seen,
        "obeyed": reproduction.obeyed,
        "failing stage": failing_stage(result, reproduction),
        "movement": performance.movement,
        "focus": performance.focus,
        "misfit": _finite(performance.misfit),
        "coverage": performance.coverage,
        "turns": performance.turns,
        "confidence": reproduction.answer.confidence,
    }


def share_entry(share: Share) -> dict[str, Any]:
    """Say a share in what JSON can say."""
    low, high = share.interval
    return {"count": share.count, "total": share.total, "wilson 95 %": [low, high]}


def _finite(value: float) -> float | None:
    """JSON has no infinity."""
    return value if np.isfinite(value) else None


def _word(right: bool) -> str:
    return "right" if right else "WRONG"
