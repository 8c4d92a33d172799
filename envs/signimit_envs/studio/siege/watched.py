"""A studio in a process of its own that is watched: its log, its memory, and every file that it touches."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from signimit.exceptions import InvalidInputError
from signimit_envs.studio.load import Memory, resident_memory

SECRET = "this file is not for the studio"
_TROUBLE = re.compile(r"^(ERROR|CRITICAL|Task exception|Fatal|Traceback|[A-Za-z_.]+(Error|Exception|Disconnect)\b)")


class WatchedStudio(NamedTuple):
    """A studio that runs.

    Attributes:
        address: What it printed.
        process: Its process number.
        room: Folder in which it was started; its own folder is ``studio`` in it.
        log: What it says.
        secret: A file that it must not read.
    """

    address: str
    process: int
    room: Path
    log: Path
    secret: Path

    def journal(self, session: str) -> bytes:
        """Return what is kept of a session."""
        return (self.room / "studio" / session / "journal.jsonl").read_bytes()

    def memory(self) -> Memory:
        """Look how large it is.

        Raises:
            OSError: If the system does not tell.
        """
        return resident_memory(self.process)

    def troubles(self) -> list[str]:
        """Return what the log has of failures: each kind once, with its number, and all about the first."""
        lines = self.log.read_text(encoding="utf-8", errors="replace").splitlines()
        found = [n for n, line in enumerate(lines) if _TROUBLE.match(line)]
        kinds = Counter(lines[n] for n in found)
        first = lines[max(0, found[0] - 5) : found[0] + 90] if found else []
        return [*(f"{count} x {line}" for line, count in kinds.most_common(20)), *first]

    def touched(self) -> list[str]:
        """Return the files outside its folder that it touched, and what was left of its temporary ones."""
        told = self.room / "touched.txt"
        left = [f"left {path}" for path in (self.room / "temporary").iterdir()]
        return (told.read_text(encoding="utf-8", errors="replace").splitlines() if told.exists() else []) + left


@contextmanager
def watched_studio(room: Path) -> Iterator[WatchedStudio]:
    """Run a studio in a folder that is empty, or not there yet.

    Raises:
        InvalidInputError: If it does not start.
    """
    folder, temporary, cache, home = (room / name for name in ("studio", "temporary", "cache", "home"))
    for made in (temporary, cache, home):
        made.mkdir(parents=True)
    secret, log = room / "secret.txt", room / "log.txt"
    secret.write_text(SECRET, encoding="utf-8")
    packages = os.pathsep.join(os.path.abspath(place) for place in sys.path if place)
    places = {
        "PYTHONPATH": packages,
        "TMPDIR": str(temporary),
        "MPLCONFIGDIR": str(cache),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [
        sys.executable,
        "-P",
        "-m",
        "signimit_envs.studio.siege.touched",
        *map(str, (room, folder, temporary, cache)),
    ]
    with (
        open(log, "wb") as said,
        subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=said, text=True, cwd=home, env={**os.environ, **places}
        ) as process,
    ):
        try:
            address = process.stdout.readline().strip() if process.stdout else ""
            if not address:
                raise InvalidInputError(
                    "the studio", "its address", log.read_text(errors="replace")[-300:] or "nothing"
                )
            yield WatchedStudio(address, process.pid, room, log, secret)
        finally:
            process.terminate()
