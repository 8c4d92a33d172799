"""Convert demonstrations or recorded episodes from one format to another, without losing a bit."""

from __future__ import annotations

import sys
from typing import Literal

from signimit.exceptions import InvalidInputError
from signimit_envs.exceptions import RenderingError
from signimit_envs.recording import Recording
from signimit_envs.recording.formats import MINARI_PREFIX, read_data, write_data
from signimit_envs.recording.formats.lerobot.recordings import SIZE, write_lerobot_recording
from signimit_envs.video.rendering import choose_backend


def main(
    source: str,
    target: str,
    /,
    *,
    to: Literal["npz", "csv", "minari", "lerobot"] | None = None,
    overwrite: bool = False,
    cameras: tuple[str, ...] | None = None,
    size: tuple[int, int] = SIZE,
) -> None:
    """Read a data set in any format, and write it in another, whole or not at all.

    Args:
        source: A .npz file; a folder of CSV tables, of Minari or of LeRobot; or minari:NAME of a Minari data set.
        target: A .npz file, a folder, or minari:NAME.
        to: Format to write; left out, it follows from the target: .npz or minari:.
        overwrite: Replace a data set of that format that is there.
        cameras: Cameras to film recorded episodes with for LeRobot; left out, all of them where there is OpenGL.
        size: Width and height of these videos, pixels.
    """
    name = to or ("minari" if target.startswith(MINARI_PREFIX) else "npz" if target.endswith(".npz") else None)
    if name is None:
        raise InvalidInputError(target, "a name that says its format, or --to", "neither")
    data = read_data(source)
    if name == "lerobot" and isinstance(data, Recording):
        if cameras is None:
            note_missing_videos()
        write_lerobot_recording(target, data, overwrite, cameras, size)
    else:
        write_data(target, data, name, overwrite)
    print(f"{data!r} is in {target} ({name}).")


def note_missing_videos() -> None:
    """Say why there will be no videos, if so."""
    try:
        choose_backend()
    except RenderingError as error:
        sys.stderr.write(f"note: No videos. {error}\n")
