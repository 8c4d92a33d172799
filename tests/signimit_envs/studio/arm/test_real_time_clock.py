"""Simulated time keeps up with the clock, whatever holds the steps up, and never runs away."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit_envs.studio.arm.real_time_clock import FASTEST, LONGEST_DELAY, Pace

PERIOD = 0.02


def _starts(held_up: NDArray[np.float64]) -> tuple[NDArray[np.float64], float, Pace]:
    """Return when steps begin that take so long each, where sleep is exact; and when the last one's wait is over."""
    pace, now, starts = Pace(PERIOD, 100.0), 100.0, []
    for taken in held_up:
        starts.append(now)
        now += taken
        now += pace.wait(now)
    return np.array(starts), now, pace


def test_steps_are_a_period_apart_when_nothing_holds_them_up() -> None:
    starts, _, pace = _starts(np.full(500, 0.003))
    np.testing.assert_allclose(starts, 100.0 + PERIOD * np.arange(500), atol=1e-9)
    assert pace.lost == 0.0


@pytest.mark.parametrize("delay", [0.03, 0.3, 0.9, 4.0])
def test_a_delay_is_made_up_for_to_the_last_step_and_without_a_jump(delay: float) -> None:
    taken = np.full(600, 0.003)
    taken[10] = delay
    starts, _, pace = _starts(taken)
    gaps = np.diff(starts)
    assert gaps[10] == pytest.approx(delay)
    assert np.delete(gaps, 10).min() >= PERIOD / FASTEST - 1e-9
    behind = starts - (100.0 + PERIOD * np.arange(600))
    over = 11 + int(np.ceil(delay / (PERIOD - PERIOD / FASTEST))) + 1
    np.testing.assert_allclose(behind[over:], 0.0, atol=1e-9)
    assert pace.lost == 0.0


def test_a_machine_that_slept_goes_on_from_where_it_is_and_says_what_was_lost() -> None:
    taken = np.full(50, 0.003)
    taken[10] = LONGEST_DELAY + 60.0
    starts, _, pace = _starts(taken)
    np.testing.assert_allclose(np.diff(starts)[11:], PERIOD, atol=1e-9)
    assert pace.lost == pytest.approx(LONGEST_DELAY + 60.0 - PERIOD)


def test_random_delays_leave_simulated_time_equal_to_real_time() -> None:
    rng = np.random.default_rng(0)
    taken = np.where(rng.random(5000) < 0.02, rng.uniform(0.0, 0.4, 5000), 0.002)
    taken[-200:] = 0.002
    _, end, pace = _starts(taken)
    assert end - 100.0 == pytest.approx(5000 * PERIOD)
    assert pace.lost == 0.0


def test_steps_that_always_take_longer_than_a_period_are_made_without_a_wait() -> None:
    starts, _, _ = _starts(np.full(100, 1.1 * PERIOD))
    np.testing.assert_allclose(np.diff(starts), 1.1 * PERIOD)
