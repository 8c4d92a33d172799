"""The main job: demonstrations, learning, and 36 commands obeyed by a simulated arm."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from signimit.io.safe_files import whole_files
from signimit.policies import DEFAULT_POLICY
from signimit.teaching.people.choosing import Source, choose_people
from signimit_envs.exceptions import RenderingError
from signimit_envs.sessions.report import inference_lines, session_report, session_table
from signimit_envs.sessions.session import SessionPlan, SessionResult, run_session
from signimit_envs.video.films import film_grid, film_story
from signimit_envs.video.mp4 import write_video
from signimit_envs.video.storyboard import FRAME_RATE


def main(
    out: Path = Path("out/reproduce"),
    method: str = "paper",
    policy: str = DEFAULT_POLICY,
    seed: int = 35,
    attempts: int = 4,
    seconds: float = 10.0,
    signs: Path | None = None,
    signer: str | None = None,
    movements: Path | None = None,
    mover: str | None = None,
    video: bool = True,
) -> None:
    """Watch 12 demonstrations, learn, and obey 36 commands with a simulated arm, four for each pair of signs.

    Writes results.json, the paper's figures 4 to 7, the memberships, grid.mp4 and story.mp4; with --method joint also
    why.png, the reasons.

    Args:
        out: Folder for the results.
        method: How to learn; "paper" is the paper.
        policy: Kind of policy that moves the hand; "knn" is the paper's.
        seed: Decides people, scenes and everything else that is drawn. 35 is the first with which synthetic people
            repeat all of the paper's result; `sessions` shows what other seeds give.
        attempts: How often each of the nine pairs of signs is asked for.
        seconds: How long the arm moves each time.
        signs: Stroke library of real people (see `import-strokes`) who make the signs; left out, a synthetic person.
        signer: Writer of that library; left out, one is drawn.
        movements: Stroke library of real people who show the movements; left out, a synthetic person.
        mover: Writer of that library; left out, one is drawn.
        video: Whether to make the videos.
    """
    from tqdm import tqdm

    from signimit_envs.sessions.figures import write_figures

    plan = SessionPlan(method=method, policy=policy, seed=seed, attempts=attempts, seconds=seconds)
    rng = np.random.default_rng([seed, 1])
    people = choose_people(plan.language, rng, Source(signs, signer), Source(movements, mover))
    print(f"The signs are made by {people.names[0]}, the movements by {people.names[1]}.")
    with whole_files(out) as folder:
        result = run_session(plan, people, lambda commands: tqdm(commands, "obeying", unit="command"))
        print(f"\n{result.model.summary()}\n\n{inference_lines(result)}\n\n{session_table(result)}\n")
        text = json.dumps(session_report(result, people), indent=1, allow_nan=False)
        (folder / "results.json").write_text(text + "\n", encoding="utf-8")
        write_figures(result, folder)
        if video:
            write_videos(result, folder)
    print(f"Results are in {out}.")


def write_videos(result: SessionResult, folder: Path) -> None:
    """Write grid.mp4 and story.mp4; say so and go on where there is no OpenGL."""
    from tqdm import tqdm

    try:
        for name, film in (("grid", film_grid(result)), ("story", film_story(result))):
            frames = tqdm(film.frames, f"filming {name}.mp4", film.length, unit="frame")
            write_video(folder / f"{name}.mp4", frames, FRAME_RATE)
    except RenderingError as error:
        print(f"No videos. {error}")
