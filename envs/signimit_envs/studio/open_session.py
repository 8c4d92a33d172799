"""A session in memory: its events on the disk first, one change at a time, and what was learned after each."""

from __future__ import annotations

import asyncio
import functools
import logging
import time
from collections import deque
from concurrent.futures import Executor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError, SignimitError
from signimit.learning import ImitationModel, learn
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page.belief import belief_json, wish_json
from signimit_envs.studio.store.events import (
    Asked,
    Created,
    Deleted,
    Demonstrated,
    DrawnDemonstration,
    Event,
    Insisted,
    Judged,
    Redrawn,
)
from signimit_envs.studio.store.history import Answer, Demonstrations, History, apply_event
from signimit_envs.studio.store.sessions import SessionStore

_REMEMBERED = 8  # learning results that undo and redo find again
_SCENES = 16  # candidates for the next demonstration; the one that teaches most is taken
_log = logging.getLogger(__name__)


class NotFoundError(LookupError):
    """There is no such session, demonstration or answer."""


class StaleRevisionError(SignimitError, ValueError):
    """The session was changed since the page last saw it.

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


class LearningResult(NamedTuple):
    """What was learned from some demonstrations, and the scene of the next one.

    Attributes:
        shown: The demonstrations.
        model: What was learned; none if nothing could be.
        belief: The same for the page; none before the first demonstration.
        objects: Where objects are for the next demonstration, shape (O, 2), m.
        hand: Where the demonstrator's hand is then, shape (2,), m.
    """

    shown: Demonstrations
    model: ImitationModel | None
    belief: dict[str, Any] | None
    objects: NDArray[np.float64]
    hand: NDArray[np.float64]


def learn_session(history: History, before: LearningResult | None) -> LearningResult:
    """Learn from the demonstrations of a session; by `ImitationModel.observe` if only one was added.

    What cannot be learned from is logged and said in the belief: the session stays, and the person can undo.

    Args:
        history: The session.
        before: What was learned last, to go on from.
    """
    shown = history.shown
    rng = np.random.default_rng([history.created.seed, 1, len(shown)])
    hand, scenes = sample_hand(rng), np.array([sample_scene(rng, history.created.objects) for _ in range(_SCENES)])
    if not shown:
        return LearningResult(shown, None, None, scenes[0], hand)
    start = time.perf_counter()
    try:
        known = () if before is None else before.shown
        one_more = len(known) == len(shown) - 1 and all(a is b for a, b in zip(known, shown, strict=False))
        if before is not None and before.model is not None and one_more:
            model = before.model.observe(shown[-1].demonstration)
        else:
            model = learn(DemonstrationSet(one.demonstration for one in shown))
        wish = model.most_informative(scenes)
        belief = {**belief_json(model), "wish": wish_json(model, wish), "seconds": time.perf_counter() - start}
    except Exception as error:  # what was drawn must stay, and can be undone, whatever fails here
        _log.exception("the demonstrations cannot be learned from")
        return LearningResult(shown, None, {"failed": f"This cannot be learned from: {error}"}, scenes[0], hand)
    return LearningResult(shown, model, belief, scenes[wish.scene], hand)


class OpenSession:
    """A session with its model. All changes go through `edit` and `note`, one after the other."""

    def __init__(self, name: str, store: SessionStore, history: History, learner: Executor) -> None:
        """Take a session that was read; `learned` comes with the first call of `prepare`."""
        self.name, self.history = name, history
        self._store, self._learner = store, learner
        self._lock = asyncio.Lock()
        self._learned: LearningResult | None = None
        self._remembered: deque[LearningResult] = deque(maxlen=_REMEMBERED)

    @property
    def created(self) -> Created:
        """How the session began."""
        return self.history.created

    @property
    def learned(self) -> LearningResult:
        """What was learned from the demonstrations that count now."""
        if self._learned is None:
            raise RuntimeError("prepare() comes first")
        return self._learned

    @property
    def model(self) -> ImitationModel:
        """What was learned.

        Raises:
            InvalidInputError: If nothing was yet.
        """
        model = self.learned.model
        if model is None:
            raise InvalidInputError("session", "at least one demonstration that can be learned from", "none")
        return model

    def demonstration(self, number: int) -> DrawnDemonstration:
        """Return a demonstration that counts now.

        Raises:
            NotFoundError: If there is none of that number.
        """
        if number >= len(self.history.shown):
            raise NotFoundError("There is no such demonstration.")
        return self.history.shown[number]

    def answer(self, number: int) -> Answer:
        """Return an answer of the arm.

        Raises:
            NotFoundError: If there is none of that number.
        """
        if number >= len(self.history.answers):
            raise NotFoundError("There is no such answer.")
        return self.history.answers[number]

    async def prepare(self) -> None:
        """Learn from the session as it was read."""
        async with self._lock:
            if self._learned is not None:
                return
            self._learned = await self._learn(self.history)
        self._learner.submit(self._prepare_policies, self._learned)

    async def edit(self, revision: int, event: Event) -> None:
        """Change the demonstrations, the draft or the title; goes on to the end even if the caller goes away.

        Args:
            revision: What the page last saw.
            event: The change.

        Raises:
            StaleRevisionError: If there was another change meanwhile.
            InvalidInputError: If the change cannot be.
        """
        await asyncio.shield(self._edit(revision, event))

    async def _edit(self, revision: int, event: Event) -> None:
        async with self._lock:
            if revision != self.history.revision:
                raise StaleRevisionError(self.history.revision, revision)
            following = await self._written(event)
            learned = self._learned
            if following.shown is not self.history.shown:
                learned = await self._learn(following)
            self.history, self._learned = following, learned  # both at once: nobody sees one without the other
        if learned is not None:
            self._learner.submit(self._prepare_policies, learned)

    async def delete(self) -> None:
        """Delete what is on the disk of it, between two changes."""
        async with self._lock:
            await asyncio.to_thread(self._store.delete, self.name)

    async def note(self, event: Asked | Insisted | Judged) -> History:
        """Add what is no edit; goes on to the end even if the caller goes away.

        Returns:
            The session just after it.

        Raises:
            InvalidInputError: If it cannot be.
        """
        return await asyncio.shield(self._note(event))

    async def _note(self, event: Event) -> History:
        async with self._lock:
            self.history = await self._written(event)
            return self.history

    async def _written(self, event: Event) -> History:
        """Put an event on the disk, and return the session after it."""
        following = apply_event(self.history, event)
        counts = (
            ("demonstrations", len(following.shown), LIMITS.demonstrations, Demonstrated | Redrawn | Deleted),
            ("answers", len(following.answers), LIMITS.answers, Asked),
            ("events", following.events, LIMITS.events, object),
        )
        for what, count, most, kinds in counts:
            if count > most and isinstance(event, kinds):
                raise InvalidInputError(f"session: {what}", f"at most {most}; begin another session", "more")
        await asyncio.to_thread(self._store.append, self.name, event)
        return following

    async def _learn(self, history: History) -> LearningResult:
        for known in self._remembered:  # undo and redo bring back what was learned from before
            if known.shown is history.shown:
                return known
        work = functools.partial(learn_session, history, self._learned)
        learned = await asyncio.get_running_loop().run_in_executor(self._learner, work)
        self._remembered.append(learned)
        return learned

    def _prepare_policies(self, learned: LearningResult) -> None:
        """Make all policies before an answer waits for one; another change of the session comes first."""
        model = learned.model
        if model is None:
            return
        for movement in range(len(model.movements)):
            if self._learned is not learned or self._lock.locked():
                return
            model.policy(movement)
