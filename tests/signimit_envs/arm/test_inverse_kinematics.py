"""The simulated hand does in every control step what it was commanded, or says how much is missing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import gymnasium as gym
import mink
import numpy as np
import pytest
from numpy.typing import NDArray

from signimit_envs import TabletopEnv
from signimit_envs.arm.inverse_kinematics import HandController
from signimit_envs.arm.scene import WORKSPACE, compile_scene, home_posture
from signimit_envs.sessions.reproduction import reproduce

OBJECTS = [[0.0, 0.0], [0.2, 0.1], [-0.2, 0.1]]


def circling(centre: Any, radius: float, speed: float) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    def policy(hand: NDArray[np.float64]) -> NDArray[np.float64]:
        away = np.asarray(hand) - centre
        distance = np.hypot(*away)
        way = np.array([-away[1], away[0]]) / distance - 3 * (distance / radius - 1) * away / distance
        return np.asarray(speed * way / np.hypot(*way))

    return policy


class Triangle:
    """Goes round a triangle with sharp corners at constant speed; keeps the next corner as its state."""

    def __init__(self, centre: Any, radius: float, speed: float) -> None:
        self.corners = np.asarray(centre) + radius * np.array([[0, 1], [-0.9, -0.6], [0.9, -0.6]])
        self.speed = speed

    def start(self) -> int:
        return 0

    def step(self, state: int, hand: NDArray[np.float64]) -> tuple[int, NDArray[np.float64]]:
        if np.hypot(*(self.corners[state] - hand)) < 0.012:
            state = (state + 1) % 3
        way = self.corners[state] - hand
        return state, self.speed * way / np.hypot(*way)

    def __call__(self, hand: NDArray[np.float64]) -> NDArray[np.float64]:
        raise AssertionError("a policy with a state is stepped")


@pytest.fixture(scope="module")
def env() -> Any:
    env = gym.make("signimit/TabletopHand-v0")
    yield env
    env.close()


@pytest.fixture(scope="module")
def controller() -> HandController:
    return HandController(compile_scene())


def test_the_hand_is_where_it_was_commanded_to_be(env: Any) -> None:
    """Round at 0.2 to 0.5 m/s, sharp corners too: RMS <= 2 mm, at most 6 mm, 95 % of directions within 3 degrees."""
    gaps, angles = [], []
    for speed in (0.2, 0.35, 0.5):
        for centre in ([0.0, 0.0], [0.3, 0.26], [-0.3, 0.26], [-0.3, -0.26], [0.3, -0.26]):
            for policy in (circling(centre, 0.1, speed), Triangle(centre, 0.1, speed)):
                path, commanded = reproduce(env, policy, OBJECTS, np.add(centre, [0.0, 0.1]), 0.65 / speed)
                gaps.append(np.hypot(*(path[1:] - commanded).T))
                done, wanted = path[1:] - path[:-1], commanded - path[:-1]
                turn = np.arctan2(done[:, 1], done[:, 0]) - np.arctan2(wanted[:, 1], wanted[:, 0])
                angles.append(np.degrees(np.abs((turn + np.pi) % (2 * np.pi) - np.pi)))
    assert max(np.sqrt((g**2).mean()) for g in gaps) <= 0.002
    assert np.concatenate(gaps).max() <= 0.006
    assert max(np.percentile(a, 95) for a in angles) <= 3.0


def test_a_resting_command_rests(env: Any) -> None:
    env.reset(seed=0, options={"hand": [0.1, -0.2]})
    for _ in range(50):
        observation, *_ = env.step(np.zeros(2))
    np.testing.assert_allclose(observation["hand"], [0.1, -0.2], atol=1e-5)
    np.testing.assert_allclose(observation["hand_velocity"], 0.0, atol=1e-5)


def test_after_wild_commands_the_drives_come_to_rest_and_do_not_hunt(env: Any) -> None:
    rng = np.random.default_rng(0)
    env.reset(seed=0)
    for _ in range(100):
        env.step(rng.choice([-1.0, 1.0], 2))
    for _ in range(25):
        observation, *_ = env.step(np.zeros(2))
    assert np.abs(observation["joint_velocities"]).max() < 0.01


@pytest.mark.parametrize("direction", [(1, 1), (-1, 1), (1, -1), (-1, -1), (0, 1), (0, -1), (1, 0), (-1, 0)])
def test_beyond_its_reach_the_hand_goes_as_far_as_it_can_and_says_so_and_comes_back(
    env: Any, direction: tuple[int, int]
) -> None:
    env.reset(seed=0, options={"hand": [0.0, 0.0]})
    residuals = []
    for _ in range(120):
        observation, _, terminated, _, info = env.step(np.array(direction, dtype=float))
        assert not terminated
        residuals.append(info["ik_residual"])
    assert residuals[0] < 1e-5
    assert max(residuals) > 0.01
    farthest = observation["hand"]
    for _ in range(60):
        observation, _, _, _, info = env.step(-0.3 * np.array(direction))
    assert (observation["hand"] - farthest) @ direction < -0.2


def test_a_start_outside_the_joint_ranges_is_brought_inside(controller: HandController) -> None:
    command = controller.solve(np.array([5.0, -3.0, 9.0]), np.array([0.005, 0.0]), 0.02)
    assert np.isfinite(command.velocities).all()
    assert np.isfinite(command.residual)


def test_when_the_solver_gives_up_the_arm_stays_and_the_whole_displacement_is_left(
    controller: HandController, monkeypatch: pytest.MonkeyPatch
) -> None:
    def give_up(*_: Any, **__: Any) -> None:
        raise mink.NoSolutionFound("daqp")

    monkeypatch.setattr(mink, "solve_ik", give_up)
    velocities, residual = controller.solve(home_posture(compile_scene()), np.array([0.003, 0.004]), 0.02)
    np.testing.assert_array_equal(velocities, 0.0)
    assert residual == pytest.approx(0.005)


def test_joint_velocities_stay_within_the_drives(controller: HandController) -> None:
    for direction in ([1.0, 0.0], [0.0, 1.0], [-0.7, -0.7]):
        command = controller.solve(home_posture(compile_scene()), 0.3 * np.array(direction), 0.02)
        assert np.abs(command.velocities).max() <= 3.5 + 1e-6
        assert command.residual > 0.1


def test_one_control_step_of_the_joints_turns_them_as_commanded() -> None:
    env = gym.make("signimit/Tabletop-v0")
    before, _ = env.reset(seed=3)
    for _ in range(10):
        after, *_ = env.step([0.1, -0.05, 0.07])
    turned = (after["joints"] - before["joints"]) / 10
    np.testing.assert_allclose(turned, 3.5 * np.array([0.1, -0.05, 0.07]) / 50, rtol=0.02)
    env.close()


def test_joints_stop_at_their_limits() -> None:
    env = TabletopEnv()
    env.reset(seed=0)
    for sign in (1.0, -1.0):
        for _ in range(100):
            observation, _, terminated, _, _ = env.step(np.full(3, sign))
        assert not terminated
        ranges = env.model.jnt_range[:, int(sign > 0)]
        np.testing.assert_allclose(observation["joints"], ranges, atol=0.02)
    env.close()


def test_the_workspace_is_what_is_promised() -> None:
    np.testing.assert_array_equal(WORKSPACE, [0.42, 0.38])
