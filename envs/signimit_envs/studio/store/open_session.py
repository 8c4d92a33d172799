"""A session that somebody works on: one change at a time, on the disk first, understood after each."""

from __future__ import annotations

import asyncio
import functools
from collections import deque
from concurrent.futures import Executor

from signimit.exceptions import InvalidInputError, SignimitError
from signimit.learning import ImitationModel
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.store.events import Asked, Created, Deleted, Demonstrated, Event, Judged, Redrawn
from signimit_envs.studio.store.history import History, after
from signimit_envs.studio.store.session_store import Shelf
from signimit_envs.studio.store.understanding import Understood, understand

_REMEMBERED = 8  # states of the demonstrations whose models are kept


class StaleRevisionError(SignimitError, ValueError):
    """Somebody changed the session since the page last saw it.

    Attributes:
        latest: The revision that the session is at.
        found: The revision that the page last saw.
    """

    def __init__(self, latest: int, found: int) -> None:
        """Keep the facts."""
        self.latest, self.found = latest, found
        super().__init__(latest, found)

    def __str__(self) -> str:
        """Return the sentence."""
        return f"Another tab changed this session: it is at revision {self.latest}, not {self.found}."


class OpenSession:
    """A session with its model. All changes go through `edit` and `note`, one after the other."""

    def __init__(self, name: str, shelf: Shelf, history: History, learner: Executor) -> None:
        """Take a session that was read; `understood` comes with the first call of `prepare`."""
        self.name, self.history = name, history
        self._shelf, self._learner = shelf, learner
        self._lock = asyncio.Lock()
        self._understood: Understood | None = None
        self._remembered: deque[Understood] = deque(maxlen=_REMEMBERED)

    @property
    def created(self) -> Created:
        """How the session began."""
        return self.history.created

    @property
    def understood(self) -> Understood:
        """What the imitator makes of the demonstrations that count now."""
        if self._understood is None:
            raise RuntimeError("prepare() comes first")
        return self._understood

    @property
    def model(self) -> ImitationModel:
        """What was learned.

        Raises:
            InvalidInputError: If nothing was yet.
        """
        model = self.understood.model
        if model is None:
            raise InvalidInputError("session", "at least one demonstration that can be learned from", "none")
        return model

    async def prepare(self) -> None:
        """Understand the session as it was read."""
        async with self._lock:
            if self._understood is not None:
                return
            self._understood = await self._understand(self.history)
        self._learner.submit(self._prepare_policies, self._understood)

    async def edit(self, revision: int, event: Event) -> None:
        """Change the demonstrations, the draft or the title; goes on to the end even if whoever asked for it goes away.

        Args:
            revision: What the page last saw.
            event: The change.

        Raises:
            StaleRevisionError: If somebody else was faster.
            InvalidInputError: If the change cannot be.
        """
        await asyncio.shield(self._edit(revision, event))

    async def note(self, event: Asked | Judged) -> History:
        """Add what is no edit; goes on to the end even if whoever asked for it goes away.

        Returns:
            The session just after it.

        Raises:
            InvalidInputError: If it cannot be.
        """
        return await asyncio.shield(self._note(event))

    async def _edit(self, revision: int, event: Event) -> None:
        async with self._lock:
            if revision != self.history.revision:
                raise StaleRevisionError(self.history.revision, revision)
            following = await self._written(event)
            understood = self._understood
            if following.shown is not self.history.shown:
                understood = await self._understand(following)
            self.history, self._understood = following, understood  # both at once: nobody sees one without the other
        if understood is not None:
            self._learner.submit(self._prepare_policies, understood)

    async def _note(self, event: Event) -> History:
        async with self._lock:
            self.history = await self._written(event)
            return self.history

    async def _written(self, event: Event) -> History:
        """Put an event on the disk, and return the session after it."""
        following = after(self.history, event)
        _check_room(following, event)
        await asyncio.to_thread(self._shelf.append, self.name, event)
        return following

    async def _understand(self, history: History) -> Understood:
        for known in self._remembered:  # undo and redo bring back what was understood before
            if known.shown is history.shown:
                return known
        work = functools.partial(understand, history, self._understood)
        understood = await asyncio.get_running_loop().run_in_executor(self._learner, work)
        self._remembered.append(understood)
        return understood

    def _prepare_policies(self, understood: Understood) -> None:
        """Make all policies before anybody has to wait for one; whoever changes the session again comes first."""
        model = understood.model
        if model is None:
            return
        for movement in range(len(model.movements)):
            if self._understood is not understood or self._lock.locked():
                return
            model.policy(movement)


def _check_room(history: History, event: Event) -> None:
    counts = (
        ("demonstrations", len(history.shown), LIMITS.demonstrations, Demonstrated | Redrawn | Deleted),
        ("answers", len(history.answers), LIMITS.answers, Asked),
        ("events", history.events, LIMITS.events, object),
    )
    for what, count, most, kinds in counts:
        if count > most and isinstance(event, kinds):
            raise InvalidInputError(f"session: {what}", f"at most {most}; begin another session", "more")
