"""Step the environments for a long time, at random and with bad intent, and see whether they stay sound.

Every observation has to lie in its space, which nothing but finite numbers does, rewards have to be finite, what cannot
be used has to be refused in one of signimit's errors, recorded episodes have to replay bit for bit, and the process
must not grow. Episodes are the full 12 s; after each the environment is reset with another scene.
"""

from __future__ import annotations

import gc
import itertools
import os
import sys
import time
from collections import Counter
from collections.abc import Callable, Generator
from contextlib import closing
from functools import partial
from typing import Any, NamedTuple

import gymnasium as gym
import numpy as np
from gymnasium.vector import AutoresetMode

from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError, SignimitError
from signimit_envs import ENV_IDS
from signimit_envs.recording import EpisodeRecorder, find_divergence
from signimit_envs.studio.load import resident_memory
from signimit_envs.video.backend import choose_backend

_SIZE = (32, 32)  # pixels of pictures
_VECTOR = 4  # environments in a vector
_KEPT_EPISODES = 3  # of a recorder, before they are replayed and forgotten
_WARM_UP = 0.2  # share of the steps after which memory is looked at first
_MOST_GROWTH = 32.0  # MiB; what a recorder keeps and the allocator's ups and downs stay below it
_MISUSES = 0.02  # share of steps at which the adversary does something worse than an action
_JOINT, _HAND = ENV_IDS

Steps = Generator[None, None, None]
Scenario = Callable[[np.random.Generator, Counter[str]], Steps]


class Soaked(NamedTuple):
    """What came of a scenario.

    Attributes:
        scenario: Its name.
        steps: Control steps, those of all environments of a vector together.
        episodes: Episodes that ended.
        refused: Actions and reset options that were refused.
        blow_ups: Failures of the physics, all provoked.
        seconds: Time that it took, s.
        growth: By how much the process grew after the first fifth, MiB; not a number where the system does not tell.
        problem: What was wrong; empty if nothing.
    """

    scenario: str
    steps: int
    episodes: int
    refused: int
    blow_ups: int
    seconds: float
    growth: float
    problem: str


def main(*, steps: int = 1_000_000, pixels: int = 100_000, seed: int = 0) -> None:
    """Step the environments at random and with bad intent; ends with code 1 if they do not stay sound.

    Args:
        steps: Control steps without pictures, shared by all scenarios.
        pixels: Control steps that observe pictures, shared by all scenarios; 0 for none, as where there is no OpenGL.
        seed: Of all random draws.
    """
    for name, number in (("steps", steps), ("pixels", pixels)):
        if number < 0:
            raise InvalidInputError(name, "0 or more", f"{number}")
    if pixels:
        choose_backend()
    results = []
    for scenarios, total in ((SCENARIOS, steps), (PIXEL_SCENARIOS, pixels)):
        for number, (name, scenario) in enumerate(scenarios.items()):
            if total:
                rng = np.random.default_rng([seed, number])
                results.append(soak(name, scenario, -(-total // len(scenarios)), rng))
    head = [field.replace("_", " ") for field in Soaked._fields]
    rows = [[f"{value:.1f}" if isinstance(value, float) else str(value) for value in row] for row in results]
    print(markdown_table(head, rows))
    if any(result.problem for result in results):
        sys.exit(1)


def soak(name: str, scenario: Scenario, steps: int, rng: np.random.Generator) -> Soaked:
    """Let a scenario run for so many control steps, or until something is wrong."""
    counts: Counter[str] = Counter()
    start, before, problem = time.perf_counter(), 0.0, ""
    with closing(scenario(rng, counts)) as running:
        try:
            for _ in running:
                if not before and counts["steps"] >= _WARM_UP * steps:
                    before = _memory()
                if counts["steps"] >= steps:
                    break
        except Exception as error:  # whatever it is, it is what was looked for
            problem = f"step {counts['steps']}: {type(error).__name__}: {error}"
        growth = _memory() - before
    if growth > _MOST_GROWTH:
        problem = problem or f"grew by more than {_MOST_GROWTH:g} MiB"
    return Soaked(
        scenario=name,
        steps=counts["steps"],
        episodes=counts["episodes"],
        refused=counts["refused"],
        blow_ups=counts["blow-ups"],
        seconds=time.perf_counter() - start,
        growth=growth,
        problem=problem,
    )


def _memory() -> float:
    gc.collect()
    try:
        return resident_memory(os.getpid()).now
    except OSError:
        return np.nan


def act_at_random(rng: np.random.Generator, counts: Counter[str], *, make: Callable[[], gym.Env[Any, Any]]) -> Steps:
    """Step one environment with random actions; a recorder replays its episodes and forgets them."""
    with closing(make()) as env:
        env.action_space.seed(int(rng.integers(2**31)))
        while True:
            _check(env, env.reset(seed=int(rng.integers(2**31)))[0])
            over = False
            while not over:
                observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
                _check(env, observation, reward, info["ik_residual"])
                over = terminated or truncated
                counts["steps"] += 1
                yield
            counts["episodes"] += 1
            if isinstance(env, EpisodeRecorder) and counts["episodes"] % _KEPT_EPISODES == 0:
                recording = env.recording
                for episode in recording:
                    if (divergence := find_divergence(recording.origin, episode)) is not None:
                        raise ArithmeticError(f"a replay diverges: {divergence}")
                env = EpisodeRecorder(env.env)


def act_with_bad_intent(
    rng: np.random.Generator, counts: Counter[str], *, make: Callable[[], gym.Env[Any, Any]]
) -> Steps:
    """Step one environment against its limits, with impossible actions, options and forces in between."""
    with closing(make()) as env:
        size, arm = int(np.prod(env.action_space.shape or ())), env.unwrapped
        env.reset(seed=int(rng.integers(2**31)))
        for step in itertools.count():
            if rng.random() < _MISUSES:
                misuse = int(rng.integers(4))
                if misuse == 0:
                    action = _impossible_actions(size)[int(rng.integers(7))]
                    if not _is_refused(env.step, action):
                        raise ArithmeticError(f"an action was taken that cannot be: {action!r}")
                    counts["refused"] += 1
                elif misuse == 1:
                    counts["refused"] += _is_refused(partial(env.reset, options=_hostile_options(rng)))
                elif misuse == 2:
                    arm.data.qvel[:] = 10.0 ** rng.uniform(0, 300, 3) * rng.choice([-1, 1], 3)  # type: ignore[attr-defined]
                else:
                    arm.data.qpos[int(rng.integers(3))] = rng.choice([np.nan, np.inf, 1e30])  # type: ignore[attr-defined]
            observation, reward, terminated, truncated, info = env.step(_hostile_action(rng, step, size))
            _check(env, observation, reward, info["ik_residual"])
            counts["steps"] += 1
            counts["blow-ups"] += bool(info["physics_error"])
            if terminated or truncated:
                counts["episodes"] += 1
                _check(env, env.reset()[0])
            yield


def act_on_many(rng: np.random.Generator, counts: Counter[str], *, mode: AutoresetMode, **options: Any) -> Steps:
    """Step several environments as one; those that do not reset themselves are reset when they are over."""
    kwargs = {"autoreset_mode": mode}
    options |= {"vectorization_mode": "sync", "disable_env_checker": True}
    with closing(gym.make_vec(_HAND, _VECTOR, vector_kwargs=kwargs, **options)) as many:
        many.action_space.seed(int(rng.integers(2**31)))
        _check(many, many.reset(seed=int(rng.integers(2**31)))[0])
        while True:
            observation, reward, terminated, truncated, _ = many.step(many.action_space.sample())
            _check(many, observation, reward)
            over = terminated | truncated
            counts["steps"] += _VECTOR
            counts["episodes"] += int(over.sum())
            if mode == AutoresetMode.DISABLED and over.any():
                _check(many, many.reset(options={"reset_mask": over})[0])
            yield


def _check(env: gym.Env[Any, Any] | gym.vector.VectorEnv[Any, Any, Any], observation: Any, *numbers: Any) -> None:
    """Raise an error if an observation is not in its space, or a number is not finite."""
    if not env.observation_space.contains(observation):
        raise ArithmeticError(f"an observation is not in its space: {observation!r}")
    if not all(np.isfinite(number).all() for number in numbers):
        raise ArithmeticError(f"a number is not finite: {numbers!r}")


def _is_refused(use: Callable[..., object], *arguments: Any) -> bool:
    """Return whether a use is refused by an error of signimit; any other error comes through."""
    try:
        use(*arguments)
    except SignimitError:
        return True
    return False


def _impossible_actions(size: int) -> list[Any]:
    ones = np.ones(size)
    return [ones * np.nan, ones * np.inf, np.ones(size + 1), np.ones((1, size)), None, "left", [[0.0], [1.0, 2.0]]]


def _hostile_action(rng: np.random.Generator, step: int, size: int) -> Any:
    """Return an action that can be used: bang-bang, with a joint at its limit, huge, tiny, or of another type."""
    kind = step // 100 % 6  # for two seconds each
    signs = rng.choice([-1.0, 1.0], size)
    return (
        signs,
        np.ones(size, np.float32) * (-1) ** (step // 600),
        np.ones(size) * np.sign(np.sin(step * rng.uniform(0.1, 1.0))),
        signs * 10.0 ** rng.uniform(-320, 308, size),
        signs.astype(int).tolist(),
        np.zeros(size, np.int8),
    )[kind]


def _hostile_options(rng: np.random.Generator) -> dict[str, Any]:
    """Return options of a reset, most of which cannot be used."""
    scale = 10.0 ** rng.uniform(-3, 3)
    choices: list[dict[str, Any]] = [
        {"hand": rng.normal(0, scale, 2)},
        {"objects": rng.normal(0, scale, (3, 2))},
        {"objects": np.zeros((3, 2)), "hand": [np.nan, 0.0]},
        {"movement": int(rng.integers(-9, 9)), "focus": int(rng.integers(-9, 9))},
        {"signs": [rng.normal(0, scale, (int(rng.integers(1, 5)), 2)), np.zeros((3, 2))]},
        {"signs": [np.zeros((0, 2)), np.full((4, 2), np.inf)]},
        {"wheels": 4},
    ]
    return choices[int(rng.integers(len(choices)))]


def _environment(env_id: str, **options: Any) -> Callable[[], gym.Env[Any, Any]]:
    return partial(gym.make, env_id, disable_env_checker=True, **options)


def _recorder(env_id: str, **options: Any) -> Callable[[], gym.Env[Any, Any]]:
    return lambda: EpisodeRecorder(gym.make(env_id, disable_env_checker=True, **options))


SCENARIOS: dict[str, Scenario] = {
    "joint control at random": partial(act_at_random, make=_environment(_JOINT)),
    "hand control at random": partial(act_at_random, make=_environment(_HAND, objects=6, reward="dense")),
    "joint control with bad intent": partial(act_with_bad_intent, make=_environment(_JOINT, reward="dense")),
    "hand control with bad intent": partial(act_with_bad_intent, make=_environment(_HAND, objects=2)),
    "recorder": partial(act_at_random, make=_recorder(_HAND)),
    **{f"vector, {mode.value}": partial(act_on_many, mode=mode) for mode in AutoresetMode},
}
PIXEL_SCENARIOS: dict[str, Scenario] = {
    "pixels with bad intent": partial(act_with_bad_intent, make=_environment(_HAND, obs_type="pixels", size=_SIZE)),
    "recorder, pixels": partial(act_at_random, make=_recorder(_JOINT, obs_type="state_pixels", size=_SIZE)),
    **{
        f"vector, pixels, {mode.value}": partial(act_on_many, mode=mode, obs_type="pixels", size=_SIZE)
        for mode in AutoresetMode
    },
}
