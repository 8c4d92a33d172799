"""Sessions on the disk: a folder for each, named by the server, with a journal and the tracks of the arm."""

from __future__ import annotations

import logging
import re
import secrets
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from signimit.exceptions import FileFormatError, InvalidInputError, SignimitError
from signimit.io.safe_files import append_record, read_records
from signimit.validation import LARGEST, finite_array
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.store.event_json import event_from_json, event_to_json
from signimit_envs.studio.store.events import Created, Event
from signimit_envs.studio.store.history import History, replay_events

ID_PATTERN = r"^[0-9]{8}-[0-9]{6}-[0-9a-f]{8}$"
_JOURNAL = "journal.jsonl"
_log = logging.getLogger(__name__)


class SessionSummary(NamedTuple):
    """A session in the list of sessions."""

    id: str
    title: str
    created: str
    language: str
    demonstrations: int
    answers: int
    revision: int


class SessionStore:
    """Sessions in one folder, which only one studio at a time may use."""

    def __init__(self, folder: Path) -> None:
        """Lock the folder, making it if it is missing.

        Raises:
            InvalidInputError: If another studio uses it.
            OSError: If it cannot be made.
        """
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._lock = _lock_file(folder / ".lock")
        self._summaries: dict[str, tuple[tuple[int, int], SessionSummary]] = {}

    def close(self) -> None:
        """Unlock the folder; may be called again."""
        self._lock.close()

    def __contains__(self, session: str) -> bool:
        """Tell whether there is such a session."""
        return re.fullmatch(ID_PATTERN, session) is not None and (self._folder / session / _JOURNAL).is_file()

    def create(self, created: Created) -> str:
        """Begin a session and return its name.

        Raises:
            InvalidInputError: If there are too many.
        """
        if sum(1 for _ in self._journals()) >= LIMITS.sessions:
            raise InvalidInputError("sessions", f"at most {LIMITS.sessions}; move some out of the folder", "as many")
        session = f"{time.strftime('%Y%m%d-%H%M%S')}-{secrets.token_hex(4)}"
        (self._folder / session).mkdir()
        self.append(session, created)
        return session

    def append(self, session: str, event: Event) -> None:
        """Add an event to a session's journal; on the disk when this returns.

        Raises:
            InvalidInputError: If the journal is as large as it may become, as it could not be read for ever, or the
                session was deleted.
            OSError: If it cannot be written.
        """
        journal = self._folder / session / _JOURNAL
        if not journal.parent.is_dir():
            raise InvalidInputError("session", "one that is there", "one that was deleted")
        if journal.exists() and journal.stat().st_size >= LIMITS.journal:
            raise InvalidInputError("session", f"at most {LIMITS.journal} bytes; begin another session", "more")
        append_record(journal, event_to_json(event))

    def delete(self, session: str) -> None:
        """Delete a session: its journal first, so that a process that is killed meanwhile leaves no half of one.

        Raises:
            OSError: If it cannot be deleted.
        """
        folder = self._folder / session
        (folder / _JOURNAL).unlink()
        shutil.rmtree(folder)
        self._summaries.pop(session, None)

    def read(self, session: str) -> History:
        """Read a session from its journal, leaving out a line that a killed process left half written.

        Raises:
            SignimitError: Names the line that is no event.
        """
        journal = self._folder / session / _JOURNAL
        events = []
        for number, record in enumerate(read_records(journal), 1):
            try:
                events.append(event_from_json(record))
            except InvalidInputError as error:
                raise error.inside(f"{journal}: line {number}") from None
        return replay_events(events)

    def listed(self) -> list[SessionSummary]:
        """List the sessions, the newest first; one that cannot be read is logged and left out."""
        found = []
        for journal in self._journals():
            try:
                found.append(self._summary(journal))
            except (SignimitError, OSError) as error:
                _log.warning("session %s cannot be read: %s", journal.parent.name, error)
        return sorted(found, key=lambda one: one.id, reverse=True)

    def append_track(self, session: str, answer: int, part: dict[str, Any]) -> None:
        """Append a part of the track of an answer; of a session that was deleted meanwhile nothing is kept."""
        if session in self:
            append_record(self._track(session, answer), part)

    def read_track(self, session: str, answer: int) -> list[dict[str, Any]]:
        """Read the parts of the track of an answer; none if the arm did nothing.

        Raises:
            FileFormatError: Names the line that is no part of a track.
        """
        track = self._track(session, answer)
        parts = read_records(track)
        for number, part in enumerate(parts, 1):
            try:
                steps = len(finite_array(part["path"], "path", (None, 2)))
                count = finite_array(part["objects"], "objects", (steps, None, 2)).shape[1]
                expected = finite_array(parts[0]["objects"], "objects", (None, None, 2)).shape[1]
                if count != expected:
                    raise InvalidInputError("objects", f"{expected} as in line 1", f"{count}")
                if "joints" in part:
                    finite_array(part["joints"], "joints", (steps, 3))
                first, rate = part["first"], finite_array(part["rate"], "rate", ())
                if type(first) is not int or not 0 <= first < LARGEST or not 1 <= rate < LARGEST:
                    raise InvalidInputError("first, rate", "0 or more, and 1 or more", f"{first!r:.40}, {rate:g}")
            except KeyError as error:
                raise FileFormatError(f"{track}: line {number}", f"an entry {error}", "none") from None
            except InvalidInputError as error:
                where = f"{track}: line {number}: {error.where}"
                raise FileFormatError(where, error.expected, error.found) from None
        return parts

    def _track(self, session: str, answer: int) -> Path:
        return self._folder / session / f"track-{answer:d}.jsonl"

    def _journals(self) -> Iterator[Path]:
        return (path for path in self._folder.glob(f"*/{_JOURNAL}") if re.fullmatch(ID_PATTERN, path.parent.name))

    def _summary(self, journal: Path) -> SessionSummary:
        """Summarise a session; its journal is read again only if it has changed."""
        status, session = journal.stat(), journal.parent.name
        stamp = (status.st_size, status.st_mtime_ns)
        known = self._summaries.get(session)
        if known is None or known[0] != stamp:
            history = self.read(session)
            created = history.created
            counts = len(history.shown), len(history.answers), history.revision
            summary = SessionSummary(session, history.title, created.created, created.language, *counts)
            known = stamp, summary
            self._summaries[session] = known
        return known[1]


def _lock_file(path: Path) -> BinaryIO:
    """Open a file with an exclusive lock, which the system releases however the process ends."""
    file = open(path, "ab")  # noqa: SIM115 -- stays open as long as the store
    try:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except ImportError:  # not on Windows
        pass
    except BlockingIOError:
        file.close()
        raise InvalidInputError(f"folder {path.parent}", "no other studio in it", "one that runs") from None
    return file
