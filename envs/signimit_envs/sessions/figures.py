"""The paper's figures of a session, as files. Needs matplotlib."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from signimit.grouping import group_movements
from signimit.learners.paper import PaperEvidence
from signimit.plots import paper as figures
from signimit.plots.explanation import draw_explanation
from signimit.similarity import maximum_similarities, policy_similarities
from signimit_envs.sessions.scores import algorithm_reading, session_distances
from signimit_envs.sessions.session import Reproduction, SessionResult

DOTS_PER_INCH = 130


def write_figures(result: SessionResult, folder: Path) -> None:
    """Write figures 4 to 7 and the memberships as PNG, and why it was so understood where the method can tell."""
    model, language = result.model, result.plan.language
    distances = session_distances(result)
    similarity = maximum_similarities(distances)
    evidence = model.understanding.evidence
    history = evidence.history if isinstance(evidence, PaperEvidence) else None
    if history is None:  # a method without Algorithm 1; show what the paper's would have done
        history = group_movements(similarity, method=algorithm_reading(result), rng=result.plan.seed).history
    reproductions = by_request(result)
    drawn = {
        "figure4": figures.draw_demonstrations(result.session.demonstrations, model.labels, model.focus),
        "figure5": figures.draw_similarities(policy_similarities(distances), model.labels),
        "figure6": figures.draw_maximum_similarity(similarity, model.labels),
        "figure7": figures.draw_reproductions(
            {request: [path_about_object(r) for r in rs] for request, rs in reproductions.items()},
            {request: [r.obeyed for r in rs] for request, rs in reproductions.items()},
            language.movements,
            language.held_back,
        ),
        "memberships": figures.draw_memberships(history, model.labels),
    }
    if model.understanding.belief is not None:
        drawn["why"] = draw_explanation(model)
    for name, figure in drawn.items():
        # Without the date and version of the software the same session gives the same bytes.
        figure.savefig(folder / f"{name}.png", dpi=DOTS_PER_INCH, metadata={"Software": None})


def by_request(result: SessionResult) -> dict[tuple[int, int], list[Reproduction]]:
    """Return the reproductions of each request, by (movement, focus)."""
    return {
        (request.movement, request.focus): [r for r in result.reproductions if r.command.request == request]
        for request in result.plan.language.requests
    }


def path_about_object(reproduction: Reproduction) -> NDArray[np.float64]:
    """Return the path of the hand in the frame of the object asked for, shape (T, 2), m."""
    command = reproduction.command
    return np.asarray(reproduction.answer.path - command.objects[command.request.focus])
