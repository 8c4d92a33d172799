"""Figures 4 to 7 of the paper, similarity matrices and films of a session."""

from __future__ import annotations

import io
import math
import tempfile
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.learning import ImitationModel
from signimit.similarity import maximum_similarities, policy_distances, policy_similarities
from signimit_envs.sessions.session import ArmAnswer
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page.belief import understood_text
from signimit_envs.studio.page.dark_figures import darken_figure
from signimit_envs.studio.store.events import DrawnDemonstration
from signimit_envs.studio.store.history import Answer
from signimit_envs.video.films import film_shots
from signimit_envs.video.mp4 import write_video
from signimit_envs.video.storyboard import FRAME_RATE, STRIDE, Shot, show_answer, show_exchange

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = range(4, 8)
DOTS_PER_INCH = 110
_KEPT_FIGURES = 24  # of a fifth of a megabyte each
FILM_SECONDS = 20.0  # of an answer or a demonstration; drawing takes about as long as watching
_COMPARED = 60_000  # points of all paths in all frames; ten times as many take a hundred times as long, minutes
Track = Sequence[dict[str, Any]]


class FigureCache:
    """The bytes of the latest figures by what they show; for any thread, as each access is one operation."""

    def __init__(self, most: int = _KEPT_FIGURES) -> None:
        """Start empty; of more than ``most`` figures the oldest ones go."""
        self._most = most
        self._figures: dict[Hashable, bytes] = {}

    def find(self, key: Hashable) -> bytes | None:
        """Return a figure, if it is kept."""
        return self._figures.get(key)

    def find_or_draw(self, key: Hashable, draw: Callable[[], bytes]) -> bytes:
        """Return a figure; draw and keep it if it is not kept. For one thread at a time."""
        found = self.find(key)
        if found is None:
            found = self._figures[key] = draw()
            for oldest in list(self._figures)[: -self._most]:
                del self._figures[oldest]
        return found


def draw_figure(
    number: int, suffix: str, model: ImitationModel, answers: Sequence[tuple[Answer, Track]], look: str = "light"
) -> bytes:
    """Draw one of the paper's figures 4 to 7.

    Args:
        number: 4 the demonstrations, 5 the similarities in all frames, 6 the largest of them, 7 the answers.
        suffix: ``"png"`` or ``"svg"``.
        model: What was learned.
        answers: What the arm was asked, and what it did; for figure 7.
        look: ``"light"``, as on paper, or ``"dark"``.

    Returns:
        The file's bytes.

    Raises:
        InvalidInputError: If there is too little or too much to draw.
        MissingDependencyError: If matplotlib is not installed.
    """
    from signimit.plots import paper as figures

    count = len(model.demonstrations)
    if count > LIMITS.drawn:
        raise InvalidInputError("figure", f"at most {LIMITS.drawn} demonstrations", f"{count}")
    if number == 4:
        figure = figures.draw_demonstrations(model.demonstrations, model.labels, model.focus)
    elif number == 7:
        figure = _draw_answers(model, answers)
    else:
        distances = _distances(model)
        if number == 5:
            figure = figures.draw_similarities(policy_similarities(distances), model.labels)
        else:
            figure = figures.draw_maximum_similarity(maximum_similarities(distances), model.labels)
    if look == "dark":
        darken_figure(figure)
    file = io.BytesIO()
    figure.savefig(file, format=suffix, dpi=DOTS_PER_INCH)
    return file.getvalue()


def similarities_json(model: ImitationModel) -> dict[str, Any]:
    """Return the matrices of figures 5 and 6, 1/rad².

    Raises:
        InvalidInputError: If there is too little or too much to compare.
    """
    if len(model.demonstrations) > LIMITS.drawn:
        raise InvalidInputError(
            "similarities", f"at most {LIMITS.drawn} demonstrations", f"{len(model.demonstrations)}"
        )
    distances = _distances(model)
    by_frames = policy_similarities(distances).transpose(2, 3, 0, 1)
    return {
        "labels": model.labels.tolist(),
        "order": np.lexsort((model.labels, model.labels < 0)).tolist(),
        "maximum": np.round(maximum_similarities(distances), 3).tolist(),
        "frames": np.round(by_frames, 3).tolist(),
    }


def film_demonstration(shown: DrawnDemonstration, number: int) -> bytes:
    """Film a demonstration, a long one sped up, as the bytes of an mp4 file.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    speedup = math.ceil(len(shown.hand) / (FILM_SECONDS * FRAME_RATE * STRIDE))
    title = f"Demonstration {number + 1}" + (f", {speedup} times as fast" if speedup > 1 else "")
    return _film(show_exchange(shown.demonstration, title, speedup), len(shown.objects))


def film_answer(answer: Answer, track: Track) -> bytes:
    """Film the first seconds of an answer, objects that are dragged included, as the bytes of an mp4 file.

    Raises:
        InvalidInputError: If the arm did nothing.
        RenderingError: If there is no OpenGL.
    """
    path, joints, objects = (_whole(track, name) for name in ("path", "joints", "objects"))
    asked, end = answer.asked, round(FILM_SECONDS * track[0]["rate"])
    reproduction = ArmAnswer(asked.movement, asked.focus, asked.confidence, path[:end], joints[:end])
    captions = "Signs for the robot", f"The robot: {understood_text(asked.movement, asked.focus, asked.confidence)}"
    shots = show_answer([sign.points for sign in asked.signs], objects[0], reproduction, captions)
    moved = (replace(shot, objects=objects[max(0, len(shot.trail) - 1)]) for shot in shots)
    return _film(moved, objects.shape[1])


def _film(shots: Iterator[Shot], objects: int) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        write_video(path, film_shots(list(shots), objects).frames, FRAME_RATE)
        return path.read_bytes()


def _distances(model: ImitationModel) -> NDArray[np.float64]:
    if len(model.demonstrations) < 2:
        raise InvalidInputError("session", "at least two demonstrations to compare", "one")
    paths, objects = model.demonstrations.paths, model.demonstrations.objects
    most = _COMPARED // (len(paths) * objects.shape[1])
    return policy_distances([_thinned(path, most) for path in paths], objects)


def _thinned(path: NDArray[np.float64], most: int) -> NDArray[np.float64]:
    """Return at most so many points of a path, the first and the last among them."""
    return path[np.linspace(0, len(path) - 1, min(most, len(path))).round().astype(np.intp)]


def _draw_answers(model: ImitationModel, answers: Sequence[tuple[Answer, Track]]) -> Figure:
    from signimit.plots import paper as figures

    paths: dict[tuple[int, int], list[NDArray[np.float64]]] = {}
    obeyed: dict[tuple[int, int], list[bool | None]] = {}
    for answer, track in answers:
        if not track:
            continue
        key = answer.asked.movement, answer.asked.focus
        objects = _whole(track, "objects")
        if objects.shape[1] <= answer.asked.focus:
            raise InvalidInputError("answer", "a movement of the arm among the session's objects", "others")
        paths.setdefault(key, []).append(_whole(track, "path") - objects[:, answer.asked.focus])
        obeyed.setdefault(key, []).append(answer.good)
    if not paths:
        raise InvalidInputError("figure 7", "at least one answer of the arm", "none")
    names = [f"movement {m + 1}" for m in range(1 + max(movement for movement, _ in paths))]
    shown = set(zip(model.labels.tolist(), model.focus.tolist(), strict=True))
    return figures.draw_reproductions(paths, obeyed, names, frozenset(set(paths) - shown))


def _whole(track: Track, name: str) -> NDArray[np.float64]:
    if not track:
        raise InvalidInputError("answer", "a movement of the arm", "none")
    if any(name not in part for part in track):
        raise InvalidInputError("answer", f"a movement of the arm with {name}", "one without")
    return np.array([row for part in track for row in part[name]], dtype=np.float64)
