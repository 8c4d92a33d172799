"""A model obeys in an environment of which it sees what is observed, and nothing else."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
import pytest

import signimit as si
import signimit_envs
from signimit_envs.recording import EpisodeRecorder


@pytest.fixture
def env() -> Any:
    env = gym.make("signimit/TabletopHand-v0")
    yield env
    env.close()


@pytest.fixture(scope="module")
def model() -> si.ImitationModel:
    """What is learned from the environment's own people."""
    people, rng = signimit_envs.TabletopHandEnv().people, np.random.default_rng(0)
    demonstrations = [people.demonstrate(request, rng) for request in people.language.seen * 2]
    return si.learn(si.DemonstrationSet(demonstrations))


def test_what_the_people_of_an_environment_show_is_obeyed_in_it(env: Any, model: si.ImitationModel) -> None:
    """The pair was never demonstrated, and the signs are observed ones, centred and scaled."""
    assert (0, 0) not in env.unwrapped.people.language.seen
    episode = signimit_envs.run_episode(env, model, seed=3, options={"movement": 0, "focus": 0})
    assert episode.info["request"] == (0, 0)
    assert (episode.response.focus, episode.info["is_success"], episode.reward) == (0, True, 1.0)
    assert episode.path.shape == (signimit_envs.EPISODE_SECONDS * signimit_envs.CONTROL_RATE + 1, 2)
    assert episode.info["success_performance"][:2] == (0, 0)


def test_wrappers_see_every_step_and_an_episode_ends_where_they_end_it(model: si.ImitationModel) -> None:
    wrapped = EpisodeRecorder(gym.make("signimit/TabletopHand-v0", max_episode_steps=40))
    episode = signimit_envs.run_episode(wrapped, model, seed=0)
    wrapped.close()
    assert episode.path.shape == (41, 2)
    (recorded,) = wrapped.recording.episodes
    assert len(recorded.rewards) == 40


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ({"control": "joint"}, "environment: expected signimit/TabletopHand-v0, or control='hand', found control='jo"),
        ({"objects": 4}, r"objects: expected .*3, 2.* found"),
    ],
)
def test_an_environment_in_which_it_cannot_obey_is_refused(
    model: si.ImitationModel, arguments: dict[str, Any], complaint: str
) -> None:
    env = gym.make("signimit/TabletopHand-v0", **arguments)
    with pytest.raises(si.InvalidInputError, match=complaint):
        signimit_envs.run_episode(env, model)
    env.close()


def test_an_observation_without_signs_is_refused(model: si.ImitationModel) -> None:
    env = gym.wrappers.FlattenObservation(gym.make("signimit/TabletopHand-v0"))
    with pytest.raises(si.InvalidInputError, match="observation: expected a dict with signs and objects"):
        signimit_envs.run_episode(env, model)
    env.close()
