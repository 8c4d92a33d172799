"""Replay recorded episodes exactly, or show them with another observation."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.io.archive import MAX_BYTES, write_archive
from signimit_envs.cli.command_line import check_output_file
from signimit_envs.recording import (
    RecordedEpisode,
    Recording,
    film_states,
    find_divergence,
    observe_states,
)
from signimit_envs.recording.formats import check_vacant_file, read_recording
from signimit_envs.video.mp4 import write_video


def main(
    recording: str,
    /,
    *,
    observe: Literal["state", "pixels"] = "state",
    episode: int = 0,
    camera: str = "perspective",
    size: tuple[int, int] = (480, 480),
    out: Path | None = None,
    overwrite: bool = False,
) -> None:
    """Simulate every recorded episode again and compare each physics state bit for bit; show one differently.

    Ends with code 2 and the first step that differs if one does. With --out, one episode is written instead as it would
    have been observed: from its recorded states, so also where a simulation would differ.

    Args:
        recording: Recorded episodes: a .npz file; a folder of CSV tables, of Minari or of LeRobot; or minari:NAME.
        observe: What to write: the state (.npz) or pixels (.mp4, or .npz with every frame).
        episode: Which episode to write, from 0.
        camera: Camera of the pixels, "perspective" or "top".
        size: Width and height of the pixels.
        out: File to write.
        overwrite: Replace the file if it is there.
    """
    if out is not None:
        check_output_file(out, *((".npz",) if observe == "state" else (".npz", ".mp4")))
    recorded = read_recording(recording)
    note = recorded.origin.version_note()
    if note:
        sys.stderr.write(f"note: {note}\n")
    if out is None:
        check(recorded)
        return
    if not 0 <= episode < len(recorded):
        raise InvalidInputError("episode", f"0 to {len(recorded) - 1}", f"{episode}")
    check_vacant_file(out, overwrite)
    chosen = recorded[episode]
    if observe == "state":
        write_archive(out, "replayed state", 1, observe_states(recorded.origin, chosen))
    elif out.suffix.lower() == ".npz":
        write_archive(out, "replayed pixels", 1, {"pixels": film_array(recorded, chosen, camera, size)})
    else:
        write_video(out, film_states(recorded.origin, chosen, camera, size))
    print(f"Episode {episode}, {len(chosen)} steps, is in {out}.")


def film_array(recorded: Recording, episode: RecordedEpisode, camera: str, size: tuple[int, int]) -> NDArray[np.uint8]:
    """Draw an episode into one array, shape (T + 1, height, width, 3).

    Raises:
        InvalidInputError: If that is more than a file may hold.
    """
    total = len(episode.states) * size[0] * size[1] * 3
    if total > MAX_BYTES:
        raise InvalidInputError("pixels", f"at most {MAX_BYTES} bytes in a .npz file", f"{total}")
    return np.stack(list(film_states(recorded.origin, episode, camera, size)))


def check(recorded: Recording) -> None:
    """Simulate all episodes again.

    Raises:
        InvalidInputError: If one leaves the recording.
    """
    for number, episode in enumerate(recorded):
        apart = find_divergence(recorded.origin, episode)
        if apart is not None:
            place, found = f"episode {number}, step {apart.step}", f"a difference of {apart.difference:g}"
            raise InvalidInputError(place, "the recorded state, bit for bit", found)
    steps = sum(map(len, recorded))
    print(f"{len(recorded)} episodes, {steps} control steps: every state is as recorded, bit for bit.")
