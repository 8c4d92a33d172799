"""Make a set of demonstrations from synthetic or imported people, as input for `learn`."""

from __future__ import annotations

import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.relabelling import with_waver
from signimit_envs.cli.options import SYNTHETIC_PEOPLE, PeopleOptions
from signimit_envs.sessions.report import truth_text
from signimit_envs.sessions.session import SessionPlan


def main(
    out: Path = Path("out/demonstrations"),
    seed: int = 0,
    people: PeopleOptions = SYNTHETIC_PEOPLE,
    noise: float = 0.0,
) -> None:
    """Let two people make the paper's 12 demonstrations.

    Writes demonstrations.npz and prototypes.npz for `learn`, signs.npz, the interactant's strokes, for `render`, and
    truth.json, which no learner may read. The same seed gives the demonstrations of `reproduce`.

    Args:
        out: Folder for the files.
        seed: Decides people, scenes and everything else that is drawn.
        people: Who makes the signs and who shows the movements.
        noise: Root mean square of a slow waver in all that is drawn, in half sizes of a drawing; with 0.18, some
            demonstrations are in doubt.
    """
    if not noise >= 0:  # a comparison with NaN is false
        raise InvalidInputError("noise", "zero or more", f"{noise}")
    plan = SessionPlan(seed=seed)
    rng = np.random.default_rng([seed, 1])
    chosen = people.choose(plan.language, rng)
    if noise:
        signs, movements = (with_waver(strokes, rng, noise) for strokes in (chosen.signs, chosen.movements))
        chosen = replace(chosen, signs=signs, movements=movements)
    session = plan.compose(chosen)
    labels = plan.language.prototypes
    prototypes = StrokeLibrary(session.prototypes, labels, (chosen.names[0],) * len(labels), chosen.signs.source)
    with whole_files(out) as folder:
        session.demonstrations.save(folder / "demonstrations.npz")
        prototypes.save(folder / "prototypes.npz")
        chosen.signs.save(folder / "signs.npz")
        (folder / "truth.json").write_text(truth_text(session), encoding="utf-8")
    print(f"{len(session.demonstrations)} demonstrations are in {out / 'demonstrations.npz'}. Next:")
    print(f"  {shlex.join(['python', '-m', 'signimit', 'learn', str(out / 'demonstrations.npz'), '--why', 'why.png'])}")
