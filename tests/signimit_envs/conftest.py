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
def result(people: People[StrokeLibrary]) -> SessionResult:
    """A session in which the imitator understands everything: not all are such, with the paper's method."""
    for seed in range(50):
        plan = replace(PLAN, seed=seed)
        session = plan.compose(people)
        model = learn(session.demonstrations, session.prototypes, plan.method, plan.policy, seed)
        if judge_inference(model, session.truth).all_right:
            return run_session(plan, people)
    pytest.fail("in none of 50 sessions did the paper's method understand everything")
