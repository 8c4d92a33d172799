"""Sessions on the physics: demonstrations, learning, and commands obeyed by the simulated arm (paper, section III)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.display import one_line
from signimit.evaluation import Performance, performed
from signimit.exceptions import InvalidInputError
from signimit.learners import DEFAULT_METHOD, get_learner
from signimit.learning import ImitationModel, learn
from signimit.policies import DEFAULT_POLICY, check_policy_kind
from signimit.teaching.composition import Strokes
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.people.choosing import People
from signimit.teaching.sessions import Command, Condition, Session, ask_in_order, compose_session
from signimit_envs.sessions.reproduction import reproduce
from signimit_envs.tabletop_hand import TabletopHandEnv


@one_line
@dataclass(frozen=True, kw_only=True)
class SessionPlan:
    """Plan of a session; its defaults are those of `signimit.learn`.

    Attributes:
        language: What is spoken.
        method: How the imitator learns.
        policy: Kind of policy that moves the hand.
        seed: Decides everything that happens, people apart.
        attempts: How often each request is made of the imitator.
        seconds: How long the imitator moves each time.
    """

    language: Language = PAPER_LANGUAGE
    method: str = DEFAULT_METHOD
    policy: str = DEFAULT_POLICY
    seed: int = 0
    attempts: int = 4
    seconds: float = 10.0

    def __post_init__(self) -> None:
        """Check names and numbers.

        Raises:
            InvalidInputError: If there would be nothing to see.
            UnknownNameError: If there is no such method or policy.
        """
        get_learner(self.method)
        check_policy_kind(self.policy)
        if self.seed < 0:
            raise InvalidInputError("seed", "zero or more", f"{self.seed}")
        if self.attempts < 1:
            raise InvalidInputError("attempts", "at least 1", f"{self.attempts}")
        _check_seconds(self.seconds)

    def as_in_paper(self) -> Self:
        """Return the same plan with the paper's learner and policy: Algorithm 1, 50 nearest points (II-A to II-E)."""
        return replace(self, method="paper", policy="knn")

    def compose(self, people: People[Strokes]) -> Session:
        """Compose the session: demonstrations, prototype signs, and each request so many times in a row.

        Raises:
            UnknownNameError: If the people cannot draw what the language needs.
        """
        condition = Condition(language=self.language, ask=partial(ask_in_order, attempts=self.attempts))
        return compose_session(condition, self.seed, people, np.random.default_rng(self.seed))


Track = Callable[[Sequence[Command]], Iterable[Command]]


@one_line
class ArmAnswer(NamedTuple):
    """Answer to a command: what was understood, and how the arm moved.

    Attributes:
        movement: Number of the movement that it understood, in its own numbering.
        focus: Number of the object that it understood.
        confidence: Its probability that both are right.
        path: Where its hand was at the start and after every control step, shape (T, 2), m, table frame.
        joints: The arm's joint angles at the same times, shape (T, 3), rad.
    """

    movement: int
    focus: int
    confidence: float
    path: NDArray[np.float64]
    joints: NDArray[np.float64]


@one_line
class Reproduction(NamedTuple):
    """A command, the answer, and its performance.

    Attributes:
        command: The command.
        answer: What the imitator did.
        performance: What that was.
    """

    command: Command
    answer: ArmAnswer
    performance: Performance

    @property
    def obeyed(self) -> bool:
        """Whether the hand did what was asked for."""
        return (self.performance.movement, self.performance.focus) == self.command.request


@one_line
@dataclass(frozen=True, eq=False)
class SessionResult:
    """Result of a session with one learner and one kind of policy.

    Attributes:
        plan: What was done.
        session: What the imitator saw and was asked for.
        model: What it understood.
        reproductions: What it did.
    """

    plan: SessionPlan
    session: Session
    model: ImitationModel
    reproductions: tuple[Reproduction, ...]


def run_session(plan: SessionPlan, session: Session, track: Track = iter) -> SessionResult:
    """Learn from a session's demonstrations, and obey its commands on the physics.

    Args:
        plan: How to learn, and for how long to move.
        session: What is seen and asked for, as `SessionPlan.compose` makes it.
        track: Passes the commands on as they are carried out, e.g. tqdm's progress bar.

    Raises:
        SignimitError: If something cannot be used.
    """
    model = learn(session.demonstrations, session.prototypes, plan.method, plan.policy, plan.seed)
    env = TabletopHandEnv(objects=plan.language.objects)
    try:
        reproductions = []
        for command in track(session.commands):
            answer = answer_signs(model, command.signs, command.objects, command.hand, plan.seconds, env)
            performance = performed(answer.path, command.objects, session.truth.templates)
            reproductions.append(Reproduction(command, answer, performance))
    finally:
        env.close()
    return SessionResult(plan, session, model, tuple(reproductions))


def answer_signs(
    model: ImitationModel,
    signs: Sequence[ArrayLike],
    objects: NDArray[np.float64],
    hand: NDArray[np.float64],
    seconds: float,
    env: TabletopHandEnv,
) -> ArmAnswer:
    """Let the imitator answer signs with the simulated arm.

    Args:
        model: The imitator's.
        signs: The utterance, W signs of shape (T_s, 2).
        objects: Where the objects are, shape (O, 2), m.
        hand: Where the hand starts, shape (2,), m.
        seconds: How long it moves, 1 to 600 s.
        env: The arm; it is reset, and not closed.

    Raises:
        InvalidInputError: If the signs, the scene or the duration cannot be used.
    """
    _check_seconds(seconds)
    response = model.respond(signs, objects)
    joints: list[NDArray[np.float64]] = []
    track = reproduce(
        env, response.policy, objects, hand, seconds, each_step=lambda: joints.append(env.data.qpos.copy())
    )
    return ArmAnswer(response.movement, response.focus, response.confidence, track.path, np.array(joints))


def _check_seconds(seconds: float) -> None:
    if not 1.0 <= seconds <= 600.0:  # a comparison with NaN is false
        raise InvalidInputError("seconds", "1 to 600", f"{seconds}")
