"""The process of a watched studio: it tells every file outside its own folders that it touches.

``python -m signimit_envs.studio.siege.touched ROOM FOLDER OTHER ...`` serves the sessions in FOLDER; it may also use
the other folders, nothing else in ROOM, and write nowhere else at all.
"""

from __future__ import annotations

import dataclasses
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from signimit_envs.studio import limits

_READS = {"os.listdir": 1, "os.scandir": 1}
_WRITES = {
    **dict.fromkeys(("os.mkdir", "os.remove", "os.rmdir", "os.chmod", "os.truncate"), 1),
    **dict.fromkeys(("os.rename", "os.link", "os.symlink"), 2),
}
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
_UNLIMITED = dict.fromkeys(("requests", "burst", "messages"), 10**9)


def watch_files(room: Path, own: Sequence[Path], tell: Callable[[str], object]) -> None:
    """Look at every file and folder that this process opens, lists or changes from now on.

    Args:
        room: Folder in which nothing but ``own`` may be touched.
        own: Folders in which everything may be done; elsewhere on the machine files may be read.
        tell: Told what else was touched, a line for each.
    """

    def watch(event: str, given: tuple[Any, ...]) -> None:
        if event == "open":
            writes, paths = bool(given[2] & _WRITING), given[:1]
        elif event in _WRITES:
            writes, paths = True, given[: _WRITES[event]]
            if event in ("os.remove", "os.rmdir") and given[1] >= 0:  # relative to an open folder
                paths = (os.path.join(os.readlink(f"/proc/self/fd/{given[1]}"), given[0]),)
        elif event in _READS:
            writes, paths = False, given[:1]
        else:
            return
        for path in paths:
            if not isinstance(path, str | bytes):  # a file that is open already
                continue
            whole = Path(os.path.abspath(os.fsdecode(path)))
            if any(whole.is_relative_to(place) for place in own) or whole.is_relative_to("/dev"):
                continue
            if writes or whole.is_relative_to(room):
                tell(f"{event} {whole}")

    sys.addaudithook(watch)


def main(room: Path, folder: Path, *others: Path) -> None:
    """Serve a studio whose rates are not limited, or hardly a request would reach it."""
    limits.LIMITS = dataclasses.replace(limits.LIMITS, **_UNLIMITED)  # before anything else takes them from there
    from signimit_envs.studio.web.serving import StudioPlan, serve_studio

    told = os.open(room / "touched.txt", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    watch_files(room, (folder, *others), lambda line: os.write(told, f"{line}\n".encode(errors="replace")))
    serve_studio(StudioPlan(folder=folder), lambda address: print(address, flush=True))


if __name__ == "__main__":
    main(*(Path(name).resolve() for name in sys.argv[1:]))
