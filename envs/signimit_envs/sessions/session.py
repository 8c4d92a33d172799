"""A session as in the paper's section III: demonstrations, learning, and commands obeyed by the simulated arm."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.evaluation import Performance, performed
from signimit.exceptions import InvalidInputError
from signimit.learning import ImitationModel, learn
from signimit.policies import DEFAULT_POLICY
from signimit.strokes import Stroke
from signimit.teaching.composition import GroundTruth, compose_demonstrations, compose_prototypes, compose_utterance
from signimit.teaching.languages import PAPER_LANGUAGE, Language, Request
from signimit.teaching.people.casting import Cast
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit.teaching.stroke_sampler import StrokeSampler
from signimit_envs.sessions.reproduction import reproduce
from signimit_envs.tabletop_hand import TabletopHandEnv


@dataclass(frozen=True, kw_only=True)
class SessionPlan:
    """What is done in a session.

    Attributes:
        language: What is spoken.
        method: How the imitator learns.
        policy: Kind of policy that moves the hand.
        seed: Decides everything that happens, people apart.
        attempts: How often each request is made of the imitator.
        seconds: How long the imitator moves each time.
    """

    language: Language = PAPER_LANGUAGE
    method: str = "paper"
    policy: str = DEFAULT_POLICY
    seed: int = 0
    attempts: int = 4
    seconds: float = 10.0

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            InvalidInputError: If there would be nothing to see.
        """
        if self.seed < 0:
            raise InvalidInputError("seed", "zero or more", f"{self.seed}")
        if self.attempts < 1:
            raise InvalidInputError("attempts", "at least 1", f"{self.attempts}")
        _check_seconds(self.seconds)


class Scene(NamedTuple):
    """Where things are when the imitator begins.

    Attributes:
        objects: Object positions, shape (O, 2), m.
        hand: Where its hand starts, shape (2,), m.
    """

    objects: NDArray[np.float64]
    hand: NDArray[np.float64]


class Command(NamedTuple):
    """A request made of the imitator.

    Attributes:
        request: What is asked for; the imitator is not told.
        signs: How, W strokes of shape (T_s, 2) that were not used before while unused ones were left.
        scene: Where objects and hand are.
        seen: Whether this request was among the demonstrations.
    """

    request: Request
    signs: tuple[NDArray[np.float64], ...]
    scene: Scene
    seen: bool


Track = Callable[[Sequence[Command]], Iterable[Command]]


class Answer(NamedTuple):
    """What the imitator did when it was asked for something.

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


class Reproduction(NamedTuple):
    """A command, and what became of it.

    Attributes:
        command: The command.
        answer: What the imitator did.
        performance: What that was.
    """

    command: Command
    answer: Answer
    performance: Performance

    @property
    def obeyed(self) -> bool:
        """Whether the hand did what was asked for."""
        return (self.performance.movement, self.performance.focus) == self.command.request


@dataclass(frozen=True, eq=False)
class Session:
    """What happens before the imitator does anything.

    Attributes:
        plan: How it was made.
        demonstrations: What the imitator sees.
        prototypes: The signs that span its sign space.
        truth: What the demonstrations were; for judging only.
        commands: What it will be asked for.
    """

    plan: SessionPlan
    demonstrations: DemonstrationSet
    prototypes: tuple[Stroke, ...]
    truth: GroundTruth
    commands: tuple[Command, ...]


@dataclass(frozen=True, eq=False)
class SessionResult:
    """Everything that happened.

    Attributes:
        session: What the imitator saw and was asked for.
        model: What it understood.
        reproductions: What it did.
    """

    session: Session
    model: ImitationModel
    reproductions: tuple[Reproduction, ...]


def compose_session(plan: SessionPlan, cast: Cast) -> Session:
    """Let the people act: demonstrations, prototype signs, and the commands that will follow.

    Raises:
        UnknownNameError: If somebody cannot draw what the language needs.
    """
    rng, language = np.random.default_rng(plan.seed), plan.language
    signs, movements = StrokeSampler(cast.signs), StrokeSampler(cast.movements)
    demonstrations, truth = compose_demonstrations(language, signs, movements, rng)
    prototypes = compose_prototypes(language, signs, rng)
    commands = tuple(
        Command(
            request,
            compose_utterance(language, signs, *request, rng),
            Scene(sample_scene(rng, language.objects), sample_hand(rng)),
            request not in language.held_back,
        )
        for request in language.requests
        for _ in range(plan.attempts)
    )
    return Session(plan, demonstrations, prototypes, truth, commands)


def run_session(plan: SessionPlan, cast: Cast, track: Track = iter) -> SessionResult:
    """Run a session on the physics.

    Args:
        plan: What is done.
        cast: Who makes the signs and shows the movements.
        track: Passes the commands on as they are carried out, e.g. tqdm's progress bar.

    Raises:
        SignimitError: If something cannot be used.
    """
    session = compose_session(plan, cast)
    model = learn(session.demonstrations, session.prototypes, plan.method, plan.policy, plan.seed)
    env = TabletopHandEnv(objects=plan.language.objects)
    try:
        reproductions = tuple(obey(command, model, session, env) for command in track(session.commands))
    finally:
        env.close()
    return SessionResult(session, model, reproductions)


def obey(command: Command, model: ImitationModel, session: Session, env: TabletopHandEnv) -> Reproduction:
    """Let the imitator answer one command, and judge what its hand did by what the demonstrator's had done."""
    seconds = session.plan.seconds
    answer = answer_signs(model, command.signs, command.scene, seconds, env)
    return Reproduction(command, answer, performed(answer.path, command.scene.objects, session.truth.templates))


def answer_signs(
    model: ImitationModel, signs: Sequence[ArrayLike], scene: Scene, seconds: float, env: TabletopHandEnv
) -> Answer:
    """Let the imitator answer signs with the simulated arm.

    Raises:
        InvalidInputError: If the signs, the scene or the duration cannot be used.
    """
    _check_seconds(seconds)
    response = model.respond(signs, scene.objects)
    joints: list[NDArray[np.float64]] = []
    track = reproduce(env, response.policy, *scene, seconds, each_step=lambda: joints.append(env.data.qpos.copy()))
    return Answer(response.movement, response.focus, response.confidence, track.path, np.array(joints))


def _check_seconds(seconds: float) -> None:
    if not 1.0 <= seconds <= 600.0:  # a comparison with NaN is false
        raise InvalidInputError("seconds", "1 to 600", f"{seconds}")
