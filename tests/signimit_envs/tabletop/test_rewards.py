"""Shaping tells nothing about what to prefer in the end: over an episode it adds up to its two ends."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit.evaluation import make_template
from signimit_envs import TabletopHandEnv
from signimit_envs.tabletop.rewards import DenseReward, Potential, SparseReward

TURN = np.linspace(0, 2 * np.pi, 101)
CIRCLE = 0.1 * np.column_stack([np.cos(TURN), np.sin(TURN)])
DRAWING, PLACE = make_template(CIRCLE), np.array([0.1, -0.05])


def potentials(path: NDArray[np.float64]) -> NDArray[np.float64]:
    potential = Potential()
    return np.array([potential.start(DRAWING, PLACE, path[0]), *(potential.move(hand) for hand in path[1:])])


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 60), st.floats(0, 1), st.integers(0, 60), st.booleans())
def test_shaping_telescopes(seed: int, steps: int, discount: float, success: int, blown_up: bool) -> None:
    rng = np.random.default_rng(seed)
    path = PLACE + np.cumsum(rng.normal(0, 0.03, (steps + 1, 2)), axis=0)
    dense, sparse = DenseReward(discount), SparseReward(discount)
    total = 0.0
    for reward, sign in ((dense, 1.0), (sparse, -1.0)):
        reward.start(DRAWING, PLACE, path[0])
        for t in range(steps):
            over = blown_up and t == steps - 1
            total += sign * discount**t * reward.of_step(path[t + 1], t == success, over)
    ends = potentials(path)
    last = 0.0 if blown_up else ends[-1]
    assert total == pytest.approx(discount**steps * last - ends[0], abs=1e-12)
    assert ((ends >= 0) & (ends <= 1)).all()


def test_the_potential_grows_to_one_along_the_drawing_and_stays_behind_against_it() -> None:
    along = potentials(PLACE + np.tile(CIRCLE[:-1], (2, 1)))
    assert (np.diff(along[:100:10]) > 0).all()
    assert along[-1] > 0.99
    assert along[50] == pytest.approx(0.25 + 0.75 * 0.5, abs=0.1)
    against = potentials(PLACE + CIRCLE[::-1])
    assert against.max() <= 0.26


def test_a_nearer_hand_has_more_potential_and_only_the_requested_object_counts() -> None:
    path = PLACE + np.linspace([0.5, 0.0], [0.1, 0.0], 20)
    assert (np.diff(potentials(path)) > 0).all()
    shifted = potentials(path + np.array([0.0, 0.3]))
    assert (shifted < potentials(path)).all()


def test_a_resting_hand_passes_nothing() -> None:
    still = potentials(np.tile(PLACE + CIRCLE[0], (30, 1)))
    np.testing.assert_allclose(still, still[0])
    assert still[0] <= 0.25


def test_potentials_do_not_depend_on_where_the_table_is() -> None:
    path = PLACE + np.cumsum(np.random.default_rng(0).normal(0, 0.02, (80, 2)), axis=0)
    shift = np.array([0.3, -0.2])
    potential = Potential()
    moved = [potential.start(DRAWING, PLACE + shift, path[0] + shift), *(potential.move(p + shift) for p in path[1:])]
    np.testing.assert_allclose(moved, potentials(path), atol=1e-9)


def run(reward: str, options: dict[str, Any], targets: NDArray[np.float64]) -> list[float]:
    env = TabletopHandEnv(reward=reward)
    observation, _ = env.reset(seed=0, options=options)
    rewards = []
    for target in targets:
        observation, value, *_ = env.step((target - observation["hand"]) * 50 / env.max_hand_speed)
        rewards.append(value)
    return rewards


def test_on_the_physics_the_dense_reward_is_the_sparse_one_plus_what_telescopes() -> None:
    shown = TabletopHandEnv().people.templates[2][0]
    objects = np.array([[-0.15, 0.1], [0.02, -0.1], [0.18, 0.08]])
    course = np.tile(shown, (4, 1))[:300] + objects[0]
    options = {"movement": 2, "focus": 0, "objects": objects, "hand": course[0]}
    sparse, dense = run("sparse", options, course), run("dense", options, course)
    assert sum(sparse) == 1.0
    gain = 0.99 ** np.arange(len(sparse)) @ (np.array(dense) - sparse)
    assert -1.0 <= gain <= 1.0
    assert max(np.abs(np.array(dense) - sparse)) < 0.1


def test_both_rewards_of_an_environment_see_the_same_episode() -> None:
    one, other = TabletopHandEnv(reward="sparse"), TabletopHandEnv(reward="dense", discount=1.0)
    for env in (one, other):
        env.reset(seed=3)
    rng = np.random.default_rng(0)
    for _ in range(20):
        action = rng.uniform(-1, 1, 2)
        first, second = one.step(action), other.step(action)
        np.testing.assert_array_equal(first[0]["hand"], second[0]["hand"])
        assert first[1] == 0.0
        assert second[1] != 0.0
