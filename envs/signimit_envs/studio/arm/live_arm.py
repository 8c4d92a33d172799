"""The simulated arm, alive: physics in real time in a thread of its own; it obeys, and can be interfered with."""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

import numpy as np

from signimit_envs.arm.scene import CONTROL_RATE, WORKSPACE, object_bodies
from signimit_envs.sessions.reproduction import hand_action, hand_velocities
from signimit_envs.studio.arm.external_force import Push
from signimit_envs.studio.arm.live_state import Array, Errand, LiveState, TrackPart
from signimit_envs.studio.arm.real_time_clock import Pace
from signimit_envs.tabletop_hand import TabletopHandEnv

OBJECT_WIDTH = 0.08  # m; the middles of two objects that touch are so far apart
ANSWER_SECONDS = 60.0  # after which the arm rests
TRAIL_SECONDS, TRAIL_STRIDE = 8.0, 2  # of the past; control steps between its points
PART_STEPS = CONTROL_RATE  # of a track that are handed over at once
_log = logging.getLogger(__name__)


class LiveArm:
    """One table with one arm. Whoever commands it returns at once; its thread obeys at the next control step."""

    def __init__(self, record: Callable[[TrackPart], object]) -> None:
        """Set the table.

        Args:
            record: Called in the arm's thread, once a second and at the end of each answer.
        """
        self._record = record
        self._inbox: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._live, name="live arm", daemon=True)
        self._steps, self._born = 0, time.perf_counter()
        self._pace = Pace(1.0 / CONTROL_RATE, self._born)
        self._session: str | None = None
        self._errand: Errand | None = None
        self._push: Push | None = None
        self._track: list[tuple[Array, Array, Array]] = []
        self._told = 0
        self._trail: deque[tuple[float, float]] = deque(maxlen=round(TRAIL_SECONDS * CONTROL_RATE / TRAIL_STRIDE))
        self._set_table(3)
        self._put(None, np.array([[-0.2, 0.05], [0.0, 0.15], [0.2, -0.05]]), np.zeros(2))

    def start(self) -> None:
        """Come alive."""
        self._thread.start()

    def close(self) -> None:
        """Stop; may be called again, and before `start`."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join()
        self._end()
        self._env.close()

    @property
    def state(self) -> LiveState:
        """The state after the latest control step."""
        return self._state

    def put(self, session: str, objects: Array, hand: Array) -> None:
        """Give the table to a session: objects, shape (O, 2), m, and the resting hand, shape (2,), m, in place."""
        self._inbox.put(lambda: self._put(session, objects, hand))

    def obey(self, errand: Errand) -> None:
        """Begin an errand; the one before ends."""
        self._inbox.put(lambda: self._begin(errand))

    def rest(self) -> None:
        """End the errand and hold still."""
        self._inbox.put(self._end)

    def drag(self, number: int, place: Array) -> None:
        """Move an object, if there is one of that number, to a place in the workspace, shape (2,), m, or beside it.

        No object is put where another is: it slides around it.
        """
        self._inbox.put(lambda: self._drag(number, place))

    def shove(self, velocity: Array) -> None:
        """Push the hand for a moment, so that it drifts with about a velocity, shape (2,), m/s."""
        self._inbox.put(lambda: self._shove(velocity))

    def step(self) -> None:
        """Do what was commanded, then one control step. The arm's own thread calls this, once the arm is started."""
        while not self._inbox.empty():
            self._inbox.get()()
        env = self._env
        if self._push is not None:
            self._push = self._push.apply(env.model, env.data)
        velocity = np.zeros(2)
        if self._errand is not None:
            velocity = self._move(self._state.hand - self._objects[self._errand.focus])
        observation, _, failed, _, _ = env.step(hand_action(velocity))
        if failed:  # it was put back as it was when the table was set
            self._push = None
            self._place_objects()
        self._steps += 1
        if self._steps % TRAIL_STRIDE == 0 and self._errand is not None:
            self._trail.append((round(float(observation["hand"][0]), 4), round(float(observation["hand"][1]), 4)))
        self._look(observation)
        if self._errand is not None:
            self._remember()

    def _live(self) -> None:
        self._born = time.perf_counter()
        self._pace = Pace(1.0 / CONTROL_RATE, self._born)
        failing = False
        while not self._stop.is_set():
            try:
                self.step()
                failing = False
            except Exception:  # whatever it is, an arm that rests is better than a thread that died
                if not failing:  # else the log would fill by 50 a second
                    _log.exception("the arm failed and rests")
                self._errand, failing = None, True
            self._stop.wait(self._pace.wait(time.perf_counter()))

    def _look(self, observation: dict[str, Any]) -> None:
        self._state = LiveState(
            session=self._session,
            errand=self._errand,
            time=self._steps / CONTROL_RATE,
            clock=time.perf_counter() - self._born,
            joints=observation["joints"],
            hand=observation["hand"],
            objects=self._objects,
            trail=tuple(self._trail),
            shoved=self._push is not None,
            lost=self._pace.lost,
        )

    def _remember(self) -> None:
        state = self._state
        self._track.append((state.hand, state.joints, state.objects))
        self._told += 1
        if len(self._track) == PART_STEPS:
            self._hand_over()
        if self._told >= ANSWER_SECONDS * CONTROL_RATE:
            self._end()

    def _hand_over(self) -> None:
        if self._errand is not None and self._track:
            parts = (np.array(part) for part in zip(*self._track, strict=True))
            self._record(TrackPart(self._errand, self._told - len(self._track), *parts))
        self._track = []

    def _set_table(self, objects: int) -> None:
        self._env = TabletopHandEnv(objects=objects)
        self._bodies = object_bodies(self._env.model)

    def _put(self, session: str | None, objects: Array, hand: Array) -> None:
        self._end()
        if len(objects) != len(self._bodies):
            self._env.close()
            self._set_table(len(objects))
        observation, _ = self._env.reset(seed=0, options={"objects": objects, "hand": hand})
        self._session, self._objects, self._push = session, observation["objects"], None
        self._trail.clear()
        self._look(observation)

    def _begin(self, errand: Errand) -> None:
        if errand.session != self._session:  # somebody else has the table by now
            return
        self._end()
        self._trail.clear()
        self._errand, self._told = errand, 0
        self._move = hand_velocities(errand.policy)

    def _end(self) -> None:
        self._hand_over()
        self._errand = None

    def _drag(self, number: int, place: Array) -> None:
        if number not in range(len(self._bodies)):
            return
        others = np.delete(self._objects, number, axis=0)
        wanted = np.clip(_beside(np.clip(place, -WORKSPACE, WORKSPACE), others), -WORKSPACE, WORKSPACE)
        if _distances(wanted, others).min() < OBJECT_WIDTH - 1e-9:  # in a corner: it stays where it was
            return
        moved = self._objects.copy()
        moved[number] = wanted
        self._objects = moved
        self._place_objects()

    def _place_objects(self) -> None:
        self._env.data.mocap_pos[self._bodies, :2] = self._objects

    def _shove(self, velocity: Array) -> None:
        self._push = Push(velocity)


def _distances(place: Array, others: Array) -> Array:
    return np.asarray(np.hypot(*(others - place).T))


def _beside(place: Array, others: Array) -> Array:
    """Return where an object comes to lie that is put at a place, by the nearest of the others, shape (O, 2), m."""
    nearest = others[np.argmin(_distances(place, others))]
    away = place - nearest
    distance = float(np.hypot(*away))
    if distance >= OBJECT_WIDTH:
        return place
    return np.asarray(nearest + (away * (OBJECT_WIDTH / distance) if distance > 1e-9 else [OBJECT_WIDTH, 0.0]))
