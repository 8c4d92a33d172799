"""Many reproductions at once go where one at a time would go."""

from __future__ import annotations

from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import signimit
from signimit.evaluation import performed
from signimit.learning import learn
from signimit.policies import PlacedPolicy
from signimit.teaching.people.choosing import choose_people
from signimit.teaching.sessions import Session
from signimit_envs import TabletopHandEnv, reproduce
from signimit_envs.arm.batch import HandTracks, reproduce_many
from signimit_envs.arm.batch.physics import ManyArms
from signimit_envs.sessions.session import SessionPlan

SECONDS = 4.0
Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def session() -> Session:
    plan = SessionPlan(method="joint", attempts=1, seconds=SECONDS)
    return plan.compose(choose_people(plan.language, np.random.default_rng(0)))


@pytest.fixture(scope="module")
def policies(session: Session) -> list[PlacedPolicy]:
    model = learn(session.demonstrations, session.prototypes, "joint")
    return [model.respond(command.signs, command.objects).policy for command in session.commands]


@pytest.fixture(scope="module")
def hands(session: Session) -> Array:
    return np.array([command.hand for command in session.commands])


@pytest.fixture(scope="module")
def tracks(policies: list[PlacedPolicy], hands: Array) -> HandTracks:
    return reproduce_many(policies, hands, SECONDS)


def same_bits(one: HandTracks, other: HandTracks) -> bool:
    return all(a.tobytes() == b.tobytes() for a, b in zip(one, other, strict=True))


def test_hands_go_where_mink_takes_them_one_at_a_time_and_the_verdicts_are_the_same(
    session: Session, policies: list[PlacedPolicy], tracks: HandTracks
) -> None:
    env = TabletopHandEnv()
    for number in range(0, len(policies), 2):
        command, policy = session.commands[number], policies[number]
        joints: list[Array] = []
        one = reproduce(
            env,
            policy,
            command.objects,
            command.hand,
            SECONDS,
            each_step=lambda: joints.append(env.data.qpos.copy()),  # noqa: B023
        )
        path, templates = tracks.paths[number], session.truth.templates
        assert np.hypot(*(path - one.path).T).max() <= 0.5e-3
        np.testing.assert_allclose(tracks.commanded[number], one.commanded, atol=0.5e-3)
        np.testing.assert_allclose(tracks.joints[number], joints, atol=1e-3)
        verdicts = [performed(p, command.objects, templates)[:2] for p in (path, one.path)]
        assert verdicts[0] == verdicts[1] == command.request
    env.close()


def test_the_tracks_have_a_row_a_reproduction_and_a_point_a_control_step(tracks: HandTracks, hands: Array) -> None:
    count, steps = len(hands), round(SECONDS * 50)
    assert tracks.paths.shape == (count, steps + 1, 2)
    assert tracks.commanded.shape == (count, steps, 2)
    assert tracks.joints.shape == (count, steps + 1, 3)
    np.testing.assert_array_equal(tracks.steps, steps)
    np.testing.assert_allclose(tracks.paths[:, 0], hands, atol=1e-6)


def test_the_same_call_gives_the_same_bits_on_any_number_of_threads(
    policies: list[PlacedPolicy], hands: Array, tracks: HandTracks
) -> None:
    for threads in (1, 3):
        assert same_bits(reproduce_many(policies, hands, SECONDS, threads), tracks)


@pytest.mark.parametrize("numbers", [[4], [8, 0], [6, 5, 4, 3, 2, 1, 0], [2, 2, 2, 7]])
def test_a_reproduction_does_not_depend_on_the_others(
    policies: list[PlacedPolicy], hands: Array, tracks: HandTracks, numbers: list[int]
) -> None:
    some = reproduce_many([policies[n] for n in numbers], hands[numbers], SECONDS)
    assert same_bits(some, HandTracks(*(array[numbers] for array in tracks)))  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["knn", "gmr", "dmp", "ilo-gmr"])
def test_other_kinds_of_policy_draw_the_same_as_one_at_a_time(kind: str) -> None:
    times = np.arange(0.0, 3.0, 0.02)
    loops = [0.08 * np.column_stack([np.cos(4 * times + a), np.sin(4 * times + a)]) for a in (0.0, 1.0, 2.0)]
    policy = signimit.make_policy(loops, [times] * 3, kind=kind)
    starts, env = np.array([[0.1, -0.05], [-0.2, 0.1]]), TabletopHandEnv()
    paths = reproduce_many([policy, policy], starts, 1.0).paths
    for path, start in zip(paths, starts, strict=True):
        one = reproduce(env, policy, [[0.0, 0.0], [0.3, 0.3], [-0.3, 0.3]], start, 1.0).path
        assert np.hypot(*(path - one).T).max() <= 0.5e-3
    env.close()


def test_too_fast_a_command_keeps_its_direction_as_in_the_environment() -> None:
    def fast(hand: Array) -> Array:
        return np.broadcast_to([3.0, 1.5], hand.shape)

    env = TabletopHandEnv()
    one = reproduce(env, lambda hand: [3.0, 1.5], [[0.0, 0.0], [0.3, 0.3], [-0.3, 0.3]], [-0.3, 0.0], 1.0)
    many = reproduce_many([fast], [[-0.3, 0.0]], 1.0)
    assert np.hypot(*(many.paths[0] - one.path).T).max() <= 0.5e-3
    np.testing.assert_allclose(many.commanded[0, 0], one.commanded[0], atol=1e-6)
    env.close()


def test_no_time_leaves_the_hands_where_they_were_put() -> None:
    tracks = reproduce_many([lambda hand: hand], [[0.1, 0.2]], 0.0)
    np.testing.assert_allclose(tracks.paths, [[[0.1, 0.2]]], atol=1e-6)
    assert tracks.commanded.shape == (1, 0, 2)


def test_a_reproduction_whose_physics_fails_ends_there_and_the_others_go_on(
    policies: list[PlacedPolicy], hands: Array, tracks: HandTracks, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)  # where MuJoCo would write its log
    whole, calls = ManyArms.simulate, count()

    def failing(arms: ManyArms, velocities: Array) -> Any:
        if next(calls) == 20:
            arms._qvel[:, 3] = np.nan
        return whole(arms, velocities)

    monkeypatch.setattr(ManyArms, "simulate", failing)
    broken = reproduce_many(policies, hands, SECONDS)
    others = np.arange(len(hands)) != 3
    assert broken.steps.tolist() == [200, 200, 200, 20, 200, 200, 200, 200, 200]
    np.testing.assert_array_equal(broken.paths[others], tracks.paths[others])
    np.testing.assert_array_equal(broken.paths[3, :21], tracks.paths[3, :21])
    np.testing.assert_array_equal(broken.paths[3, 21:], np.tile(tracks.paths[3, 20], (180, 1)))
    assert not list(tmp_path.iterdir())


def resting(hand: Array) -> Array:
    return np.zeros_like(hand)


@pytest.mark.parametrize(
    ("policies", "hands", "seconds", "message"),
    [
        ([], [], 1.0, "policies: expected at least one, found none"),
        (resting, [[0, 0]], 1.0, "policies: expected a list, found function"),
        ([resting, 3], [[0, 0]] * 2, 1.0, "policies: reproduction 1: expected a policy, found int"),
        ([resting], [[0, 0]] * 2, 1.0, r"hands: expected numbers of shape \(1, 2\), found shape \(2, 2\)"),
        ([resting], [[np.nan, 0]], 1.0, "hands: expected finite numbers"),
        ([resting] * 2, [[0, 0], [0.5, 0]], 1.0, r"hands: reproduction 1: expected positions with .* \(0.5, 0\)"),
        ([resting], [[0, 0]], -1.0, "seconds: expected 0 to 3600, found -1.0"),
        ([resting], [[0, 0]], float("nan"), "seconds: expected 0 to 3600, found nan"),
        ([lambda hand: [1.0, 0.0]], [[0, 0]], 1.0, r"policy of reproduction 0: expected velocities of shape \(2, 2\)"),
        ([resting, lambda hand: hand * np.nan], [[0, 0]] * 2, 1.0, "policy of reproduction 1: expected finite"),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_sentence(
    policies: Any, hands: Any, seconds: float, message: str
) -> None:
    with pytest.raises(signimit.InvalidInputError, match=message):
        reproduce_many(policies, hands, seconds)


def test_a_negative_number_of_threads_is_refused() -> None:
    with pytest.raises(signimit.InvalidInputError, match="threads: expected 0 or more, found -1"):
        reproduce_many([resting], [[0.0, 0.0]], 1.0, threads=-1)
