"""The paper's figures of a session, as files. Needs matplotlib."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.learners.paper import PaperEvidence
from signimit.plots import paper as figures
from signimit.plots.explanation import draw_explanation
from signimit.similarity import maximum_similarities, policy_similarities
from signimit_envs.sessions.session import SessionResult

DOTS_PER_INCH = 130


def write_figures(paper: SessionResult, ours: SessionResult, folder: Path) -> None:
    """Write figures 4 to 7 and the memberships as the paper draws them, figure 7 of ours, and why ours understood so.

    Args:
        paper: A session with the paper's learner and policy.
        ours: The same session with others; without ``why.png`` if their learner has no probabilities to tell.
        folder: Where the PNG files go.
    """
    model, evidence = paper.model, paper.model.understanding.evidence
    if not isinstance(evidence, PaperEvidence) or evidence.distances is None or evidence.history is None:
        raise InvalidInputError("method of the paper's session", "one with Algorithm 1", repr(paper.plan.method))
    drawn = {
        "figure4": figures.draw_demonstrations(paper.session.demonstrations, model.labels, model.focus),
        "figure5": figures.draw_similarities(policy_similarities(evidence.distances), model.labels),
        "figure6": figures.draw_maximum_similarity(maximum_similarities(evidence.distances), model.labels),
        "figure7": _draw_reproductions(paper, "The paper's method"),
        "figure7-ours": _draw_reproductions(ours, "Ours"),
        "memberships": figures.draw_memberships(evidence.history, model.labels),
    }
    if ours.model.understanding.belief is not None:
        drawn["why"] = draw_explanation(ours.model)
    for name, figure in drawn.items():
        # Without the date and version of the software the same session gives the same bytes.
        figure.savefig(folder / f"{name}.png", dpi=DOTS_PER_INCH, metadata={"Software": None})


def _draw_reproductions(result: SessionResult, imitator: str) -> Figure:
    """Draw figure 7 of a session, each path in the frame of the object asked for."""
    language = result.plan.language
    paths: dict[tuple[int, int], list[NDArray[np.float64]]] = {request: [] for request in language.requests}
    obeyed: dict[tuple[int, int], list[bool]] = {request: [] for request in language.requests}
    for reproduction in result.reproductions:
        command = reproduction.command
        paths[command.request].append(reproduction.answer.path - command.objects[command.request.focus])
        obeyed[command.request].append(reproduction.obeyed)
    return figures.draw_reproductions(paths, obeyed, language.movements, language.held_back, imitator)
