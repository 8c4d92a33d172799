"""Show a model two signs in a scene, and film what the arm does."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.learning import ImitationModel
from signimit.strokes import StrokeLibrary
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit_envs.cli.command_line import check_output_file
from signimit_envs.sessions.session import answer_signs
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.video.films import film_shots
from signimit_envs.video.mp4 import write_video
from signimit_envs.video.storyboard import FRAME_RATE, show_answer


def main(
    model: Path,
    /,
    *,
    signs: Path,
    words: tuple[str, ...],
    sample: int = 0,
    objects: tuple[float, ...] | None = None,
    hand: tuple[float, float] | None = None,
    seed: int = 0,
    seconds: float = 8.0,
    out: Path = Path("answer.mp4"),
) -> None:
    """Let a model answer signs in a scene, on the physics, and write a video.

    Args:
        model: Model file, as `learn` writes it.
        signs: Stroke library with the signs, e.g. signs.npz of `make-demonstrations`.
        words: Labels of the signs that are made, in their order, e.g. "1 6".
        sample: Which of the library's strokes with these labels to take, from 0.
        objects: x and y of each object, m, e.g. "-0.2 0.1 0.1 0.1 0 -0.1"; left out, drawn.
        hand: x and y of where the hand starts, m; left out, drawn.
        seed: Decides what is drawn.
        seconds: How long the arm moves.
        out: Video to write, mp4.
    """
    check_output_file(out, ".mp4")
    learned, library = ImitationModel.load(model), StrokeLibrary.load(signs)
    rng, count = np.random.default_rng(seed), learned.demonstrations.objects.shape[1]
    if objects is not None and len(objects) != 2 * count:
        raise InvalidInputError("objects", f"x and y of {count} objects", f"{len(objects)} numbers")
    places = sample_scene(rng, count) if objects is None else np.reshape(objects, (count, 2))
    start = sample_hand(rng) if hand is None else np.array(hand)
    strokes = [pick(library, word, sample) for word in words]
    with closing(TabletopHandEnv(objects=count)) as env:
        answer = answer_signs(learned, strokes, places, start, seconds, env)
    asked = learned.names.request(answer.movement, answer.focus)
    understood = f"{asked}, confidence {answer.confidence:.2f}"
    print(f"Understood: {understood}.")
    captions = (f"The signs {' '.join(words)} are made", f"The robot understood {understood}")
    film = film_shots(list(show_answer(strokes, places, answer, captions)), count)
    write_video(out, film.frames, FRAME_RATE)
    print(f"The video is {out}.")


def pick(library: StrokeLibrary, word: str, sample: int) -> np.ndarray:
    """Return a stroke with a label, shape (T, 2).

    Raises:
        SignimitError: If there is none.
    """
    drawn = library.select(word)
    if not 0 <= sample < len(drawn):
        raise InvalidInputError("sample", f"0 to {len(drawn) - 1}, as there are {len(drawn)} of {word!r}", f"{sample}")
    return drawn[sample].points
