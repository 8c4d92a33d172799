"""A movement made once is drawn whole, then the hand rests; one that repeats goes on; demonstrations tell which."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.policies import DMPPolicy, PathFollowingPolicy, Policy, make_policy, run_policy

Array = NDArray[np.float64]
PERIOD = 0.02
BEGINNING = np.array([0.0, 0.1])
HANDS = np.array([[0.3, 0.2], [-0.3, 0.1], [0.0, -0.1], [0.1, 0.0], [0.02, 0.03], [0.0, -0.3]])


def reach(a: Array, b: Array) -> Array:
    """A straight minimum-jerk way from a to short of b at about 0.35 m/s."""
    s = np.linspace(0, 1, max(8, int(np.hypot(*(b - a)) / 0.35 / PERIOD)), endpoint=False)[:, None]
    way: Array = a + (b - a) * (10 * s**3 - 15 * s**4 + 6 * s**5)
    return way


def circle(rounds: float, rng: np.random.Generator) -> Array:
    """A circle from its top, clockwise, two seconds a round."""
    angles = 2 * np.pi * np.arange(round(100 * rounds) + 1) / 100
    wobble = 1 + 0.03 * np.sin(2 * angles + rng.uniform(0, 6))
    drawn: Array = 0.1 * rng.normal(1, 0.03) * wobble[:, None] * np.column_stack([np.sin(angles), np.cos(angles)])
    return drawn


def demonstrate(*rounds: float, home: bool = False, seed: int = 0) -> tuple[list[Array], list[Array]]:
    rng = np.random.default_rng(seed)
    paths: list[Array] = []
    times: list[Array] = []
    for count in rounds:
        start, drawn = rng.uniform(-0.35, 0.35, 2), circle(count, rng)
        back = [reach(drawn[-1], start)] if home else []
        paths.append(np.concatenate([reach(start, drawn[0]), drawn, *back]))
        times.append(np.arange(len(paths[-1]), dtype=np.float64) * PERIOD)
    return paths, times


def turned(path: Array) -> float:
    """Rounds, clockwise, from when a path first comes to the circle's top."""
    first = int(np.argmax(np.hypot(*(path - BEGINNING).T) < 0.025))
    angles = np.unwrap(np.arctan2(path[first:, 0], path[first:, 1]))
    return float(angles[-1] - angles[0]) / (2 * np.pi)


def check_drawn_once(policy: Policy) -> None:
    path = run_policy(policy, HANDS, 10.0)
    for one in np.moveaxis(path, 1, 0):
        assert turned(one) == pytest.approx(1.0, abs=0.08)
        assert np.hypot(*np.diff(one[-100:], axis=0).T).sum() < 0.005


@pytest.mark.parametrize("kind", ["path-following", "dmp"])
@pytest.mark.parametrize("home", [False, True])
def test_what_is_shown_once_is_drawn_once_from_its_beginning_wherever_the_hand_starts(kind: str, home: bool) -> None:
    check_drawn_once(make_policy(*demonstrate(1.0, 1.02, 0.98, 1.05, home=home), kind=kind))


def test_the_way_home_belongs_to_no_movement() -> None:
    for rounds in (1.0, 2.0):
        policy = make_policy(*demonstrate(*[rounds] * 4, home=True))
        assert isinstance(policy, PathFollowingPolicy)
        assert np.abs(np.hypot(*policy.course.T) - 0.1).max() < 0.02


@pytest.mark.parametrize(
    ("rounds", "repeats"),
    [((1.1, 1.1, 1.1, 1.1), False), ((1.25, 1.25, 1.25, 1.25), True), ((1.3, 1.0, 2.0, 1.6), True)],
)
def test_a_movement_repeats_if_most_demonstrations_come_round_again(rounds: tuple[float, ...], repeats: bool) -> None:
    policy = make_policy(*demonstrate(*rounds))
    assert isinstance(policy, PathFollowingPolicy)
    assert bool(policy.closed) == repeats
    assert bool(policy.whole) != repeats


@pytest.mark.parametrize("kind", ["path-following", "dmp"])
def test_a_user_who_says_so_is_obeyed(kind: str) -> None:
    once, twice = demonstrate(1.0, 1.0, 1.0), demonstrate(2.0, 2.0, 2.0)
    again = run_policy(make_policy(*once, kind=kind, repeat=True), HANDS, 10.0)
    assert all(turned(path) > 3 for path in np.moveaxis(again, 1, 0))
    whole = run_policy(make_policy(*twice, kind=kind, repeat=False), HANDS, 12.0)
    for path in np.moveaxis(whole, 1, 0):
        assert turned(path) == pytest.approx(2.0, abs=0.1)
        assert np.hypot(*np.diff(path[-100:], axis=0).T).sum() < 0.005


def test_an_open_stroke_can_be_repeated_on_request() -> None:
    rng = np.random.default_rng(0)
    stroke = 0.1 * np.column_stack([np.linspace(-1, 1, 80), np.abs(np.linspace(-1, 1, 80))])
    paths = [np.concatenate([reach(rng.uniform(-0.3, 0.3, 2), stroke[0]), stroke]) for _ in range(3)]
    times = [PERIOD * np.arange(len(path)) for path in paths]
    assert np.ptp(run_policy(make_policy(paths, times), [0.2, 0.2], 10.0)[-200:], axis=0).max() < 0.01
    again = run_policy(make_policy(paths, times, repeat=True), [0.2, 0.2], 10.0)[-200:]
    assert cdist(stroke, again).min(axis=1).max() < 0.02


def test_a_hand_that_is_shoved_goes_on_where_it_was() -> None:
    policy = make_policy(*demonstrate(1.0, 1.0, 1.0, 1.0))
    state, hand, path = policy.start(), np.array([0.2, 0.2]), []
    for step in range(500):
        state, velocity = policy.step(state, hand)
        hand = hand + PERIOD * velocity
        if step == 90:  # to the other side of the circle
            before, hand = hand, -hand
        path.append(hand)
    drawn = np.array(path)
    assert np.hypot(*(drawn[91:] - before).T).min() < 0.02
    assert (
        cdist(0.1 * np.column_stack([np.sin(t := np.linspace(0, 6.28, 60)), np.cos(t)]), drawn).min(axis=1).max() < 0.02
    )
    np.testing.assert_allclose(drawn[-1], BEGINNING, atol=0.015)


def test_strangers_who_begin_at_different_places_are_not_averaged() -> None:
    """The mean of circles begun at the top, right, bottom and left is no circle; one of them is drawn."""
    rng = np.random.default_rng(0)
    turns = [np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) for a in np.pi / 2 * np.arange(4)]
    drawings = [circle(1.0, rng) @ turn for turn in turns]
    paths = [np.concatenate([reach(rng.uniform(-0.3, 0.3, 2), drawn[0]), drawn]) for drawn in drawings]
    policy = make_policy(paths, [PERIOD * np.arange(len(path)) for path in paths])
    assert isinstance(policy, PathFollowingPolicy)
    assert (
        min(max(cdist(policy.course, d).min(axis=1).max(), cdist(d, policy.course).min(axis=1).max()) for d in drawings)
        < 0.012
    )
    assert min(np.hypot(*(policy.course[0] - d[0])) for d in drawings) < 0.01


def test_kinds_without_a_course_cannot_be_told() -> None:
    shown = demonstrate(1.0, 1.0)
    for kind in ("knn", "gmr", "ilo-gmr"):
        with pytest.raises(UnknownNameError, match="repeat"):
            make_policy(*shown, kind=kind, repeat=True)


def test_repeat_is_yes_no_or_by_evidence() -> None:
    answer: Any = "yes"
    with pytest.raises(InvalidInputError, match=r"repeat.*True, False or None.*'yes'"):
        make_policy(*demonstrate(1.0, 1.0), repeat=answer)


def test_a_primitive_of_an_old_file_starts_where_the_hand_is() -> None:
    policy = make_policy(*demonstrate(1.0, 1.0), kind="dmp")
    assert isinstance(policy, DMPPolicy)
    stored = policy._stored_arrays()
    del stored["whole"]
    old = DMPPolicy.from_arrays(stored, "old.npz")
    state, _ = old.step(old.start(), [0.3, 0.3])
    assert bool(state.drawing)


@pytest.mark.parametrize("speed", [0.1, 0.4, 1.0])
def test_a_movement_that_begins_fast_is_begun_from_everywhere(speed: float) -> None:
    """A hand that is to draw a line is not pushed past its beginning, where it would hang between push and pull."""
    line = np.column_stack([np.arange(0.0, 0.2, PERIOD * speed), np.zeros(len(np.arange(0.0, 0.2, PERIOD * speed)))])
    policy = PathFollowingPolicy(line, closed=0.0, half_size=0.1, reach_speed=0.35, whole=1.0)
    paths = run_policy(policy, np.concatenate([HANDS, [[0.2, 0.0], [0.05, 0.0], [0.1, 0.01]]]), 8.0)
    np.testing.assert_allclose(paths[-1], np.tile(line[-1], (len(HANDS) + 3, 1)), atol=0.001)
    assert np.hypot(*np.moveaxis(paths - line[0], -1, 0)).min(axis=0).max() < 0.01
