"""Run many sessions with different people, scenes and seeds, and say how many commands were obeyed and what failed."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.learners import DEFAULT_METHOD
from signimit.policies import DEFAULT_POLICY
from signimit.teaching.people.choosing import Source, choose_people
from signimit_envs.sessions.many_sessions import SessionOutcome, session_outcome, study_report, study_table
from signimit_envs.sessions.session import SessionPlan, run_session


def main(
    sessions: int = 20,
    first_seed: int = 0,
    method: str = DEFAULT_METHOD,
    policy: str = DEFAULT_POLICY,
    attempts: int = 1,
    seconds: float = 10.0,
    out: Path = Path("out/sessions"),
    signs: Path | None = None,
    movements: Path | None = None,
) -> None:
    """Run sessions like that of `reproduce`, each with other people and scenes, on the physics.

    Args:
        sessions: How many.
        first_seed: Seed of the first; the others follow.
        method: How to learn: joint, paper or paper-literal.
        policy: Kind of policy that moves the hand: path-following, knn, which is the paper's, ilo-gmr, gmr or dmp.
        attempts: How often each of the nine pairs of signs is asked for in a session.
        seconds: How long the arm moves each time.
        out: Folder for sessions.json.
        signs: Stroke library of real people who make the signs, another one each time; left out, synthetic ones.
        movements: Stroke library of real people who show the movements; left out, synthetic ones.
    """
    from tqdm import tqdm

    if sessions < 1:
        raise InvalidInputError("sessions", "at least 1", f"{sessions}")
    outcomes: list[SessionOutcome] = []
    with whole_files(out) as folder:
        for seed in tqdm(range(first_seed, first_seed + sessions), "sessions"):
            plan = SessionPlan(method=method, policy=policy, seed=seed, attempts=attempts, seconds=seconds)
            people = choose_people(plan.language, np.random.default_rng([seed, 1]), Source(signs), Source(movements))
            outcomes.append(session_outcome(run_session(plan, plan.compose(people))))
        print(study_table(outcomes))
        text = json.dumps(study_report(outcomes, method, policy), indent=1)
        (folder / "sessions.json").write_text(text + "\n", encoding="utf-8")
