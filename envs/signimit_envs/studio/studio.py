"""State of the server: sessions, the live arm, the camera and the pages that watch."""

from __future__ import annotations

import asyncio
import importlib
import logging
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import InvalidInputError
from signimit.learning import LEAST_CONFIDENCE
from signimit.policies import Policy
from signimit.teaching.languages import Request
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.studio.arm.camera import OPENGL_PATIENCE, Camera
from signimit_envs.studio.arm.live_arm import LiveArm
from signimit_envs.studio.arm.live_state import Task, TrackPart
from signimit_envs.studio.arm.viewers import Viewers
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.open_session import NotFoundError, OpenSession
from signimit_envs.studio.page.belief import movement_names, understood_text
from signimit_envs.studio.page.pictures import FigureCache
from signimit_envs.studio.store.events import Asked, Created, Insisted, Signs
from signimit_envs.studio.store.history import History
from signimit_envs.studio.store.sessions import SessionStore

_KEPT_OPEN = 4  # sessions in memory; an older one is read again when a page asks for it
Result = TypeVar("Result")
_log = logging.getLogger(__name__)


class BusyError(RuntimeError):
    """Too many figures, films and files wait already."""


class Studio:
    """Everything that lives as long as the server."""

    def __init__(self, folder: Path, seed: int = 0) -> None:
        """Lock the folder of sessions and set the table.

        Args:
            folder: Where sessions are kept.
            seed: Decides what happens in new sessions.

        Raises:
            InvalidInputError: If another studio uses the folder.
        """
        self.store = SessionStore(folder)
        self.viewers, self.figures = Viewers(), FigureCache()
        self.arm = LiveArm(lambda part: self._recorder.submit(self._write, part))
        self.camera = Camera(lambda: self.arm.state, lambda: self.viewers.watching, self.viewers.publish)
        self.demo: str | None = None
        self._waiting = 0
        self._rng = np.random.default_rng(seed)
        self._learner = ThreadPoolExecutor(1, "learner")
        self._recorder = ThreadPoolExecutor(1, "recorder")
        self._figure_pool = ThreadPoolExecutor(1, "figures")
        self._open: WeakValueDictionary[str, OpenSession] = WeakValueDictionary()
        self._recent: deque[OpenSession] = deque(maxlen=_KEPT_OPEN)
        self._opening = asyncio.Lock()

    def start(self) -> None:
        """Start the threads of arm and camera."""

        def import_matplotlib() -> None:
            """Save the first figure the wait, once the camera has found OpenGL, which the first page waits for."""
            self.camera.unavailable_reason(OPENGL_PATIENCE)
            importlib.import_module("signimit.plots.paper")

        self.arm.start()
        self.camera.start()
        self._figure_pool.submit(import_matplotlib)

    def close(self) -> None:
        """End everything; what the arm did last is written first."""
        self.camera.close()
        self.arm.close()
        self._learner.shutdown(cancel_futures=True)
        self._figure_pool.shutdown(cancel_futures=True)
        self._recorder.shutdown()
        self.store.close()

    async def create(self, title: str, language: str, objects: int, seed: int | None = None) -> OpenSession:
        """Begin a session."""
        if seed is None:
            seed = int(self._rng.integers(2**32))
        now = time.strftime("%Y-%m-%dT%H:%M:%S")
        created = Created(title or f"Session of {now.replace('T', ' ')}", now, language, objects, seed)
        return await self.open(await asyncio.to_thread(self.store.create, created))

    async def open(self, name: str) -> OpenSession:
        """Return a session; requests for one name get one object, also at the same time.

        Raises:
            NotFoundError: If there is none.
        """
        async with self._opening:
            session = self._open.get(name)
            if session is None:
                if name not in self.store:
                    raise NotFoundError("There is no such session.")
                history: History = await asyncio.to_thread(self.store.read, name)
                session = OpenSession(name, self.store, history, self._learner)
                self._open[name] = session
            if session not in self._recent:
                self._recent.append(session)
        await session.prepare()
        return session

    def set_table(self, session: OpenSession) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Put the arm and new objects on the live table; return where they are, m."""
        scene = sample_scene(self._rng, session.created.objects), sample_hand(self._rng)
        self.arm.put(session.name, *scene)
        return scene

    async def ask(self, session: OpenSession, signs: Signs, request: Request | None) -> int:
        """Let the arm answer signs, on the table as it is; return the number of the answer.

        An arm that is not sure holds still, until a person insists (`insist`).

        Raises:
            InvalidInputError: If nothing was learned yet, or the signs cannot be used.
        """
        model, objects = session.model, self._table(session)
        response = await asyncio.to_thread(model.respond, [sign.points for sign in signs], objects)
        policy = await asyncio.to_thread(model.policy, response.movement)
        name = movement_names(model, session.history)[response.movement]
        held = response.confidence < LEAST_CONFIDENCE
        asked = Asked(signs, response.movement, response.focus, response.confidence, request, held, name)
        number = len((await session.note(asked)).answers) - 1
        if held:
            self._hold(session)
        else:
            self.arm.obey(_task(session, number, policy, asked))
        return number

    async def insist(self, session: OpenSession, number: int) -> None:
        """Let the arm do what it has asked back about.

        Raises:
            InvalidInputError: If it has not, or does not understand the signs so any more.
        """
        asked, model = session.answer(number).asked, session.model
        if not session.answer(number).held:
            raise InvalidInputError(f"answer {number + 1}", "one that the arm has asked back about", "another")
        again = await asyncio.to_thread(model.respond, [sign.points for sign in asked.signs], self._table(session))
        if (again.movement, again.focus) != (asked.movement, asked.focus):
            raise InvalidInputError(
                f"answer {number + 1}", "signs that are still understood so", "others; please ask again"
            )
        policy = await asyncio.to_thread(model.policy, asked.movement)
        await session.note(Insisted(number))
        self.arm.obey(_task(session, number, policy, asked))

    async def delete(self, session: OpenSession) -> None:
        """Delete a session with all that is on the disk of it; pages that show it are told."""
        async with self._opening:
            self._hold(session)
            await session.delete()
            self._open.pop(session.name, None)
            if session in self._recent:
                self._recent.remove(session)
        self.viewers.tell({"type": "deleted", "session": session.name})

    def _table(self, session: OpenSession) -> NDArray[np.float64]:
        """Return where objects are on the live table, m; another session's is set anew."""
        state = self.arm.state
        return state.objects if state.session == session.name else self.set_table(session)[0]

    def _hold(self, session: OpenSession) -> None:
        """Let the arm hold still, if it moves for this session."""
        if self.arm.state.session == session.name:
            self.arm.rest()

    async def render(self, work: Callable[[], Result]) -> Result:
        """Make a figure or film or read a file, one at a time in a thread: of processor and memory the arm needs some.

        Raises:
            BusyError: If too many wait already.
        """
        if self._waiting >= LIMITS.waiting:
            raise BusyError(f"At most {LIMITS.waiting} figures, films and files are made at once; try again.")
        self._waiting += 1
        try:
            return await asyncio.get_running_loop().run_in_executor(self._figure_pool, work)
        finally:
            self._waiting -= 1

    def changed(self, session: OpenSession) -> None:
        """Tell all pages that a session has changed."""
        history = session.history
        news = {"type": "changed", "session": session.name, "revision": history.revision, "events": history.events}
        self.viewers.tell(news)

    def _write(self, part: TrackPart) -> None:
        """Write a second of an answer to the disk, in a thread that may wait for it."""
        line = {
            "first": part.first,
            "rate": CONTROL_RATE,
            **{name: np.round(getattr(part, name), 5).tolist() for name in ("path", "joints", "objects")},
        }
        try:
            self.store.append_track(part.task.session, part.task.answer, line)
        except OSError:
            _log.exception("what the arm did could not be written")


def _task(session: OpenSession, number: int, policy: Policy, asked: Asked) -> Task:
    text = understood_text(asked.movement, asked.focus, asked.confidence, asked.name)
    return Task(session.name, number, policy, asked.focus, text)
