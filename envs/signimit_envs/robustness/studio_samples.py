"""Small valid files of the studio, as `signimit_envs.robustness.samples` has those of the other loaders."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np

from signimit import DemonstrationSet, Stroke, learn
from signimit_envs.robustness.samples import small_demonstrations
from signimit_envs.studio.page.exports import FORMATS as STUDIO_FORMATS
from signimit_envs.studio.page.exports import Lesson
from signimit_envs.studio.store.events import (
    Asked,
    Created,
    Deleted,
    Demonstrated,
    Drafted,
    DrawnDemonstration,
    Insisted,
    Judged,
    Named,
    Redone,
    Redrawn,
    Titled,
    Undone,
)
from signimit_envs.studio.store.sessions import SessionStore

SESSION = "20260102-030405-0123abcd"  # a studio's name for one


def drawn_demonstrations() -> tuple[DrawnDemonstration, ...]:
    """Return demonstrations as the studio keeps them."""
    clock = [0.0, 0.01, 0.02, 0.03]
    return tuple(
        DrawnDemonstration(
            tuple(Stroke(sign, np.array(clock[: len(sign)])) for sign in one.signs),
            one.objects,
            Stroke(one.hand, one.times),
        )
        for one in small_demonstrations()
    )


def write_studio_session(folder: Path) -> Iterator[Path]:
    """Write the journal of a studio's session with events of all kinds, and a track of the arm."""
    shown = drawn_demonstrations()
    with closing(SessionStore(folder / "studio")) as store:
        session = store.create(Created("é", "2026-01-02T03:04:05", "free", 2, 3))
        signs = shown[0].signs
        events = (
            *(Demonstrated(shown[:2]), Demonstrated(shown[2:]), Redrawn(1, shown[0]), Deleted(3), Undone(), Redone()),
            *(Drafted(None, {"sign 1": signs, "hand": ()}), Drafted(1, {"question": signs}), Titled("second")),
            *(Asked(signs, 0, 1, 0.25, None, True, "wave"), Insisted(0), Judged(0, True), Judged(0, None)),
            Named(0, "wave"),
        )
        for event in events:
            store.append(session, event)
        track = {"first": 0, "rate": 50, "path": [[0.0, 0.0], [0.01, 0.0]], "objects": [[[0.1, 0.1]], [[0.1, 0.1]]]}
        store.append_track(session, 0, track)
    (folder / "studio" / session).rename(folder / "studio" / SESSION)
    yield folder / "studio"


def write_studio_exports(folder: Path) -> Iterator[Path]:
    """Write demonstrations in each format that the studio exports and imports."""
    for name, known in STUDIO_FORMATS.items():
        shown = drawn_demonstrations()
        model = learn(DemonstrationSet(one.demonstration for one in shown))
        known.write(Lesson(shown, None, model), folder / name)
        yield folder / name
