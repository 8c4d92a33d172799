"""The arm obeys, follows what is dragged, comes back when shoved, tells what it did, and keeps up with the clock."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

import signimit as si
from signimit.teaching.people import Person
from signimit.teaching.scenes import drawn_path, sample_times
from signimit_envs.studio.arm.live_arm import FASTEST_CATCH_UP, LONGEST_DELAY, OBJECT_WIDTH, LiveArm, RealTimeClock
from signimit_envs.studio.arm.live_state import Task, TrackPart, is_alike

OBJECTS = np.array([[-0.2, 0.05], [0.0, 0.15], [0.2, -0.05]])
ORIGIN = np.zeros(2)
PERIOD = 0.02  # s, of a control step


@pytest.fixture(scope="module")
def loops() -> list[NDArray[np.float64]]:
    person, rng = Person.sample(np.random.default_rng(0)), np.random.default_rng(1)
    return [drawn_path(person.draw("triangle up", rng), 0.1) for _ in range(3)]


@pytest.fixture(scope="module")
def policy(loops: list[NDArray[np.float64]]) -> si.Policy:
    paths = [np.concatenate([loop, loop]) for loop in loops]
    return si.make_policy(paths, [sample_times(len(path)) for path in paths])


@pytest.fixture
def parts() -> list[TrackPart]:
    return []


@pytest.fixture
def arm(parts: list[TrackPart]) -> Iterator[LiveArm]:
    live = LiveArm(parts.append)
    live.put("session", OBJECTS, ORIGIN)
    yield live
    live.close()


def _path(arm: LiveArm, steps: int) -> NDArray[np.float64]:
    path = []
    for _ in range(steps):
        arm.step()
        path.append(arm.state.hand)
    return np.array(path)


def test_the_hand_draws_about_the_object_that_was_asked_for(
    arm: LiveArm, policy: si.Policy, loops: list[NDArray[np.float64]]
) -> None:
    arm.obey(Task("session", 0, policy, 2, "text"))
    performance = si.performed(_path(arm, 400), OBJECTS, [loops])
    assert (performance.movement, performance.focus) == (0, 2)


def test_the_path_follows_an_object_that_is_dragged_away(
    arm: LiveArm, policy: si.Policy, loops: list[NDArray[np.float64]]
) -> None:
    arm.obey(Task("session", 0, policy, 2, "text"))
    _path(arm, 200)
    there = np.array([-0.05, -0.15])
    for share in np.linspace(0, 1, 25):
        arm.drag(2, OBJECTS[2] + share * (there - OBJECTS[2]))
        arm.step()
    moved = np.array([OBJECTS[0], OBJECTS[1], there])
    np.testing.assert_allclose(arm.state.objects, moved)
    performance = si.performed(_path(arm, 450), moved, [loops])
    assert (performance.movement, performance.focus) == (0, 2)
    assert performance.misfit < 0.2


def test_a_shoved_hand_leaves_its_path_and_comes_back(
    arm: LiveArm, policy: si.Policy, loops: list[NDArray[np.float64]]
) -> None:
    arm.obey(Task("session", 0, policy, 2, "text"))
    _path(arm, 250)
    course = np.concatenate(loops) + OBJECTS[2]

    def farthest(steps: int) -> float:
        """How far the hand gets from what was shown."""
        return max(float(np.linalg.norm(course - hand, axis=1).min()) for hand in _path(arm, steps))

    usual = farthest(100)
    arm.shove(np.array([0.7, 0.0]))
    arm.step()
    assert arm.state.shoved
    assert farthest(20) > usual + 0.03
    assert not arm.state.shoved
    _path(arm, 60)
    assert farthest(100) < usual + 0.01


@pytest.mark.parametrize("angle", np.linspace(0, 2 * np.pi, 8, endpoint=False))
def test_a_resting_hand_is_pushed_where_it_is_pushed_and_no_further(arm: LiveArm, angle: float) -> None:
    way = np.array([np.cos(angle), np.sin(angle)])
    arm.step()
    before = arm.state.hand
    arm.shove(100 * way)
    _path(arm, 40)
    moved = arm.state.hand - before
    assert 0.06 < moved @ way < 0.3
    assert abs(moved[0] * way[1] - moved[1] * way[0]) < 0.5 * (moved @ way)


def test_an_object_stays_in_the_workspace_and_one_that_is_not_there_is_not_moved(arm: LiveArm) -> None:
    arm.drag(0, np.array([9.0, -9.0]))
    arm.drag(5, np.zeros(2))
    arm.step()
    np.testing.assert_allclose(arm.state.objects, [[0.42, -0.38], *OBJECTS[1:].tolist()])


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.03, 0.0), (-0.01, 0.05)])
def test_an_object_that_is_dragged_onto_another_comes_to_lie_beside_it(
    arm: LiveArm, offset: tuple[float, float]
) -> None:
    arm.drag(0, OBJECTS[1] + offset)
    arm.step()
    gap = arm.state.objects[0] - OBJECTS[1]
    assert np.hypot(*gap) == pytest.approx(OBJECT_WIDTH)
    assert gap @ offset == pytest.approx(OBJECT_WIDTH * np.hypot(*offset))
    np.testing.assert_array_equal(arm.state.objects[1:], OBJECTS[1:])


def test_objects_never_overlap_whatever_is_dragged_where(arm: LiveArm) -> None:
    rng = np.random.default_rng(0)
    for _ in range(200):
        arm.drag(int(rng.integers(3)), rng.choice([0.05, 0.3, 5.0]) * rng.normal(size=2))
        arm.step()
        first, second, third = arm.state.objects
        gaps = [np.hypot(*gap) for gap in (first - second, first - third, second - third)]
        assert min(gaps) > OBJECT_WIDTH - 1e-6


def test_the_arm_rests_when_told_to_and_by_itself_after_a_while(
    arm: LiveArm, policy: si.Policy, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("signimit_envs.studio.arm.live_arm.ANSWER_SECONDS", 1.0)
    arm.obey(Task("session", 0, policy, 0, "text"))
    _path(arm, 10)
    assert arm.state.task is not None
    arm.rest()
    resting = _path(arm, 20)
    assert arm.state.task is None
    assert np.ptp(resting[10:], axis=0).max() < 1e-4
    arm.obey(Task("session", 1, policy, 0, "text"))
    _path(arm, 50)
    assert arm.state.task is not None
    arm.step()
    assert arm.state.task is None


def test_what_the_arm_did_is_handed_over_second_by_second_and_whole(
    arm: LiveArm, policy: si.Policy, parts: list[TrackPart]
) -> None:
    task = Task("session", 3, policy, 1, "text")
    arm.obey(task)
    path = _path(arm, 120)
    arm.rest()
    arm.step()
    assert [(part.first, len(part.path)) for part in parts] == [(0, 50), (50, 50), (100, 20)]
    assert all(part.task is task for part in parts)
    np.testing.assert_array_equal(np.concatenate([part.path for part in parts]), path)
    assert parts[0].objects.shape == (50, 3, 2)
    assert parts[0].joints.shape == (50, 3)


def test_another_number_of_objects_gets_another_table(arm: LiveArm, policy: si.Policy) -> None:
    arm.obey(Task("session", 0, policy, 2, "text"))
    arm.put("other", np.vstack([OBJECTS, [[-0.2, -0.2], [0.2, 0.2]]]), ORIGIN)
    arm.obey(Task("session", 1, policy, 2, "of a session that has lost the table"))
    arm.step()
    assert (arm.state.session, arm.state.task, len(arm.state.objects)) == ("other", None, 5)


def test_a_policy_that_fails_makes_the_arm_rest_not_die(arm: LiveArm, caplog: pytest.LogCaptureFixture) -> None:
    def broken(hand: NDArray[np.float64]) -> NDArray[np.float64]:
        raise ArithmeticError("no way")

    arm.start()
    arm.obey(Task("session", 0, broken, 0, "text"))  # type: ignore[arg-type]
    _wait_for(lambda: "the arm failed and rests" in caplog.text)
    before = arm.state.time
    _wait_for(lambda: arm.state.time > before)
    assert arm.state.task is None


def test_an_arm_that_fails_again_and_again_is_logged_once(
    arm: LiveArm, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    failures: list[int] = []

    def fail() -> None:
        failures.append(0)
        raise ArithmeticError("no physics")

    monkeypatch.setattr(arm, "step", fail)
    arm.start()
    _wait_for(lambda: len(failures) > 3)
    assert caplog.text.count("the arm failed and rests") == 1


def test_the_trail_is_short_and_the_states_do_not_change(arm: LiveArm, policy: si.Policy) -> None:
    arm.obey(Task("session", 0, policy, 0, "text"))
    arm.step()
    state = arm.state
    seen = state.hand.copy(), state.objects.copy(), len(state.trail)
    _path(arm, 600)
    assert (seen[0] == state.hand).all()
    assert (seen[1] == state.objects).all()
    assert len(state.trail) == seen[2]
    assert len(arm.state.trail) == 200
    assert not is_alike(state, arm.state)
    assert is_alike(state, state)


def _wait_for(condition: object) -> None:
    for _ in range(6000):
        if callable(condition) and condition():
            return
        time.sleep(0.01)
    raise AssertionError("it never happened")


def _starts(held_up: NDArray[np.float64]) -> tuple[NDArray[np.float64], float, RealTimeClock]:
    """Return when steps begin that take so long each, where sleep is exact; and when the last one's wait is over."""
    clock, now, starts = RealTimeClock(PERIOD, 100.0), 100.0, []
    for taken in held_up:
        starts.append(now)
        now += taken
        now += clock.wait(now)
    return np.array(starts), now, clock


def test_steps_are_a_period_apart_when_nothing_holds_them_up() -> None:
    starts, _, clock = _starts(np.full(500, 0.003))
    np.testing.assert_allclose(starts, 100.0 + PERIOD * np.arange(500), atol=1e-9)
    assert clock.lost == 0.0


@pytest.mark.parametrize("delay", [0.03, 0.3, 0.9, 4.0])
def test_a_delay_is_made_up_for_to_the_last_step_and_without_a_jump(delay: float) -> None:
    taken = np.full(600, 0.003)
    taken[10] = delay
    starts, _, clock = _starts(taken)
    gaps = np.diff(starts)
    assert gaps[10] == pytest.approx(delay)
    assert np.delete(gaps, 10).min() >= PERIOD / FASTEST_CATCH_UP - 1e-9
    behind = starts - (100.0 + PERIOD * np.arange(600))
    over = 11 + int(np.ceil(delay / (PERIOD - PERIOD / FASTEST_CATCH_UP))) + 1
    np.testing.assert_allclose(behind[over:], 0.0, atol=1e-9)
    assert clock.lost == 0.0


def test_a_machine_that_slept_goes_on_from_where_it_is_and_says_what_was_lost() -> None:
    taken = np.full(50, 0.003)
    taken[10] = LONGEST_DELAY + 60.0
    starts, _, clock = _starts(taken)
    np.testing.assert_allclose(np.diff(starts)[11:], PERIOD, atol=1e-9)
    assert clock.lost == pytest.approx(LONGEST_DELAY + 60.0 - PERIOD)


def test_random_delays_leave_simulated_time_equal_to_real_time() -> None:
    rng = np.random.default_rng(0)
    taken = np.where(rng.random(5000) < 0.02, rng.uniform(0.0, 0.4, 5000), 0.002)
    taken[-200:] = 0.002
    _, end, clock = _starts(taken)
    assert end - 100.0 == pytest.approx(5000 * PERIOD)
    assert clock.lost == 0.0


def test_steps_that_always_take_longer_than_a_period_are_made_without_a_wait() -> None:
    starts, _, _ = _starts(np.full(100, 1.1 * PERIOD))
    np.testing.assert_allclose(np.diff(starts), 1.1 * PERIOD)
