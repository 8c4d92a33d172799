"""The live arm: physics in real time in a thread, with objects that are dragged and a hand that is pushed."""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import mujoco
import numpy as np

from signimit_envs.arm.scene import CONTROL_RATE, WORKSPACE, hand_action, object_bodies
from signimit_envs.studio.arm.live_state import Array, LiveState, Task, TrackPart
from signimit_envs.tabletop_hand import TabletopHandEnv

OBJECT_WIDTH = 0.08  # m; the middles of two objects that touch are so far apart
ANSWER_SECONDS = 60.0  # after which the arm rests
TRAIL_SECONDS, TRAIL_STRIDE = 8.0, 2  # of the past; control steps between its points
REST_SPEED, REST_SECONDS = 0.005, 0.5  # m/s; a policy that asks for no more for so long has come to its end
PART_STEPS = CONTROL_RATE  # of a track that are handed over at once
PUSH_SECONDS = 0.25
FASTEST_PUSH = 1.0  # m/s, drift; more is cut to it
PUSH_SHARE = 0.9  # of what a drive can hold against; beyond it the arm would be thrown, not pushed
FASTEST_CATCH_UP = 2.0  # times real time, while a delay is made up for
LONGEST_DELAY = 5.0  # s; what is later than that was suspended, not held up
_log = logging.getLogger(__name__)


class RealTimeClock:
    """Keeps simulated time in step with the clock; it reads no clock, it is told the time.

    A step that was held up is followed by the same steps as ever, closer together, until simulated time has
    caught up: no step is left out or made longer, and nothing runs faster than twice real time, so a viewer sees a
    hand that hurries for as long as it was held up, and never one that jumps. A delay past `LONGEST_DELAY` (a
    machine that slept) is not made up for but counted.

    Attributes:
        lost: Time that is not made up for, s.
    """

    def __init__(self, period: float, now: float) -> None:
        """Begin.

        Args:
            period: Time from one step to the next, s.
            now: The time on a clock that never goes back, s.
        """
        self._period = period
        self._due = self._start = now
        self.lost = 0.0

    def wait(self, now: float) -> float:
        """Return how long to wait before the next step begins, s, when one has just ended."""
        self._due += self._period
        delay = now - self._due
        if delay > LONGEST_DELAY:
            self.lost += delay
            self._due = now
        self._start = max(self._due, self._start + self._period / FASTEST_CATCH_UP, now)
        return self._start - now


@dataclass(frozen=True, eq=False)
class ExternalForce:
    """A force at the hand that makes it drift for a while although the drives hold against it.

    Attributes:
        velocity: With what velocity the hand drifts, about, shape (2,), m/s.
        steps: Control steps that it still lasts.
    """

    velocity: Array
    steps: int = round(PUSH_SECONDS * CONTROL_RATE)

    def apply(self, model: mujoco.MjModel, data: mujoco.MjData) -> ExternalForce | None:
        """Set the force for the next control step, and return what is left of it; none if it is over.

        A velocity drive resists like a damper, so the force that makes the hand drift with velocity v is
        (J K⁻¹ Jᵀ)⁻¹ v with the drives' gains K.
        """
        if self.steps <= 0:
            data.qfrc_applied[:] = 0.0
            return None
        jacobian = np.zeros((3, model.nv))
        mujoco.mj_jacSite(model, data, jacobian, None, model.site("hand").id)
        planar, gains = jacobian[:2], model.actuator_gainprm[:, 0]
        mobility = planar / gains @ planar.T + 1e-6 * np.eye(2)
        drift = self.velocity * min(1.0, FASTEST_PUSH / max(1e-9, float(np.hypot(*self.velocity))))
        torques = planar.T @ np.linalg.solve(mobility, drift)
        most = PUSH_SHARE * model.actuator_forcerange[:, 1]
        data.qfrc_applied[:] = torques * min(1.0, float((most / np.maximum(np.abs(torques), 1e-9)).min()))
        return replace(self, steps=self.steps - 1)


class LiveArm:
    """One table with one arm. Commands return at once; the arm's thread carries them out at the next control step."""

    def __init__(self, record: Callable[[TrackPart], object]) -> None:
        """Set the table.

        Args:
            record: Called in the arm's thread, once a second and at the end of each answer.
        """
        self._record = record
        self._inbox: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="live arm", daemon=True)
        self._steps, self._started_at = 0, time.perf_counter()
        self._clock = RealTimeClock(1.0 / CONTROL_RATE, self._started_at)
        self._session: str | None = None
        self._objects: Array
        self._task: Task | None = None
        self._policy_state: Any = None
        self._force: ExternalForce | None = None
        self._track: list[tuple[Array, Array, Array]] = []
        self._recorded = self._rested = 0
        self._done: int | None = None
        self._trail: deque[tuple[float, float]] = deque(maxlen=round(TRAIL_SECONDS * CONTROL_RATE / TRAIL_STRIDE))
        self._set_table(3)
        self._put(None, np.array([[-0.2, 0.05], [0.0, 0.15], [0.2, -0.05]]), np.zeros(2))

    def start(self) -> None:
        """Start the thread."""
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

    def obey(self, task: Task) -> None:
        """Begin a task, if its session still has the table; the task before ends."""

        def begin() -> None:
            if task.session != self._session:
                return
            self._end()
            self._trail.clear()
            self._task, self._recorded, self._rested = task, 0, 0
            self._policy_state = task.policy.start()

        self._inbox.put(begin)

    def rest(self) -> None:
        """End the task and hold still."""
        self._inbox.put(self._end)

    def drag(self, number: int, place: Array) -> None:
        """Move an object, if there is one of that number, to a place in the workspace, shape (2,), m, or beside it.

        No object is put where another is: it slides around it.
        """

        def move() -> None:
            if number not in range(len(self._bodies)):
                return
            others = np.delete(self._objects, number, axis=0)
            wanted = np.clip(_place_beside(np.clip(place, -WORKSPACE, WORKSPACE), others), -WORKSPACE, WORKSPACE)
            if _distances(wanted, others).min() < OBJECT_WIDTH - 1e-9:  # in a corner: it stays where it was
                return
            moved = self._objects.copy()
            moved[number] = wanted
            self._objects = moved
            self._place_objects()

        self._inbox.put(move)

    def shove(self, velocity: Array) -> None:
        """Push the hand for a moment, so that it drifts with about a velocity, shape (2,), m/s."""

        def push() -> None:
            self._force = ExternalForce(velocity)

        self._inbox.put(push)

    def step(self) -> None:
        """Do what was commanded, then one control step. The arm's own thread calls this, once the arm is started."""
        while not self._inbox.empty():
            self._inbox.get()()
        env = self._env
        if self._force is not None:
            self._force = self._force.apply(env.model, env.data)
        velocity = np.zeros(2)
        if self._task is not None:
            hand = self._state.hand - self._objects[self._task.focus]
            self._policy_state, velocity = self._task.policy.step(self._policy_state, hand)
            self._rested = self._rested + 1 if np.hypot(*velocity) < REST_SPEED else 0
        observation, _, failed, _, _ = env.step(hand_action(velocity))
        if failed:  # it was put back as it was when the table was set
            self._force = None
            self._place_objects()
        self._steps += 1
        if self._steps % TRAIL_STRIDE == 0 and self._task is not None:
            self._trail.append((round(float(observation["hand"][0]), 4), round(float(observation["hand"][1]), 4)))
        self._update_state(observation)
        if self._task is not None:
            self._record_step()

    def _run(self) -> None:
        self._started_at = time.perf_counter()
        self._clock = RealTimeClock(1.0 / CONTROL_RATE, self._started_at)
        failing = False
        while not self._stop.is_set():
            try:
                self.step()
                failing = False
            except Exception:  # whatever it is, an arm that rests is better than a thread that died
                if not failing:  # else the log would fill by 50 a second
                    _log.exception("the arm failed and rests")
                self._task, failing = None, True
            self._stop.wait(self._clock.wait(time.perf_counter()))

    def _update_state(self, observation: dict[str, Any]) -> None:
        self._state = LiveState(
            session=self._session,
            task=self._task,
            done=self._done,
            time=self._steps / CONTROL_RATE,
            clock=time.perf_counter() - self._started_at,
            joints=observation["joints"],
            hand=observation["hand"],
            objects=self._objects,
            trail=tuple(self._trail),
            shoved=self._force is not None,
            lost=self._clock.lost,
        )

    def _record_step(self) -> None:
        state = self._state
        self._track.append((state.hand, state.joints, state.objects))
        self._recorded += 1
        if len(self._track) == PART_STEPS:
            self._hand_over()
        if self._recorded >= ANSWER_SECONDS * CONTROL_RATE:
            self._end()
        elif self._rested >= REST_SECONDS * CONTROL_RATE:
            done = None if self._task is None else self._task.answer
            self._end()
            self._done = done

    def _hand_over(self) -> None:
        if self._task is not None and self._track:
            parts = (np.array(part) for part in zip(*self._track, strict=True))
            self._record(TrackPart(self._task, self._recorded - len(self._track), *parts))
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
        self._session, self._objects, self._force = session, observation["objects"], None
        self._trail.clear()
        self._update_state(observation)

    def _end(self) -> None:
        self._hand_over()
        self._task = self._done = None

    def _place_objects(self) -> None:
        self._env.data.mocap_pos[self._bodies, :2] = self._objects


def _distances(place: Array, others: Array) -> Array:
    return np.asarray(np.hypot(*(others - place).T))


def _place_beside(place: Array, others: Array) -> Array:
    """Return where an object comes to lie that is put at a place, by the nearest of the others, shape (O, 2), m."""
    nearest = others[np.argmin(_distances(place, others))]
    away = place - nearest
    distance = float(np.hypot(*away))
    if distance >= OBJECT_WIDTH:
        return place
    return np.asarray(nearest + (away * (OBJECT_WIDTH / distance) if distance > 1e-9 else [OBJECT_WIDTH, 0.0]))
