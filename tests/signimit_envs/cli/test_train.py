"""Agents of stable-baselines3 can be trained on the environments; whether they get good is not tested here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np
import pytest

import signimit
from signimit_envs.cli.train import TrainingPlan, evaluate_agent, train_ppo
from signimit_envs.video.backend import choose_backend


class Still:
    """An agent that rests."""

    def predict(self, observation: Any, deterministic: bool) -> tuple[Any, None]:
        return np.zeros(2), None


def test_a_thousand_steps_of_ppo() -> None:
    ppo = pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed").PPO
    env = gym.make("signimit/TabletopHand-v0")
    agent = ppo("MultiInputPolicy", env, n_steps=500, batch_size=100, n_epochs=2, seed=0, device="cpu").learn(1000)
    assert agent.num_timesteps == 1000
    action, _ = agent.predict(env.reset(seed=0)[0])
    assert action in env.action_space
    env.close()


def test_vectorised_training_with_shaping_gives_the_same_agent_again() -> None:
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed")
    plan = TrainingPlan(steps=128, envs=2, arguments={"control": "joint", "reward": "dense"}, seed=3)
    weights = [train_ppo(plan).policy.state_dict() for _ in range(2)]
    for name, value in weights[0].items():
        assert (value == weights[1][name]).all()


def test_training_on_pictures() -> None:
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed")
    try:
        choose_backend()
    except signimit.SignimitError:
        pytest.skip("there is no OpenGL")
    plan = TrainingPlan(steps=64, envs=1, arguments={"obs_type": "pixels", "size": (40, 40)})
    assert train_ppo(plan).num_timesteps == 64


def test_without_the_library_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(
        signimit.MissingDependencyError, match=r"Training with PPO needs stable-baselines3.*signimit\[rl\]"
    ):
        train_ppo(TrainingPlan())


def test_who_rests_obeys_nobody_and_the_discount_of_both_is_one() -> None:
    plan = TrainingPlan(discount=0.9, arguments={"max_episode_steps": 20, "reward": "dense"})
    env = plan.make_env()
    assert env.spec is not None
    assert env.spec.kwargs["discount"] == 0.9
    share = evaluate_agent(Still(), env, 2, seed=0)
    assert (share.count, share.total) == (0, 2)


@pytest.mark.parametrize("name", ["steps", "envs", "seed"])
def test_a_plan_for_nothing_is_refused(name: str) -> None:
    with pytest.raises(signimit.InvalidInputError, match=f"{name}: expected . or more, found -1"):
        TrainingPlan(**{name: -1})  # type: ignore[arg-type]
    with pytest.raises(signimit.InvalidInputError, match="episodes: expected 1 or more, found 0"):
        evaluate_agent(Still(), TrainingPlan().make_env(), 0, seed=0)


@pytest.mark.parametrize(
    ("option", "message"),
    [("--steps=0", "train: steps: expected 1 or more, found 0."), ("--objects=9", "train: objects: expected 2 to 6")],
)
def test_what_cannot_be_trained_is_refused_and_leaves_nothing(
    run: Any, option: str, message: str, tmp_path: Path
) -> None:
    pytest.importorskip("tyro", reason="commands need signimit[scripts]")
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed")
    assert run.refusal("train", option, "--out", tmp_path / "out").startswith(message)
    assert list(tmp_path.iterdir()) == []
