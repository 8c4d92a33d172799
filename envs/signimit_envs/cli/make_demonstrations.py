"""Make a set of demonstrations from synthetic or imported people, as input for `learn`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from signimit.io.safe_files import whole_files
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.choosing import Source, choose_people
from signimit.teaching.people.relabelling import with_waver
from signimit_envs.sessions.report import truth_text
from signimit_envs.sessions.session import SessionPlan


def main(
    out: Path = Path("out/demonstrations"),
    seed: int = 0,
    signs: Path | None = None,
    signer: str | None = None,
    movements: Path | None = None,
    mover: str | None = None,
    noise: float = 0.0,
) -> None:
    """Let two people make the paper's 12 demonstrations.

    Writes demonstrations.npz and prototypes.npz for `learn`, signs.npz, the interactant's strokes, for `render`, and
    truth.json, which no learner may read. The same seed gives the demonstrations of `reproduce`.

    Args:
        out: Folder for the files.
        seed: Decides people, scenes and everything else that is drawn.
        signs: Stroke library of real people (see `import-strokes`) who make the signs; left out, a synthetic person.
        signer: Writer of that library; left out, one is drawn.
        movements: Stroke library of real people who show the movements; left out, a synthetic person.
        mover: Writer of that library; left out, one is drawn.
        noise: Root mean square of a slow waver in all that is drawn, in half sizes of a drawing; with 0.18, some
            demonstrations are in doubt.
    """
    plan = SessionPlan(seed=seed)
    rng = np.random.default_rng([seed, 1])
    people = choose_people(plan.language, rng, Source(signs, signer), Source(movements, mover))
    if noise:
        signs_made, movements_made = (with_waver(s, rng, noise) for s in (people.signs, people.movements))
        people = replace(people, signs=signs_made, movements=movements_made)
    session = plan.compose(people)
    labels = plan.language.prototypes
    prototypes = StrokeLibrary(session.prototypes, labels, (people.names[0],) * len(labels), people.signs.source)
    with whole_files(out) as folder:
        session.demonstrations.save(folder / "demonstrations.npz")
        prototypes.save(folder / "prototypes.npz")
        people.signs.save(folder / "signs.npz")
        (folder / "truth.json").write_text(truth_text(session), encoding="utf-8")
    print(f"{len(session.demonstrations)} demonstrations are in {out / 'demonstrations.npz'}. Next:")
    print(f"  python -m signimit learn {out / 'demonstrations.npz'} --prototypes {out / 'prototypes.npz'}")
