#!/usr/bin/env python3
"""Convert demonstrations or recorded episodes from one format to another, without losing a bit."""

from __future__ import annotations

from typing import Literal

from signimit.command_line import run_program
from signimit.exceptions import InvalidInputError
from signimit_envs.recording.exchange import MINARI_PREFIX, read_data, write_data


def main(
    source: str,
    target: str,
    /,
    *,
    to: Literal["npz", "csv", "minari", "lerobot"] | None = None,
    overwrite: bool = False,
) -> None:
    """Read a data set in any format, and write it in another, whole or not at all.

    Args:
        source: A .npz file; a folder of CSV tables, of Minari or of LeRobot; or minari:NAME of a Minari data set.
        target: A .npz file, a folder, or minari:NAME.
        to: Format to write; left out, it follows from the target: .npz or minari:.
        overwrite: Replace a data set of that format that is there.
    """
    name = to or ("minari" if target.startswith(MINARI_PREFIX) else "npz" if target.endswith(".npz") else None)
    if name is None:
        raise InvalidInputError(target, "a name that says its format, or --to", "neither")
    data = read_data(source)
    write_data(target, data, name, overwrite)
    print(f"{data!r} is in {target} ({name}).")


if __name__ == "__main__":
    run_program(main)
