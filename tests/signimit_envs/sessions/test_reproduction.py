"""The simulated hand does what a policy says, about the object that it says it about."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from numpy.typing import NDArray

import signimit
from signimit.evaluation import count_turns
from signimit_envs import HandTrack, TabletopHandEnv, reproduce

OBJECTS = np.array([[-0.15, 0.1], [0.02, -0.1], [0.18, 0.08]])
Policy = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def circling(centre: NDArray[np.float64], sense: int = 1, radius: float = 0.07, speed: float = 0.35) -> Policy:
    def policy(hand: NDArray[np.float64]) -> NDArray[np.float64]:
        away = hand - centre
        distance = np.hypot(*away) + 1e-9
        way = sense * np.array([-away[1], away[0]]) / distance - 4 * (distance / radius - 1) * away / distance
        return np.asarray(speed * way / np.hypot(*way))

    return policy


@pytest.fixture(scope="module")
def env() -> Any:
    env = gym.make("signimit/TabletopHand-v0")
    yield env
    env.close()


@pytest.mark.parametrize("focus", [0, 1, 2])
@pytest.mark.parametrize("sense", [1, -1])
def test_the_hand_winds_about_the_right_object_in_the_right_sense_and_about_no_other(
    env: Any, focus: int, sense: int
) -> None:
    path = reproduce(env, circling(OBJECTS[focus], sense), OBJECTS, [0.0, 0.0], 6.0).path
    turns = [count_turns(path, place) for place in OBJECTS]
    assert sense * turns[focus] >= 2.0
    assert all(abs(turns[other]) < 1.0 for other in range(3) if other != focus)


def test_moving_the_objects_moves_the_path_with_them(env: Any) -> None:
    shift = np.array([0.06, -0.05])
    paths = [
        reproduce(env, circling(OBJECTS[1] + by), OBJECTS + by, OBJECTS[1] + by + [0.07, 0.0], 4.0).path
        for by in (np.zeros(2), shift)
    ]
    np.testing.assert_allclose(paths[1] - paths[0], np.tile(shift, (len(paths[0]), 1)), atol=0.002)


def test_the_track_starts_at_the_hand_and_has_one_command_a_step(env: Any) -> None:
    track = reproduce(env, lambda hand: [0.1, 0.0], OBJECTS, [-0.1, 0.05], 1.0)
    assert isinstance(track, HandTrack)
    assert track.path.shape == (51, 2)
    assert track.commanded.shape == (50, 2)
    np.testing.assert_allclose(track.path[0], [-0.1, 0.05], atol=1e-5)
    np.testing.assert_allclose(track.commanded, track.path[:-1] + np.array([0.002, 0.0]), atol=1e-12)
    np.testing.assert_allclose(track.path[-1], [0.0, 0.05], atol=0.002)


def test_too_fast_a_command_keeps_its_direction(env: Any) -> None:
    track = reproduce(env, lambda hand: [3.0, 1.5], OBJECTS, [-0.3, 0.0], 0.2)
    way = track.path[-1] - track.path[0]
    assert way[1] / way[0] == pytest.approx(0.5, abs=0.05)
    ahead = track.commanded - track.path[:-1]
    np.testing.assert_allclose(ahead, np.tile([1.0, 0.5], (10, 1)) * TabletopHandEnv.max_hand_speed / 50)


def test_every_frame_of_the_way_can_be_watched(env: Any) -> None:
    seen: list[float] = []
    arm = env.unwrapped
    track = reproduce(
        env, lambda hand: [0.1, 0.0], OBJECTS, [0.0, 0.0], 0.5, lambda: seen.append(arm.data.site("hand").xpos[0])
    )
    np.testing.assert_allclose(seen, track.path[:, 0])


def test_a_learned_policy_circles_where_it_was_shown_to(env: Any) -> None:
    times = np.arange(0.0, 3.0, 0.02)
    loops = [0.08 * np.column_stack([np.cos(4 * times + a), np.sin(4 * times + a)]) for a in (0.0, 1.0, 2.0)]
    policy = signimit.make_policy(loops, [times] * 3, kind="knn")
    path = reproduce(env, lambda hand: policy(hand - OBJECTS[2]), OBJECTS, [0.0, 0.0], 12.0).path
    assert count_turns(path, OBJECTS[2]) > 2.0


def test_the_arm_must_be_commanded_by_its_hand() -> None:
    joints = gym.make("signimit/Tabletop-v0")
    with pytest.raises(signimit.InvalidInputError, match="environment: expected signimit/TabletopHand-v0"):
        reproduce(joints, lambda hand: hand, OBJECTS, [0.0, 0.0], 1.0)
    joints.close()


@pytest.mark.parametrize(
    ("velocity", "complaint"),
    [
        ([np.nan, 0.0], "action: expected 2 finite numbers"),
        ([[0.0, 0.0]], "action: expected 2 numbers"),
        ([0.0, 0.0, 0.0], r"policy: expected velocities along x and y, found shape \(3,\)"),
        (0.0, r"policy: expected velocities along x and y, found shape \(\)"),
        ([], r"policy: expected velocities along x and y, found shape \(0,\)"),
    ],
)
def test_a_policy_that_commands_nonsense_is_stopped(env: Any, velocity: Any, complaint: str) -> None:
    with pytest.raises(signimit.InvalidInputError, match=complaint):
        reproduce(env, lambda hand: velocity, OBJECTS, [0.0, 0.0], 1.0)
