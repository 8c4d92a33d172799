"""Convert demonstrations or recorded episodes from one format to another, without losing a bit."""

from __future__ import annotations

from typing import Literal

from signimit.exceptions import InvalidInputError
from signimit_envs.recording import Recording
from signimit_envs.recording.formats import MINARI_PREFIX, read_data, write_data
from signimit_envs.recording.formats.lerobot.recordings import SIZE, write_lerobot_recording


def main(
    source: str,
    target: str,
    /,
    *,
    to: Literal["npz", "csv", "minari", "lerobot"] | None = None,
    overwrite: bool = False,
    cameras: tuple[str, ...] = (),
    size: tuple[int, int] = SIZE,
) -> None:
    """Read a data set in any format, and write it in another, whole or not at all.

    Args:
        source: A .npz file; a folder of CSV tables, of Minari or of LeRobot; or minari:NAME of a Minari data set.
        target: A .npz file, a folder, or minari:NAME.
        to: Format to write; left out, it follows from the target: .npz or minari:.
        overwrite: Replace a data set of that format that is there.
        cameras: Cameras to film recorded episodes with for LeRobot, "top", "perspective" or both; left out,
            there are no videos.
        size: Width and height of these videos, pixels.
    """
    name = to or ("minari" if target.startswith(MINARI_PREFIX) else "npz" if target.lower().endswith(".npz") else None)
    if name is None:
        raise InvalidInputError(target, "a name that says its format, or --to", "neither")
    if target.lower().endswith(".npz") != (name == "npz"):
        ends = "ends" if name == "npz" else "does not end"
        raise InvalidInputError(target, f"a name that {ends} in .npz for the format {name}", "another")
    data = read_data(source)
    films = name == "lerobot" and isinstance(data, Recording)
    if cameras and not films:
        raise InvalidInputError("--cameras", "recorded episodes, and --to lerobot", f"{data!r}, and {name}")
    if name == "lerobot" and isinstance(data, Recording):
        write_lerobot_recording(target, data, overwrite, cameras, size)
    else:
        write_data(target, data, name, overwrite)
    print(f"{data!r} is in {target} ({name}).")
