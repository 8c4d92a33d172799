"""The main job: one session, and what the paper's imitator and ours make of it on the simulated arm."""

from __future__ import annotations

import json
from concurrent.futures import Future
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import numpy as np

from signimit.benchmark.workers import SessionProcesses
from signimit.io.safe_files import whole_files
from signimit.learners import DEFAULT_METHOD
from signimit.policies import DEFAULT_POLICY
from signimit_envs.cli.options import SYNTHETIC_PEOPLE, PeopleOptions
from signimit_envs.exceptions import RenderingError
from signimit_envs.sessions.report import restarts_line, session_report, session_table
from signimit_envs.sessions.session import SessionPlan, SessionResult, run_session
from signimit_envs.video.films import film_grid, film_story
from signimit_envs.video.mp4 import write_video
from signimit_envs.video.storyboard import FRAME_RATE


def main(
    out: Path = Path("out/reproduce"),
    seed: int = 0,
    method: str = DEFAULT_METHOD,
    policy: str = DEFAULT_POLICY,
    attempts: int = 4,
    seconds: float = 10.0,
    people: PeopleOptions = SYNTHETIC_PEOPLE,
    video: bool = True,
) -> None:
    """Watch 12 demonstrations, learn, and obey 36 commands with a simulated arm, four for each pair of signs, twice.

    Two imitators see the same demonstrations and are asked the same: the paper's (Algorithm 1 and the 50 nearest
    points, sections II-A to II-E) and ours. Writes results.json with both, figures 4 to 7 and the memberships of the
    paper's, figure7-ours.png, why.png (the reasons of ours), and the films grid.mp4 and story.mp4 of ours.

    Args:
        out: Folder for the results.
        seed: Decides people, scenes and everything else that is drawn. 0 was chosen by nobody; 35 is the session in
            which the paper's figures come out; `sessions` shows what other seeds give.
        method: How our imitator learns: joint, paper or paper-literal.
        policy: Kind of policy that moves the hand of our imitator: path-following, knn, ilo-gmr, gmr or dmp.
        attempts: How often each of the nine pairs of signs is asked for.
        seconds: How long the arm moves each time.
        people: Who makes the signs and who shows the movements.
        video: Whether to make the videos.
    """
    from tqdm import tqdm

    from signimit_envs.sessions.figures import write_figures

    ours = SessionPlan(method=method, policy=policy, seed=seed, attempts=attempts, seconds=seconds)
    chosen = people.choose(ours.language, np.random.default_rng([seed, 1]))
    print(f"Session {seed}. The signs are made by {chosen.names[0]}, the movements by {chosen.names[1]}.")
    session = ours.compose(chosen)

    def obey(name: str, plan: SessionPlan) -> SessionResult:
        result = run_session(plan, session, partial(tqdm, desc=f"obeying, {name}", unit="command"))
        print(f"\n{name.capitalize()}: {result.model.summary()}", flush=True)
        return result

    with whole_files(out) as folder, ExitStack() as stack:
        our_result, films = obey("ours", ours), dict[str, Future[None]]()
        if video:  # filming takes longest, so processes of their own begin while the paper's imitator is at work
            processes = stack.enter_context(SessionProcesses(len(FILMS)))
            films = {name: processes.submit(write_film, name, our_result, folder) for name in FILMS}
        results = {"the paper": obey("the paper", ours.as_in_paper()), "ours": our_result}
        print(f"\n{session_table(results)}\n\n{restarts_line(results['the paper'])}\n", flush=True)
        text = json.dumps(session_report(results, chosen), indent=1, allow_nan=False)
        (folder / "results.json").write_text(text + "\n", encoding="utf-8")
        write_figures(results["the paper"], results["ours"], folder)
        try:
            for name, film in films.items():
                print(f"{name}.mp4 is being filmed.", flush=True)
                film.result()
        except RenderingError as error:
            print(f"No videos. {error}")
    print(f"Results are in {out}.")


FILMS = {"story": film_story, "grid": film_grid}
"""Films of a session, by the name of their file."""


def write_film(name: str, result: SessionResult, folder: Path) -> None:
    """Write a film of a session.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    write_video(folder / f"{name}.mp4", FILMS[name](result).frames, FRAME_RATE)
