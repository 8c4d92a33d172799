"""Record what a model does when it is asked, with the full physics state of every control step."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from signimit.learners import DEFAULT_METHOD
from signimit.learning import learn
from signimit.policies import DEFAULT_POLICY
from signimit.teaching.people.choosing import choose_people
from signimit_envs.cli.command_line import check_output_file
from signimit_envs.recording import record_reproductions, save_recording
from signimit_envs.recording.formats import check_vacant_file
from signimit_envs.sessions.session import SessionPlan


def main(
    out: Path = Path("recording.npz"),
    seed: int = 0,
    attempts: int = 1,
    seconds: float = 8.0,
    method: str = DEFAULT_METHOD,
    policy: str = DEFAULT_POLICY,
    overwrite: bool = False,
) -> None:
    """Let a model learn from synthetic people and obey their commands, one recorded episode each.

    Args:
        out: File to write, .npz.
        seed: Decides people, scenes and everything else that is drawn.
        attempts: How often each request is made.
        seconds: How long each episode takes.
        method: How to learn: joint, paper or paper-literal.
        policy: Kind of policy that moves the hand: path-following, knn, ilo-gmr, gmr or dmp.
        overwrite: Replace the file if it is there.
    """
    check_output_file(out, ".npz")
    check_vacant_file(out, overwrite)
    plan = SessionPlan(seed=seed, attempts=attempts, seconds=seconds, method=method, policy=policy)
    session = plan.compose(choose_people(plan.language, np.random.default_rng([seed, 1])))
    model = learn(session.demonstrations, session.prototypes, method, policy, seed)
    recording = record_reproductions(model, session.commands, seconds, plan.language)
    save_recording(out, recording)
    obeyed = sum(bool(episode.infos["is_success"][-1]) for episode in recording)
    print(f"{recording!r} is in {out}; {obeyed} of {len(recording)} requests were fulfilled.")
