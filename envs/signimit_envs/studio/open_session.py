"""A session that somebody works on: one change at a time, on the disk first, understood after each."""

from __future__ import annotations

import asyncio
import functools
from collections.abc import Callable
from concurrent.futures import Executor
from typing import TypeVar

from signimit.exceptions import InvalidInputError, SignimitError
from signimit.learning import ImitationModel
from signimit_envs.studio.events import Asked, Created, Deleted, Demonstrated, Event, Redrawn
from signimit_envs.studio.history import History, after
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.shelf import Shelf
from signimit_envs.studio.understanding import Understood, prepare_policies, understand

Result = TypeVar("Result")


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
            if self._understood is None:
                await self._understand()

    async def edit(self, revision: int, event: Event) -> None:
        """Change the demonstrations or the title.

        Args:
            revision: What the page last saw.
            event: The change.

        Raises:
            StaleRevisionError: If somebody else was faster.
            InvalidInputError: If the change cannot be.
        """
        async with self._lock:
            if revision != self.history.revision:
                raise StaleRevisionError(self.history.revision, revision)
            shown = self.history.shown
            await self._note(event)
            if shown is not self.history.shown:
                await self._understand()

    async def note(self, make: Callable[[History], Event]) -> None:
        """Add what is no edit: an answer or a verdict.

        Args:
            make: Makes the event from the session as it is when its turn has come.
        """
        async with self._lock:
            await self._note(make(self.history))

    async def _note(self, event: Event) -> None:
        following = after(self.history, event)
        _check_room(following, event)
        await asyncio.to_thread(self._shelf.append, self.name, event)
        self.history = following

    async def _understand(self) -> None:
        history, before = self.history, self._understood
        self._understood = await self._in_turn(functools.partial(understand, history, before))
        model = self._understood.model
        if model is not None:
            self._learner.submit(self._prepare_policies, model)

    def _prepare_policies(self, model: ImitationModel) -> None:
        if self._understood is not None and self._understood.model is model:
            prepare_policies(model)

    async def _in_turn(self, work: Callable[[], Result]) -> Result:
        return await asyncio.get_running_loop().run_in_executor(self._learner, work)


def _check_room(history: History, event: Event) -> None:
    counts = (
        ("demonstrations", len(history.shown), LIMITS.demonstrations, Demonstrated | Redrawn | Deleted),
        ("answers", len(history.answers), LIMITS.answers, Asked),
        ("edits", history.revision, LIMITS.events, object),
    )
    for what, count, most, kinds in counts:
        if count > most and isinstance(event, kinds):
            raise InvalidInputError(f"session: {what}", f"at most {most}; begin another session", "more")
