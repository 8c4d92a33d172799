"""Arguments of the environments: every combination passes Gymnasium's checks and works with its wrappers."""

from __future__ import annotations

import itertools
import pickle
from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium import wrappers
from gymnasium.envs.registration import EnvSpec
from gymnasium.utils.env_checker import check_env, data_equivalence

import signimit
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library
from signimit_envs import ENV_IDS, RenderingError, TabletopEnv, TabletopHandEnv, reproduce
from signimit_envs.video.backend import choose_backend

TALK = {
    "focus_signs": ["star", "1", "7", "spiral"],
    "movement_signs": ["2", "square"],
    "movements": ["circle", "star"],
    "filler_signs": ["8", "9"],
    "focus_word": 2,
    "movement_word": 0,
}
VARIANTS: list[dict[str, Any]] = [
    {"control": control, "reward": reward, **more}
    for control, reward in itertools.product(("hand", "joint"), ("sparse", "dense"))
    for more in ({"language": TALK}, {"objects": 6, "movements": ["circle", "zigzag"], "people_seed": 4})
]
SMALL: dict[str, Any] = {"size": (48, 64)}


def has_opengl() -> bool:
    try:
        choose_backend()
    except signimit.SignimitError:
        return False
    return True


needs_opengl = pytest.mark.skipif(not has_opengl(), reason="there is no OpenGL")


def episode(env: gym.Env[Any, Any], steps: int) -> bytes:
    env.action_space.seed(9)
    seen: list[Any] = [env.reset(seed=4)]
    seen += [env.step(env.action_space.sample()) for _ in range(steps)]
    seen += [env.reset(), env.step(env.action_space.sample())]
    return pickle.dumps(seen)


@pytest.mark.parametrize("arguments", VARIANTS)
def test_every_variant_is_approved_of_repeats_itself_and_survives_json(arguments: dict[str, Any]) -> None:
    env = gym.make(ENV_IDS[0], **arguments)
    check_env(env.unwrapped, skip_render_check=True)
    first = episode(env, 10)
    assert episode(env, 10) == first
    assert env.spec is not None
    again = gym.make(EnvSpec.from_json(env.spec.to_json()))
    assert episode(again, 10) == first
    assert again.action_space == env.action_space
    assert again.observation_space == env.observation_space
    for one in (env, again):
        one.close()


@needs_opengl
@pytest.mark.parametrize("obs_type", ["pixels", "state_pixels"])
def test_pictures_are_approved_of_repeat_themselves_and_survive_json(obs_type: str) -> None:
    env = gym.make(ENV_IDS[1], obs_type=obs_type, language=TALK, **SMALL)
    check_env(env.unwrapped, skip_render_check=True)
    first = episode(env, 2)
    assert episode(env, 2) == first
    assert env.spec is not None
    again = gym.make(EnvSpec.from_json(env.spec.to_json()))
    assert episode(again, 2) == first
    for one in (env, again):
        one.close()


def test_a_language_as_an_object_is_the_same_as_its_fields() -> None:
    fields = {name: tuple(value) if isinstance(value, list) else value for name, value in TALK.items()}
    env = gym.make(ENV_IDS[0], language=Language(**fields))  # type: ignore[arg-type]
    other = gym.make(ENV_IDS[0], language=TALK)
    assert episode(env, 2) == episode(other, 2)
    assert env.spec is not None
    assert episode(gym.make(EnvSpec.from_json(env.spec.to_json())), 2) == episode(other, 2)


def test_both_ids_take_both_controls() -> None:
    sizes = {"hand": (2,), "joint": (3,)}
    for env_id, control in itertools.product(ENV_IDS, sizes):
        env = gym.make(env_id, control=control)
        assert env.action_space.shape == sizes[control]
        env.close()
    assert gym.make(ENV_IDS[0]).action_space.shape == (3,)
    assert gym.make(ENV_IDS[1]).action_space.shape == (2,)


def test_the_hand_moves_alike_under_both_ids() -> None:
    one, other = TabletopEnv(control="hand"), TabletopHandEnv()
    for env in (one, other):
        env.reset(seed=1)
    for _ in range(5):
        assert data_equivalence(one.step([0.3, -0.2]), other.step([0.3, -0.2]), exact=True)
    observation, *_ = one.step([0.0, 0.0])
    np.testing.assert_array_equal(one.hand, observation["hand"])


def test_a_policy_is_reproduced_by_any_environment_whose_hand_is_commanded() -> None:
    objects = [[-0.15, 0.1], [0.02, -0.1], [0.18, 0.08]]
    tracks = [
        reproduce(env, lambda hand: np.array([0.1, -0.1]), objects, [0.0, 0.0], 1.0)
        for env in (TabletopEnv(control="hand"), TabletopHandEnv())
    ]
    np.testing.assert_array_equal(tracks[0].path, tracks[1].path)
    with pytest.raises(signimit.InvalidInputError, match=r"environment: expected .* found control='joint'"):
        reproduce(TabletopHandEnv(control="joint"), lambda hand: hand, objects, [0.0, 0.0], 1.0)


def test_utterances_have_the_order_and_the_fillers_of_the_language() -> None:
    arm = TabletopEnv(language=TALK)
    observation, info = arm.reset(seed=0, options={"movement": 1, "focus": 3})
    assert observation["signs"].shape == (3, 64, 2)
    assert observation["objects"].shape == (4, 2)
    words = ("square", "8", "9", "spiral")
    shown = [[arm.people.signs.draw(word, np.random.default_rng(seed)).points for seed in range(3)] for word in words]
    nearest = [
        min(
            range(4),
            key=lambda w: min(signimit.dtw_distance(sign, signimit.signs.normalised_sign(s)) for s in shown[w]),
        )
        for sign in observation["signs"]
    ]
    assert (words[nearest[0]], words[nearest[2]]) == ("square", "spiral")
    assert words[nearest[1]] in ("8", "9")
    assert info["request"] == (1, 3)


def test_real_strokes_come_from_files_and_a_seed_decides_which(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    synthetic_library(("1", "2", "3", "4"), writers=2, samples=3, rng=rng).save(tmp_path / "signs.npz")
    synthetic_library(("circle",), samples=3, rng=rng).save(tmp_path / "movements.npz")
    env = gym.make(
        ENV_IDS[1],
        movements=["circle"],
        signer=[str(tmp_path / "signs.npz"), "synthetic 2"],
        mover=str(tmp_path / "movements.npz"),
    )
    assert episode(env, 2) == episode(env, 2)
    library = signimit.StrokeLibrary.load(tmp_path / "signs.npz").select(writer="synthetic 2")
    known = [signimit.signs.normalised_sign(stroke.points) for stroke in library]
    observation, _ = env.reset(seed=8)
    for sign in observation["signs"]:
        assert any(np.array_equal(sign, one) for one in known)
    assert env.spec is not None
    assert episode(gym.make(EnvSpec.from_json(env.spec.to_json())), 2) == episode(env, 2)


def test_success_is_told_from_the_first_observation_on() -> None:
    for env_id in ENV_IDS:
        env = gym.make(env_id)
        infos = [env.reset(seed=0)[1], *(env.step(env.action_space.sample())[4] for _ in range(3))]
        assert [info["is_success"] for info in infos] == [False] * 4


def test_flat_observations_and_episode_statistics() -> None:
    env = wrappers.RecordEpisodeStatistics(wrappers.FlattenObservation(gym.make(ENV_IDS[0], max_episode_steps=3)))
    assert env.observation_space.shape == (2 + 2 + 3 + 3 + 3 * 2 + 2 * 64 * 2,)
    observation, _ = env.reset(seed=0)
    assert observation in env.observation_space
    for _ in range(3):
        *_, truncated, info = env.step(env.action_space.sample())
    assert truncated
    assert info["episode"]["l"] == 3
    assert info["is_success"] is False


@needs_opengl
def test_rendered_observations_can_be_added() -> None:
    env = wrappers.AddRenderObservation(gym.make(ENV_IDS[1], render_mode="rgb_array", **SMALL), render_only=False)
    observation, _ = env.reset(seed=0)
    assert observation in env.observation_space
    assert {"signs", "pixels"} <= set(observation)
    assert observation["pixels"].shape == (64, 48, 3)
    env.close()


@needs_opengl
def test_what_a_picture_shows() -> None:
    env = gym.make(ENV_IDS[1], obs_type="state_pixels", camera="top", size=(96, 128))
    assert isinstance(env.observation_space, gym.spaces.Dict)
    assert env.observation_space["pixels"] == gym.spaces.Box(0, 255, (128, 96, 3), np.uint8)
    far = {"objects": [[-0.2, 0.1], [0.0, 0.1], [0.2, 0.1]], "hand": [0.0, -0.15], "movement": 0}
    first = env.reset(seed=0, options={**far, "focus": 0})[0]["pixels"]
    other = env.reset(seed=0, options={**far, "focus": 1})[0]["pixels"]
    cards, scene = first[:32], first[32:]
    np.testing.assert_array_equal(scene, other[32:])  # the request shows in the signs only
    assert (cards[:, :48] != other[:32, :48]).any()
    moved = env.reset(seed=0, options={**far, "focus": 0, "hand": [0.2, -0.1]})[0]["pixels"]
    assert (moved[32:] != scene).any()
    np.testing.assert_array_equal(moved[:32], cards)
    env.close()


def test_pictures_without_opengl_are_refused_in_a_sentence_and_states_are_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.video.backend._first_working_backend", lambda _: ("", "no OpenGL works", ""))
    gym.make(ENV_IDS[0]).reset(seed=0)
    with pytest.raises(RenderingError, match="no OpenGL works"):
        gym.make(ENV_IDS[0], obs_type="pixels", disable_env_checker=True).reset(seed=0)


@needs_opengl
def test_vectorised_pictures() -> None:
    envs = gym.make_vec(ENV_IDS[0], num_envs=2, vectorization_mode="sync", obs_type="pixels", **SMALL)
    observations, _ = envs.reset(seed=0)
    assert observations.shape == (2, 64, 48, 3)
    assert (observations[0] != observations[1]).any()
    envs.close()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"obs_type": "smell"}, "Unknown obs_type 'smell'; known are state, pixels, state_pixels"),
        ({"control": "foot"}, "Unknown control 'foot'; known are hand, joint"),
        ({"reward": "gold"}, "Unknown reward 'gold'; known are sparse, dense"),
        ({"discount": 1.5}, "discount: expected 0 to 1, found 1.5"),
        ({"discount": float("nan")}, "discount: expected 0 to 1, found nan"),
        ({"obs_type": "pixels", "size": (16, 96)}, "at least 32 by 32 pixels, to see signs, found 16 by 96"),
        ({"objects": 2.5}, "objects: expected 2 to 6, found 2.5"),
        ({"movements": "circle"}, "movements: expected 1 to 7 labels, found 'circle'"),
        ({"language": {"verbs": []}}, "Unknown field of a language 'verbs'; known are focus_signs"),
        ({"language": 7}, "language: expected a Language or a mapping of its fields, found int"),
        ({"language": {"focus_signs": "12"}}, "language: focus_signs: expected a list, found '12'"),
        ({"language": {"focus_signs": [1, 2]}}, r"language: focus_signs: expected labels, found \[1, 2\]"),
        ({"language": {"focus_word": 1.5}}, "language: focus_word: expected whole numbers, found 1.5"),
        ({"language": {"unseen": [[1]]}}, "language: unseen: expected pairs of a movement and an object"),
        ({"language": {"focus_signs": ["1"]}}, "objects: expected 2 to 6, found 1"),
        ({"language": {"focus_signs": ["1", "hello"]}}, "Unknown sign 'hello'; known are 0, 1"),
        ({"language": TALK, "objects": 3}, "objects: expected the 4 of the language, or none, found 3"),
        ({"language": TALK, "movements": ["star"]}, "movements: expected those of the language, .* found .'star'"),
        ({"signer": 3}, "signer: expected a stroke library file, or that and a person in it, found 3"),
    ],
)
def test_arguments_that_cannot_be_are_refused_in_a_sentence(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(signimit.SignimitError, match=message):
        TabletopEnv(**arguments)
