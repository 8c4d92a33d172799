"""The default policy draws what was shown, from anywhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from signimit.exceptions import InvalidInputError
from signimit.policies.base import CONTROL_PERIOD, check_demonstrations
from signimit.policies.path_following import PathFollowingPolicy, PhaseState
from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS

Array = NDArray[np.float64]
Compose = Callable[..., Any]
TABLE = np.array([0.42, 0.38])


def learn(shown: Any) -> PathFollowingPolicy:
    return PathFollowingPolicy.learn(check_demonstrations(shown.paths, shown.times))


def drive(
    policy: PathFollowingPolicy, hands: Array, steps: int, state: PhaseState | None = None
) -> tuple[Array, PhaseState]:
    """Move hands, shape (steps + 1, B, 2), and return the last state too."""
    path, state = [hands], policy.start() if state is None else state
    for _ in range(steps):
        state, velocity = policy.step(state, path[-1])
        path.append(path[-1] + CONTROL_PERIOD * velocity)
    return np.array(path), state


def away(policy: PathFollowingPolicy, hands: Array) -> Array:
    """Distance to the nearest node, in half sizes."""
    gaps: Array = cdist(hands.reshape(-1, 2), policy.course).min(axis=1).reshape(hands.shape[:-1])
    return gaps / policy.half_size


CIRCLE = 0.1 * np.column_stack([f(2 * np.pi * np.arange(100) / 100) for f in (np.cos, np.sin)])
EIGHT = 0.1 * np.column_stack([np.sin(2 * np.pi * k * np.arange(120) / 120) for k in (1, 2)])


def following(course: Array, closed: float = 1.0) -> PathFollowingPolicy:
    return PathFollowingPolicy(course=course, closed=closed, half_size=0.1, reach_speed=0.3)


@pytest.mark.parametrize("label", [*MOVEMENT_LABELS, *GOAL_LABELS])
def test_ten_thousand_hands_stay_on_the_table_and_end_up_drawing(label: str, shown: Compose) -> None:
    rng, seeds = np.random.default_rng(0), 2
    for seed in range(seeds):
        policy = learn(shown(label, seed=seed))
        focus = rng.uniform(-TABLE / 2, TABLE / 2)
        hands = rng.uniform(-TABLE, TABLE, (-(-10_000 // (13 * seeds)), 2)) - focus
        path, _ = drive(policy, hands, 300)
        assert (np.abs(path + focus) < TABLE + 1e-3).all()
        assert away(policy, path[200:]).max() < 0.3
        way = np.hypot(*np.moveaxis(np.diff(path[200:], axis=0), -1, 0)).sum(axis=0)
        assert (way > 0.5 * policy.half_size).all() if policy.closed else (way < 0.01).all()


def test_a_hand_on_the_course_moves_from_node_to_node() -> None:
    policy = following(CIRCLE)
    path, _ = drive(policy, CIRCLE[7], 250)
    np.testing.assert_allclose(path, CIRCLE[(7 + np.arange(251)) % 100], atol=1e-12)


def test_a_crossing_is_passed_straight() -> None:
    path, _ = drive(following(EIGHT), EIGHT[3], 360)
    np.testing.assert_allclose(path[1:], EIGHT[(4 + np.arange(360)) % 120], atol=1e-9)


def test_a_far_hand_goes_straight_to_the_nearest_place_at_the_speed_of_the_reach() -> None:
    velocity = following(CIRCLE)([0.5, 0.0])
    np.testing.assert_allclose(velocity, [-0.3, 0.0], atol=2e-3)


def test_after_a_shove_the_hand_is_back_within_a_second() -> None:
    for course in (CIRCLE, EIGHT):
        policy, rng = following(course), np.random.default_rng(0)
        path, state = drive(policy, course[rng.integers(len(course), size=200)], 40)
        angles = rng.uniform(0, 2 * np.pi, 200)
        shoved = path[-1] + 0.08 * np.column_stack([np.cos(angles), np.sin(angles)])
        path, _ = drive(policy, shoved, 100, state)
        assert away(policy, path[50:]).max() < 0.1


def test_a_hand_that_is_held_is_waited_for() -> None:
    policy = following(CIRCLE)
    _, state = drive(policy, CIRCLE[0], 10)
    for _ in range(200):
        state, velocity = policy.step(state, CIRCLE[10])
    assert isinstance(state.nodes, int)
    assert abs(state.nodes - 10) < 10
    assert np.hypot(*velocity) < 1.0


def test_a_slow_hand_still_draws() -> None:
    policy, hand, state = following(CIRCLE), CIRCLE[0], following(CIRCLE).start()
    path = [hand]
    for _ in range(400):
        state, velocity = policy.step(state, path[-1])
        path.append(path[-1] + 0.5 * CONTROL_PERIOD * velocity)
    assert away(policy, np.array(path)).max() < 0.15
    angle = np.unwrap(np.arctan2(*np.array(path).T[::-1]))
    assert angle[-1] - angle[0] > 2 * np.pi


def test_a_goal_is_reached_by_the_way_shown_and_not_left() -> None:
    way = np.column_stack([np.linspace(-0.2, 0.0, 60), 0.1 * np.sin(np.linspace(0, np.pi, 60))])
    policy = following(way, closed=0.0)
    path, _ = drive(policy, np.array([[0.3, 0.0], [-0.3, 0.2], [0.0, -0.3]]), 400)
    np.testing.assert_allclose(path[-1], 0.0, atol=1e-6)
    over_the_top = np.hypot(*np.moveaxis(path - way[30], -1, 0)).min(axis=0)
    assert (over_the_top < 0.02).all()


def test_speed_along_the_drawing_is_the_demonstrators(shown: Compose) -> None:
    for label in ("triangle up", "square"):
        demonstrations = shown(label)
        path, _ = drive(learn(demonstrations), np.array([0.3, 0.3]), 500)
        drawn, speed = path[200:-1], np.hypot(*np.diff(path[200:], axis=0).T) / CONTROL_PERIOD
        theirs = []
        for loop in demonstrations.loops:
            pace = np.hypot(*np.gradient(loop, CONTROL_PERIOD, axis=0).T)
            theirs.append(pace[cdist(drawn, loop).argmin(axis=1)])
        assert np.corrcoef(np.mean(theirs, axis=0), speed)[0, 1] > 0.8
        assert speed.mean() == pytest.approx(np.mean(theirs), rel=0.15)


def test_states_are_values(shown: Compose) -> None:
    policy = following(CIRCLE)
    hands = np.random.default_rng(0).uniform(-0.3, 0.3, (5, 2))
    state, _ = policy.step(policy.start(), hands)
    assert state.nodes is not None
    assert not np.asarray(state.nodes).flags.writeable
    first, second = policy.step(state, hands), policy.step(state, hands)
    np.testing.assert_array_equal(first[1], second[1])


def test_a_course_of_another_shape_is_refused() -> None:
    for course, scale in ((np.zeros((3, 3)), 0.1), (CIRCLE[:1], 0.1), (CIRCLE, 0.0)):
        with pytest.raises(InvalidInputError, match="policy"):
            PathFollowingPolicy(course=course, closed=1.0, half_size=scale, reach_speed=0.3)
