"""The judge beside an episode says the same as the evaluation of the whole path, and says it once."""

from __future__ import annotations

from typing import Any

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


def drive(course: NDArray[np.float64], movement: int, focus: int, people_seed: int = 0) -> list[dict[str, Any]]:
    """Let the hand follow a course about an object of `OBJECTS` for an episode, then rest; return the infos."""
    env = TabletopHandEnv(people_seed=people_seed)
    start = course[0] + OBJECTS[focus]
    observation, _ = env.reset(
        seed=0, options={"movement": movement, "focus": focus, "objects": OBJECTS, "hand": start}
    )
    infos = []
    for step in range(600):
        target = course[min(step + 1, len(course) - 1)] + OBJECTS[focus]
        observation, *_, info = env.step((target - observation["hand"]) * 50 / env.max_hand_speed)
        infos.append(info)
    return infos


CIRCLE = 2  # number of the circle among the environment's movements


@pytest.mark.parametrize("focus", [0, 1, 2])
@pytest.mark.parametrize("seed", [0, 1])
def test_half_a_turn_and_then_standing_still_never_succeeds(seed: int, focus: int) -> None:
    shown = TabletopHandEnv(people_seed=seed).people.templates[CIRCLE][1]
    half = shown[: np.searchsorted(np.cumsum(np.hypot(*np.diff(shown, axis=0).T)), 0.32)]
    infos = drive(half, CIRCLE, focus, seed)
    assert not any(info["is_success"] for info in infos)
    assert infos[-1]["success_performance"].movement == -1


@pytest.mark.parametrize("focus", [0, 1, 2])
def test_a_clockwise_triangle_is_no_circle_and_no_triangle(focus: int) -> None:
    infos = drive(np.tile(loop(3, -1), (4, 1)), CIRCLE, focus)
    assert not any(info["is_success"] for info in infos)


def test_success_comes_after_a_whole_round_and_not_before_and_its_performance_is_kept() -> None:
    shown = TabletopHandEnv().people.templates[CIRCLE][0]
    infos = drive(np.concatenate([shown, shown - [0.3, 0.0]]), CIRCLE, 0)
    fulfilled = [info["is_success"] for info in infos]
    at = fulfilled.index(True)
    way = np.cumsum(np.hypot(*np.diff(shown, axis=0).T))
    assert way[min(at, len(way) - 1)] >= 0.93 * way[-1]
    assert at <= len(shown) + 27
    at_success = infos[at]
    assert at_success["performance"] == at_success["success_performance"]
    assert infos[-1]["success_performance"] == at_success["success_performance"]
    assert infos[-1]["performance"].movement == -1


def test_standing_still_where_the_drawing_leads_fulfils_nothing() -> None:
    for point in TEMPLATES[1][0][::20]:
        judge = SuccessDetector(TEMPLATES)
        judge.start(Request(1, 0), OBJECTS, point + OBJECTS[0])
        assert not any([judge.watch(point + OBJECTS[0]) for _ in range(600)])
        assert judge.performance.movement == -1
