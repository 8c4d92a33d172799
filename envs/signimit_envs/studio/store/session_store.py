"""Where sessions are kept: a folder for each, named by us, with a journal and the tracks of the arm."""

from __future__ import annotations

import logging
import re
import secrets
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from signimit.exceptions import InvalidInputError, SignimitError
from signimit.io.safe_files import append_record, read_records
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.store.events import Created, Event, event_from_json, event_to_json
from signimit_envs.studio.store.history import History, retell

ID_PATTERN = r"^[0-9]{8}-[0-9]{6}-[0-9a-f]{8}$"
_JOURNAL = "journal.jsonl"
_log = logging.getLogger(__name__)


class Listed(NamedTuple):
    """What the list of sessions says of one."""

    id: str
    title: str
    created: str
    language: str
    demonstrations: int
    answers: int
    revision: int


class Shelf:
    """The sessions in one folder; only one studio at a time may have it."""

    def __init__(self, folder: Path) -> None:
        """Take the folder, making it if it is missing.

        Raises:
            InvalidInputError: If another studio has it.
            OSError: If it cannot be made.
        """
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._lock = _locked(folder / ".lock")
        self._listed: dict[str, tuple[tuple[int, int], Listed]] = {}

    def close(self) -> None:
        """Leave the folder to others; may be called again."""
        self._lock.close()

    def __contains__(self, session: str) -> bool:
        """Tell whether there is such a session."""
        return re.fullmatch(ID_PATTERN, session) is not None and (self._folder / session / _JOURNAL).is_file()

    def create(self, created: Created) -> str:
        """Begin a session and return its name.

        Raises:
            InvalidInputError: If the shelf is full.
        """
        if sum(1 for _ in self._journals()) >= LIMITS.sessions:
            raise InvalidInputError("sessions", f"at most {LIMITS.sessions}; move some out of the folder", "as many")
        session = f"{time.strftime('%Y%m%d-%H%M%S')}-{secrets.token_hex(4)}"
        (self._folder / session).mkdir()
        self.append(session, created)
        return session

    def append(self, session: str, event: Event) -> None:
        """Add an event to a session's journal; on the disk when this returns."""
        append_record(self._folder / session / _JOURNAL, event_to_json(event))

    def read(self, session: str) -> History:
        """Return a session as its journal tells it, leaving out what a killed process left half written.

        Raises:
            SignimitError: Names the line that is not ours.
        """
        journal = self._folder / session / _JOURNAL
        return retell(self._events(journal))

    def listed(self) -> list[Listed]:
        """Return what sessions there are, the newest first; one that cannot be read is logged and left out."""
        found = []
        for journal in self._journals():
            try:
                found.append(self._look_at(journal))
            except (SignimitError, OSError) as error:
                _log.warning("session %s cannot be read: %s", journal.parent.name, error)
        return sorted(found, key=lambda one: one.id, reverse=True)

    def append_track(self, session: str, answer: int, part: dict[str, Any]) -> None:
        """Add to what the arm did in an answer."""
        append_record(self._track(session, answer), part)

    def read_track(self, session: str, answer: int) -> list[dict[str, Any]]:
        """Return what the arm did in an answer, part by part; empty if nothing."""
        return read_records(self._track(session, answer))

    def _track(self, session: str, answer: int) -> Path:
        return self._folder / session / f"track-{answer:d}.jsonl"

    def _journals(self) -> Iterator[Path]:
        return (path for path in self._folder.glob(f"*/{_JOURNAL}") if re.fullmatch(ID_PATTERN, path.parent.name))

    def _look_at(self, journal: Path) -> Listed:
        """Return what the list says of a session; read again only if the journal has changed."""
        status, session = journal.stat(), journal.parent.name
        stamp = (status.st_size, status.st_mtime_ns)
        known = self._listed.get(session)
        if known is None or known[0] != stamp:
            history = retell(self._events(journal))
            created = history.created
            counts = len(history.shown), len(history.answers), history.revision
            known = stamp, Listed(session, history.title, created.created, created.language, *counts)
            self._listed[session] = known
        return known[1]

    @staticmethod
    def _events(journal: Path) -> Iterator[Event]:
        for number, line in enumerate(read_records(journal), 1):
            try:
                yield event_from_json(line)
            except InvalidInputError as error:
                raise error.inside(f"{journal}: line {number}") from None


def _locked(path: Path) -> BinaryIO:
    """Open a file that nobody else has open like this; the system lets go of it when the process ends, however."""
    file = open(path, "ab")  # noqa: SIM115 -- stays open as long as the shelf
    try:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except ImportError:  # not on Windows
        pass
    except BlockingIOError:
        file.close()
        raise InvalidInputError(f"folder {path.parent}", "no other studio in it", "one that runs") from None
    return file
