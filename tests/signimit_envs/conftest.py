"""One session on the physics, which tests of sessions and films look at and do not change."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from signimit.benchmark.scoring import judge_inference
from signimit.learning import learn
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.choosing import People, choose_people
from signimit_envs.sessions.session import SessionPlan, SessionResult, run_session

PLAN = SessionPlan(attempts=1, seconds=6.0)


@pytest.fixture(scope="session")
def people() -> People[StrokeLibrary]:
    return choose_people(PLAN.language, np.random.default_rng(0))


@pytest.fixture(scope="session")
def results(people: People[StrokeLibrary]) -> dict[str, SessionResult]:
    """A session that the paper's imitator understands as ours does: not all are such. By the names of the imitators."""
    for seed in range(50):
        ours = replace(PLAN, seed=seed)
        paper = ours.as_in_paper()
        session = ours.compose(people)
        model = learn(session.demonstrations, session.prototypes, paper.method, paper.policy, seed)
        if judge_inference(model, session.truth).all_right:
            return {name: run_session(plan, session) for name, plan in (("the paper", paper), ("ours", ours))}
    pytest.fail("in none of 50 sessions did the paper's method understand everything")


@pytest.fixture(scope="session")
def result(results: dict[str, SessionResult]) -> SessionResult:
    """The same session with the default learner and policy."""
    return results["ours"]
