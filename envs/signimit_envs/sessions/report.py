"""Reports of a session: a table to read, and an object for JSON."""

from __future__ import annotations

import json
import platform
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from signimit.benchmark.results import installed_versions
from signimit.benchmark.scoring import judge_inference
from signimit.benchmark.statistics import Share
from signimit.names import object_name
from signimit.teaching.composition import Strokes
from signimit.teaching.languages import Request
from signimit.teaching.people.choosing import People
from signimit.teaching.sessions import Session
from signimit_envs.sessions.scores import RESTARTS, algorithm_reading, failing_stage, obeyed_shares, restart_grouping
from signimit_envs.sessions.session import Reproduction, SessionResult

FORMAT = 3  # 2 had one learner; 1 called the misfit path_error
PACKAGES = ("signimit", "numpy", "scipy", "mujoco", "mink", "gymnasium", "imageio", "matplotlib")
_MEASURES = "obeyed  misfit  coverage  turns"


def session_report(results: Mapping[str, SessionResult], people: People[Strokes]) -> dict[str, Any]:
    """Tell everything about one session in what JSON can say; the same session gives the same object.

    Args:
        results: What each imitator made of the session, by its name.
        people: Who made the signs and showed the movements.
    """
    first = next(iter(results.values()))
    plan = first.plan
    return {
        "format": FORMAT,
        "plan": {name: getattr(plan, name) for name in ("seed", "attempts", "seconds")},
        "people": {"interactant": people.names[0], "demonstrator": people.names[1]},
        "versions": {"platform": platform.platform(), **installed_versions(*PACKAGES)},
        "movements": list(plan.language.movements),
        "demonstrations": len(first.session.demonstrations),
        "commands": len(first.session.commands),
        "grouping restarts right": share_entry(restart_grouping(first)),
        "imitators": {name: _imitator_entry(result) for name, result in results.items()},
    }


def session_table(results: Mapping[str, SessionResult]) -> str:
    """Say in a table, with a column for each imitator, what was inferred and how each pair of signs was obeyed."""
    language = next(iter(results.values())).plan.language
    columns = list(results.values())
    verdicts = [judge_inference(r.model, r.session.truth) for r in columns]
    lines = [
        _line("", results),
        _line("learner, policy", [f"{r.plan.method}, {r.plan.policy}" for r in columns]),
        _line("grouping", [_word(v.grouping) for v in verdicts]),
        _line("focus of demonstrations", [f"{v.foci_right.count} of {v.foci_right.total}" for v in verdicts]),
        _line("word order", [_word(v.word_order) for v in verdicts]),
        "",
        _line("asked for", [_MEASURES] * len(columns)),
    ]
    for request in language.requests:
        shown = "" if request in language.seen else " (never shown)"
        asked = f"{language.movements[request.movement]}, {object_name(request.focus)}{shown}"
        lines.append(_line(asked, [_measures(request, r) for r in columns]))
    lines.append("Medians over commands; the misfit is in half sizes.")
    shares = [obeyed_shares(r) for r in columns]
    lines += ["", *(_line(f"obeyed, {name}", [_share_text(s[name]) for s in shares]) for name in shares[0])]
    return "\n".join(line.rstrip() for line in lines)


def restarts_line(result: SessionResult) -> str:
    """Say how often Algorithm 1 groups the demonstrations right, from its own start and others."""
    return f"Algorithm 1, {algorithm_reading(result)}, from {RESTARTS} starts: right in {restart_grouping(result)}"


def truth_text(session: Session) -> str:
    """Say the truth about demonstrations as JSON text: for each the movement and the object that were asked for."""
    truth = session.truth
    entries = [
        {"movement": name, "object": object_name(int(focus))}
        for name, focus in zip(truth.movement_names, truth.focus, strict=True)
    ]
    order = {"focus": truth.language.focus_word, "movement": truth.language.movement_word}
    return json.dumps({"word order": order, "demonstrations": entries}, indent=1) + "\n"


def _line(name: str, cells: Iterable[str]) -> str:
    return f"{name:35s}" + "  ".join(f"{cell:{len(_MEASURES)}s}" for cell in cells)


def _measures(request: Request, result: SessionResult) -> str:
    """Say how often a request was obeyed, and the medians of misfit, coverage and turns."""
    mine = [r for r in result.reproductions if r.command.request == request]
    obeyed = Share.of(r.obeyed for r in mine)
    looks = [(p.misfit, p.coverage, p.turns) for p in (r.performance for r in mine)]
    misfit, coverage, turns = np.median(looks, axis=0)
    return f"{obeyed.count:>3d}/{obeyed.total:<2d}  {misfit:>6.2f}  {coverage:>8.2f}  {turns:>5.1f}"


def _share_text(share: Share) -> str:
    low, high = share.interval
    return f"{share.count} of {share.total} [{100 * low:.0f} to {100 * high:.0f} %]"


def _imitator_entry(result: SessionResult) -> dict[str, Any]:
    """Tell what one imitator understood and did."""
    verdict = judge_inference(result.model, result.session.truth)
    return {
        "method": result.plan.method,
        "policy": result.plan.policy,
        "inference": {
            "grouping right": verdict.grouping,
            "focus right": verdict.focus,
            "word order right": verdict.word_order,
            "demonstrations with the right focus": share_entry(verdict.foci_right),
        },
        "obeyed": {name: share_entry(share) for name, share in obeyed_shares(result).items()},
        "summary": result.model.summary(),
        "reproductions": [_reproduction_entry(result, r) for r in result.reproductions],
    }


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
