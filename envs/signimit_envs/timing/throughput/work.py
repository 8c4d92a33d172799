"""The reproductions that are timed: a built-in session's commands, as the default learner understood them."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError
from signimit.learners import DEFAULT_METHOD
from signimit.learning import learn
from signimit.policies import DEFAULT_POLICY, PlacedPolicy
from signimit.teaching.people.casting import cast_people
from signimit_envs.sessions.session import Scene, SessionPlan, compose_session


@dataclass(frozen=True, kw_only=True)
class ThroughputPlan:
    """What is measured.

    Attributes:
        batches: How many reproductions at once.
        threads: Numbers of threads for the physics, 0 for all processors.
        parts_of: How many reproductions at once are taken to parts.
        envs: How many environments are stepped side by side.
        seconds: How long a hand moves.
        turns: How often everything is timed, in turns.
        seed: Of the session.
    """

    batches: tuple[int, ...] = (9, 36, 256, 1024)
    threads: tuple[int, ...] = (1, 0)
    parts_of: int = 256
    envs: int = 8
    seconds: float = 4.0
    turns: int = 5
    seed: int = 0

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            InvalidInputError: If there would be nothing to measure.
        """
        for name in ("batches", "threads"):
            least = int(name == "batches")
            if not getattr(self, name) or min(getattr(self, name)) < least:
                raise InvalidInputError(name, f"at least one number, each at least {least}", f"{getattr(self, name)}")
        for name in ("parts_of", "envs", "turns"):
            if getattr(self, name) < 1:
                raise InvalidInputError(name, "at least 1", f"{getattr(self, name)}")
        if not 1.0 <= self.seconds <= 10.0:  # a comparison with NaN is false
            raise InvalidInputError("seconds", "1 to 10", f"{self.seconds}")


class Work(NamedTuple):
    """Reproductions to do.

    Attributes:
        policies: What moves each hand.
        scenes: Where things are.
        templates: What the judge compares with.
    """

    policies: list[PlacedPolicy]
    scenes: list[Scene]
    templates: list[list[NDArray[np.float64]]]

    @property
    def hands(self) -> NDArray[np.float64]:
        """Where the hands start, shape (B, 2), m."""
        return np.array([scene.hand for scene in self.scenes])

    def first(self, count: int) -> Work:
        """Return the first so many of the reproductions."""
        return Work(self.policies[:count], self.scenes[:count], self.templates)


def compose_work(count: int, seed: int = 0, kind: str = DEFAULT_POLICY) -> Work:
    """Let a built-in session's learner understand so many commands, each in a scene of its own.

    Args:
        count: How many.
        seed: Of the session.
        kind: Of the policies.
    """
    requests = len(SessionPlan().language.requests)
    plan = SessionPlan(method=DEFAULT_METHOD, policy=kind, seed=seed, attempts=-(-count // requests))
    session = compose_session(plan, cast_people(plan.language, np.random.default_rng([seed, 1])))
    model = learn(session.demonstrations, session.prototypes, plan.method, plan.policy, plan.seed)
    chosen = [session.commands[i] for i in np.random.default_rng(seed).permutation(len(session.commands))[:count]]
    policies = [model.respond(command.signs, command.scene.objects).policy for command in chosen]
    return Work(policies, [command.scene for command in chosen], [list(t) for t in session.truth.templates])


class Duration(NamedTuple):
    """How long something took: by the clock on the wall, and of all threads' computing, s."""

    wall: float
    computing: float


def duration(run: Callable[[], object]) -> Duration:
    """Time a callable."""
    wall, computing = time.perf_counter(), time.process_time()
    run()
    return Duration(time.perf_counter() - wall, time.process_time() - computing)
