"""The contract of every registered environment."""

from __future__ import annotations

import os
import pickle
import re
from pathlib import Path
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env, data_equivalence
from numpy.typing import NDArray

import signimit
from signimit_envs import CONTROL_RATE, ENV_IDS, TabletopEnv, TabletopHandEnv
from signimit_envs.video.backend import choose_backend

CENTRE = {"objects": [[0.0, 0.0], [0.2, 0.1], [-0.2, 0.1]], "hand": [0.1, 0.0]}
OBSERVED = {"hand", "hand_velocity", "joints", "joint_velocities", "objects", "signs"}
TOLD = {"request", "is_success", "performance", "success_performance", "ik_residual", "physics_error"}


def unwrapped(env: gym.Env[Any, Any]) -> TabletopEnv:
    arm = env.unwrapped
    assert isinstance(arm, TabletopEnv)
    return arm


def resting(env: gym.Env[Any, Any]) -> NDArray[np.float64]:
    shape = env.action_space.shape
    assert shape is not None
    return np.zeros(shape)


def has_opengl() -> bool:
    try:
        choose_backend()
    except signimit.SignimitError:
        return False
    return True


@pytest.fixture(params=ENV_IDS)
def env(request: pytest.FixtureRequest) -> Any:
    made = gym.make(request.param)
    yield made
    made.close()


def test_ids_name_their_package() -> None:
    for env_id in ENV_IDS:
        gym.make(f"signimit_envs:{env_id}").close()


def test_gymnasium_approves(env: gym.Env[Any, Any]) -> None:
    check_env(unwrapped(env), skip_render_check=not has_opengl())


def test_gymnasium_approves_of_more_objects_and_movements() -> None:
    made = gym.make(ENV_IDS[1], objects=5, movements=("circle", "star"), people_seed=3)
    check_env(unwrapped(made), skip_render_check=True)
    assert made.reset(seed=0)[0]["objects"].shape == (5, 2)
    made.close()


def test_observations_are_finite_named_and_within_their_space(env: gym.Env[Any, Any]) -> None:
    observation, info = env.reset(seed=5)
    for _ in range(60):
        assert observation in env.observation_space
        assert set(observation) == OBSERVED
        assert set(info) == TOLD
        assert all(value.dtype == np.float64 for value in observation.values())
        assert all(np.isfinite(value).all() for value in observation.values())
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
        assert type(reward) is float
        assert not terminated
        assert not truncated
    assert observation["signs"].shape == (2, 64, 2)


def test_no_observation_is_constant_over_episodes(env: gym.Env[Any, Any]) -> None:
    starts = [env.reset(seed=seed)[0] for seed in (0, 1)]
    for name in ("hand", "joints", "objects", "signs"):
        assert not np.array_equal(starts[0][name], starts[1][name])
    moved = [env.step(env.action_space.sample())[0] for _ in range(2)]
    for name in ("hand", "hand_velocity", "joints", "joint_velocities"):
        assert not np.array_equal(moved[0][name], moved[1][name])


def test_what_was_given_out_can_be_written_to(env: gym.Env[Any, Any]) -> None:
    observation, _ = env.reset(seed=5)
    kept = pickle.dumps(env.step(resting(env))[0])
    env.reset(seed=5)
    for value in observation.values():
        value[...] = 7.0
    assert pickle.dumps(env.step(resting(env))[0]) == kept


def test_one_seed_gives_the_same_bytes(env: gym.Env[Any, Any]) -> None:
    def episode() -> bytes:
        env.action_space.seed(9)
        seen: list[Any] = [env.reset(seed=4)]
        seen += [env.step(env.action_space.sample()) for _ in range(40)]
        seen += [env.reset(), env.step(env.action_space.sample())]
        return pickle.dumps(seen)

    assert episode() == episode()


def test_an_episode_is_cut_after_twelve_seconds(env: gym.Env[Any, Any]) -> None:
    assert env.metadata["render_fps"] == CONTROL_RATE == 50
    assert env.spec is not None
    assert env.spec.max_episode_steps == 600


@pytest.mark.slow
@pytest.mark.parametrize(
    ("env", "kind"),
    [*((name, gym.VectorizeMode.SYNC) for name in ENV_IDS), (ENV_IDS[0], gym.VectorizeMode.ASYNC)],
    indirect=["env"],
)
def test_vectorised_environments_agree_with_single_ones(env: gym.Env[Any, Any], kind: gym.VectorizeMode) -> None:
    options = {"context": "spawn"} if kind == gym.VectorizeMode.ASYNC else {}
    assert env.spec is not None
    name = f"signimit_envs:{env.spec.id}"
    many = gym.make_vec(name, num_envs=2, vectorization_mode=kind, vector_kwargs=options)
    start, info = many.reset(seed=4)  # the second one gets the next seed
    many.action_space.seed(1)
    action = many.action_space.sample()
    after, *_ = many.step(action)
    single, single_info = env.reset(seed=5)
    assert data_equivalence({k: v[1] for k, v in start.items()}, single, exact=True)
    assert info["request"][1] == single_info["request"]
    assert data_equivalence({k: v[1] for k, v in after.items()}, env.step(action[1])[0], exact=True)
    many.close()


@pytest.mark.parametrize("spoil", ["nan", "inf", "shape", "text", "none"])
def test_actions_that_cannot_be_are_refused_and_change_nothing(env: gym.Env[Any, Any], spoil: str) -> None:
    arm = unwrapped(env)
    arm.reset(seed=0)
    good = resting(env)
    bad: dict[str, Any] = {
        "nan": good * np.nan, "inf": good + np.inf, "shape": np.zeros(5), "text": "left", "none": None
    }  # fmt: skip
    before = arm.data.qpos.copy()
    with pytest.raises(ValueError, match="action: expected") as caught:
        arm.step(bad[spoil])
    assert isinstance(caught.value, signimit.SignimitError)
    np.testing.assert_array_equal(arm.data.qpos, before)


def test_actions_beyond_the_box_are_clipped(env: gym.Env[Any, Any]) -> None:
    arm = unwrapped(env)
    one = 1.0 + resting(env)
    after = []
    for size in (1.0, 40.0):
        arm.reset(seed=0)
        after.append(arm.step(size * one)[0])
    assert data_equivalence(after[0], after[1], exact=True)


@pytest.mark.parametrize(("field", "value"), [("qvel", np.nan), ("qvel", 1e12), ("qpos", np.nan)])
def test_a_blow_up_ends_the_episode_and_leaves_no_log(
    env: gym.Env[Any, Any], field: str, value: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    env.reset(seed=0)
    arm = unwrapped(env)
    env.step(resting(env))
    for _ in range(2):  # the second of its kind is noticed as well, and as quietly
        getattr(arm.data, field)[1] = value
        observation, reward, terminated, _, info = env.step(resting(env))
        assert terminated
        assert reward == 0.0
        assert "blew up" in info["physics_error"]
        assert info["ik_residual"] == 0.0
        assert observation in env.observation_space
    assert os.listdir(tmp_path) == []
    assert capfd.readouterr() == ("", "")
    env.reset(seed=0)
    assert env.step(resting(env))[4]["physics_error"] == ""
    assert mujoco.MjLogConfig.get().logto_file


def test_the_hand_speed_that_actions_are_scaled_by() -> None:
    env = gym.make("signimit/TabletopHand-v0")
    arm = env.unwrapped
    assert isinstance(arm, TabletopHandEnv)
    assert arm.max_hand_speed >= 1.0
    first, _ = env.reset(seed=0, options=CENTRE)
    env.step([0.25, 0.0])
    observation, *_ = env.step([0.25, 0.0])
    np.testing.assert_allclose(observation["hand_velocity"], [0.25 * arm.max_hand_speed, 0.0], atol=0.01)
    np.testing.assert_allclose(observation["hand"] - first["hand"], [0.5 * arm.max_hand_speed / 50, 0.0], atol=1e-3)
    env.close()


def test_the_page_about_the_environment_tells_of_its_observations() -> None:
    """The table in the docstring has the keys and shapes of the space, in order."""
    rows = re.findall(r"^ +``(\w+)`` +\((\w+),([\d, ]*)\)", TabletopEnv.__doc__ or "", flags=re.MULTILINE)
    told = {
        name: tuple(int(size) for size in (first.replace("O", "3").replace("W", "2"), *rest.split(",")) if size.strip())
        for name, first, rest in rows
        if name in OBSERVED
    }
    space = TabletopEnv().observation_space
    assert isinstance(space, gym.spaces.Dict)
    assert told == {name: box.shape for name, box in space.items()}


def test_closing_twice_is_allowed(env: gym.Env[Any, Any]) -> None:
    env.reset(seed=0)
    env.close()
    env.close()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"objects": 9}, "objects: expected 2 to 6, found 9"),
        ({"movements": ()}, "movements: expected 1 to 7 labels, found 0"),
        ({"movements": ("dance",)}, "Unknown movement 'dance'; known are circle"),
        ({"camera": "left"}, "Unknown camera 'left'; known are perspective, top"),
        ({"size": (4000, 480)}, "size of frames: expected 1 to 1280 by 1 to 1280 pixels, found 4000 by 480"),
        ({"render_mode": "ansi"}, "Unknown render mode 'ansi'; known are rgb_array, human"),
    ],
)
def test_arguments_that_cannot_be_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(signimit.SignimitError, match=message):
        TabletopEnv(**arguments)


@pytest.mark.parametrize("env_class", [TabletopEnv, TabletopHandEnv])
def test_a_step_before_the_first_reset_is_refused_in_one_sentence(env_class: type[TabletopEnv]) -> None:
    env = env_class()
    sentence = r"^environment: expected a reset before the first step, found none\.$"
    with pytest.raises(signimit.InvalidInputError, match=sentence):
        env.step(env.action_space.sample())
    with pytest.raises(signimit.InvalidInputError, match="a reset before the first picture, found none"):
        env.render()
    with pytest.raises(signimit.UnknownNameError):
        env.reset(options={"wheels": 4})
    with pytest.raises(signimit.InvalidInputError, match=sentence):
        env.step(env.action_space.sample())
    env.reset(seed=0)
    env.step(env.action_space.sample())
    env.close()
