"""The judge beside an episode says the same as the evaluation of the whole path, and says it once."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from numpy.typing import NDArray

import signimit
from signimit.teaching.languages import Request
from signimit_envs import TabletopHandEnv
from signimit_envs.tabletop.success import WINDOW, PathRecord, SuccessDetector

OBJECTS = np.array([[-0.15, 0.1], [0.02, -0.1], [0.18, 0.08]])


def loop(corners: int, sense: int = 1) -> NDArray[np.float64]:
    turn = sense * np.linspace(0, 2 * np.pi, 101)
    radius = np.cos(np.pi / corners) / np.cos((turn % (2 * np.pi / corners)) - np.pi / corners)
    return np.asarray(0.1 * radius[:, None] * np.column_stack([np.cos(turn), np.sin(turn)]))


TEMPLATES = [[loop(3), loop(3)], [loop(90), loop(90)], [loop(90, -1), loop(90, -1)]]


@pytest.mark.parametrize("movement", [0, 1, 2])
@pytest.mark.parametrize("focus", [0, 2])
def test_what_is_asked_for_is_noticed_once_and_what_is_not_never(movement: int, focus: int) -> None:
    path = np.tile(TEMPLATES[movement][0][:-1], (4, 1)) + OBJECTS[focus]
    for request in (Request(m, f) for m in range(3) for f in range(3)):
        judge = SuccessDetector(TEMPLATES)
        judge.start(request, OBJECTS, path[0])
        noticed = [judge.watch(hand) for hand in path[1:]]
        assert sum(noticed) == int(request == (movement, focus))
        assert judge.done is (request == (movement, focus))
        if judge.done:
            at = noticed.index(True)
            assert judge.success_performance == signimit.performed(path[: at + 2], OBJECTS, TEMPLATES)


def test_a_resting_hand_and_a_passing_one_fulfil_nothing() -> None:
    for path in (np.zeros((300, 2)), np.column_stack([np.linspace(-0.4, 0.4, 300), np.zeros(300)])):
        judge = SuccessDetector(TEMPLATES)
        judge.start(Request(1, 1), OBJECTS, path[0])
        assert not any(judge.watch(hand) for hand in path)
        assert judge.performance.movement == -1


def test_a_new_episode_forgets_the_last_one() -> None:
    path = np.tile(TEMPLATES[1][0][:-1], (4, 1)) + OBJECTS[0]
    judge = SuccessDetector(TEMPLATES)
    judge.start(Request(1, 0), OBJECTS, path[0])
    assert any([judge.watch(hand) for hand in path])
    judge.start(Request(1, 0), OBJECTS, path[0])
    assert not judge.done


def test_the_record_keeps_the_latest_positions() -> None:
    record, points = PathRecord(), np.random.default_rng(0).normal(size=(3 * WINDOW + 17, 2))
    for count, point in enumerate(points, 1):
        record.append(point)
        if count in (1, WINDOW, WINDOW + 1, 2 * WINDOW, 2 * WINDOW + 1, len(points)):
            np.testing.assert_array_equal(record.latest, points[max(0, count - WINDOW) : count])
    record.clear()
    assert len(record.latest) == 0


def test_an_obeyed_request_is_rewarded_once_and_does_not_end_the_episode() -> None:
    """On the physics: the hand follows the demonstrator's own drawing."""
    env = gym.make("signimit/TabletopHand-v0")
    arm = env.unwrapped
    assert isinstance(arm, TabletopHandEnv)
    shown = arm.people.templates[2][0]
    course = np.vstack([np.tile(shown, (5, 1))]) + OBJECTS[0]
    options = {"movement": 2, "focus": 0, "objects": OBJECTS, "hand": course[0]}
    observation, info = env.reset(seed=0, options=options)
    assert info["request"] == (2, 0)
    rewards = []
    for target in course[1:400]:
        velocity = (target - observation["hand"]) * 50
        observation, reward, terminated, _, info = env.step(velocity / arm.max_hand_speed)
        rewards.append(float(reward))
        assert not terminated
        assert info["is_success"] is (sum(rewards) > 0)
    assert sum(rewards) == 1.0
    performance = info["success_performance"]
    assert (performance.movement, performance.focus) == (2, 0)
    assert performance.misfit <= 0.35
    env.close()
