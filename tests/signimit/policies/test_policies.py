"""The contract that every kind of policy keeps."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import policies as policies_module
from signimit.exceptions import FileFormatError, InvalidInputError, UnknownNameError
from signimit.io.archive import write_archive
from signimit.policies import DEFAULT_POLICY, POLICY_KINDS, Policy, StatefulPolicy, load_policy, make_policy

Shown = Any
Compose = Callable[..., Shown]
WHERE = "on the table"
ALL = [*POLICY_KINDS, *(f"{kind} {WHERE}" for kind in POLICY_KINDS)]
HANDS = np.random.default_rng(1).uniform(-0.5, 0.5, (40, 2))


def drive(policy: Policy, hands: NDArray[np.float64], steps: int) -> NDArray[np.float64]:
    """Move hands as the checks do, shape (steps + 1, B, 2)."""
    path, state = [hands], policy.start()
    for _ in range(steps):
        state, velocity = policy.step(state, path[-1])
        path.append(path[-1] + 0.02 * velocity)
    return np.array(path)


def learned(shown: Shown, kind: str = DEFAULT_POLICY) -> Policy:
    return make_policy(shown.paths, shown.times, kind)


@pytest.fixture(scope="module")
def policies(shown: Compose) -> dict[str, Policy]:
    made = {kind: learned(shown("triangle up"), kind) for kind in POLICY_KINDS}
    return made | {f"{kind} {WHERE}": policy.at([0.1, -0.2]) for kind, policy in made.items()}


def test_the_default_is_one_of_the_kinds_and_keeps_a_state(shown: Compose) -> None:
    policy = make_policy(*shown("circle")[:2])
    assert policy.kind == DEFAULT_POLICY == "path-following"
    assert policy.start() is not None


def test_the_name_of_policies_with_a_state_still_is_one_of_all_that_have_start_and_step() -> None:
    assert StatefulPolicy is Policy


@pytest.mark.parametrize("kind", ALL)
def test_shape_out_is_shape_in(kind: str, policies: dict[str, Policy]) -> None:
    policy = policies[kind]
    assert policy([0.1, 0.0]).shape == (2,)
    assert policy(HANDS).shape == HANDS.shape
    assert policy(np.zeros((0, 2))).shape == (0, 2)


@pytest.mark.parametrize("kind", ALL)
def test_many_hands_move_as_each_alone(kind: str, policies: dict[str, Policy]) -> None:
    together = policies[kind](HANDS)
    np.testing.assert_allclose(together, [policies[kind](hand) for hand in HANDS], atol=1e-9)


@pytest.mark.parametrize("kind", ALL)
def test_many_hands_step_as_each_alone(kind: str, policies: dict[str, Policy]) -> None:
    together = drive(policies[kind], HANDS[:3], 60)
    alone = np.stack([drive(policies[kind], hand, 60) for hand in HANDS[:3]], axis=1)
    np.testing.assert_allclose(together, alone, atol=1e-9)


@pytest.mark.parametrize("kind", ALL)
def test_velocities_are_finite_from_everywhere(kind: str, policies: dict[str, Policy]) -> None:
    rng = np.random.default_rng(0)
    hands = np.concatenate([rng.uniform(-s, s, (12, 2)) for s in (1e-9, 0.1, 1.0, 900.0)])
    assert np.isfinite(policies[kind](hands)).all()
    assert np.isfinite(drive(policies[kind], hands, 40)).all()


@pytest.mark.parametrize("kind", ALL)
def test_the_plain_call_is_made_without_a_state(kind: str, policies: dict[str, Policy]) -> None:
    policy = policies[kind]
    before = policy(HANDS)
    drive(policy, HANDS, 5)
    np.testing.assert_array_equal(policy(HANDS), before)
    if policy.start() is None:
        np.testing.assert_array_equal(policy.step(None, HANDS)[1], before)


@pytest.mark.parametrize("kind", ALL)
def test_a_step_taken_twice_is_the_same_and_writes_to_nothing(kind: str, policies: dict[str, Policy]) -> None:
    policy, hands = policies[kind], HANDS.copy()
    hands.setflags(write=False)
    state, _ = policy.step(policy.start(), hands)
    first, second = policy.step(state, hands), policy.step(state, hands)
    np.testing.assert_array_equal(first[1], second[1])
    np.testing.assert_array_equal(policy.step(first[0], hands)[1], policy.step(second[0], hands)[1])


@pytest.mark.parametrize("kind", ALL)
def test_a_pickled_policy_is_the_same_policy(kind: str, policies: dict[str, Policy]) -> None:
    again = pickle.loads(pickle.dumps(policies[kind]))
    np.testing.assert_array_equal(again(HANDS), policies[kind](HANDS))
    np.testing.assert_array_equal(drive(again, HANDS, 20), drive(policies[kind], HANDS, 20))
    arrays = [value for value in vars(again).values() if isinstance(value, np.ndarray)]
    assert not any(array.flags.writeable for array in arrays if array.dtype == np.float64)


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_a_saved_policy_is_the_same_policy(kind: str, policies: dict[str, Policy], tmp_path: Path) -> None:
    policies[kind].save(tmp_path / "policy.npz")
    again = load_policy(tmp_path / "policy.npz")
    assert again.kind == kind
    np.testing.assert_array_equal(again(HANDS), policies[kind](HANDS))
    np.testing.assert_array_equal(drive(again, HANDS, 20), drive(policies[kind], HANDS, 20))


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_a_policy_is_printed_in_a_line(kind: str, policies: dict[str, Policy]) -> None:
    assert len(repr(policies[kind])) < 100
    assert type(policies[kind]).__name__ in repr(policies[kind])


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_the_same_demonstrations_give_the_same_policy(kind: str, policies: dict[str, Policy], shown: Compose) -> None:
    paths, times, _ = shown("triangle up")
    for array in (*paths, *times):
        array.setflags(write=False)
    np.testing.assert_array_equal(make_policy(paths, times, kind)(HANDS), policies[kind](HANDS))


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_a_policy_shares_no_memory_with_its_demonstrations_or_its_answers(kind: str, shown: Compose) -> None:
    paths, times, _ = shown("circle", 2)
    policy = make_policy(paths, times, kind)
    before = policy(HANDS)
    for path in paths:
        path += 1.0
    answer = policy(HANDS)
    np.testing.assert_array_equal(answer, before)
    answer += 1.0
    np.testing.assert_array_equal(policy(HANDS), before)


@pytest.mark.parametrize("kind", ALL)
def test_a_policy_cannot_be_changed(kind: str, policies: dict[str, Policy]) -> None:
    name = next(iter(vars(policies[kind])))
    with pytest.raises(AttributeError):
        setattr(policies[kind], name, 0.0)


@pytest.mark.parametrize("kind", POLICY_KINDS)
@pytest.mark.parametrize("count", [1, 2, 20])
def test_any_number_of_demonstrations_will_do(kind: str, count: int, shown: Compose) -> None:
    policy = learned(shown("circle", count), kind)
    assert np.isfinite(drive(policy, HANDS, 50)).all()


@pytest.mark.parametrize("kind", POLICY_KINDS)
def test_short_slow_and_resting_demonstrations_will_do(kind: str) -> None:
    two_points = make_policy([[[0.0, 0.0], [0.1, 0.0]]], [[0.0, 1.0]], kind)
    rests = np.repeat([[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]], 20, axis=0)
    resting = make_policy([rests] * 2, [0.02 * np.arange(60)] * 2, kind)
    for policy in (two_points, resting):
        assert np.isfinite(drive(policy, HANDS, 30)).all()


@pytest.mark.parametrize("kind", ALL)
@pytest.mark.parametrize(
    "hand", [[0.0], [0.0, np.nan], [np.inf, 0.0], [[0.0, 0.0, 0.0]], np.zeros((2, 2, 2)), [1e9, 0.0]]
)
def test_a_bad_hand_is_refused(kind: str, hand: Any, policies: dict[str, Policy]) -> None:
    with pytest.raises(InvalidInputError, match="hand"):
        policies[kind](hand)


@pytest.mark.parametrize("kind", ["path-following", "dmp"])
def test_a_state_belongs_to_hands_of_its_shape(kind: str, policies: dict[str, Policy]) -> None:
    policy = policies[kind]
    state, _ = policy.step(policy.start(), HANDS[:3])
    with pytest.raises(InvalidInputError, match="state"):
        policy.step(state, HANDS[:4])
    with pytest.raises(InvalidInputError, match="state"):
        policy.step(state, HANDS[0])


def test_an_unknown_kind_is_refused_with_the_known_ones(shown: Compose) -> None:
    with pytest.raises(UnknownNameError, match="path-following"):
        learned(shown("circle", 1), "magic")


@pytest.mark.parametrize(
    ("paths", "times", "message"),
    [
        ([], [], "at least one path"),
        ([np.zeros((3, 2))], [np.arange(3.0)], "demonstration 0: stroke points: expected points that move"),
        ([np.eye(2)], [np.arange(2.0), np.arange(2.0)], "as many times as paths"),
        (
            [np.eye(2), np.eye(2) * np.nan],
            [np.arange(2.0)] * 2,
            "demonstration 1: stroke points: expected finite",
        ),
        ([np.eye(2)], [np.zeros(2)], "demonstration 0: stroke times: expected strictly increasing"),
        ([np.eye(2) * 1e9], [np.arange(2.0)], "demonstration 0: stroke points: expected numbers within 1000"),
    ],
)
def test_bad_demonstrations_are_refused_by_number(paths: Any, times: Any, message: str) -> None:
    with pytest.raises(InvalidInputError, match=message):
        make_policy(paths, times)


def test_foreign_and_damaged_files_are_refused(tmp_path: Path, policies: dict[str, Policy]) -> None:
    write_archive(tmp_path / "kind.npz", "policy", 1, {}, {"policy": "magic"})
    write_archive(tmp_path / "empty.npz", "policy", 1, {}, {"policy": "knn"})
    shapes = {"points": np.zeros((3, 2)), "directions": np.zeros((2, 2)), "speed": np.array(1.0)}
    write_archive(tmp_path / "shapes.npz", "policy", 1, shapes, {"policy": "knn"})
    for name in ("kind.npz", "empty.npz", "shapes.npz"):
        with pytest.raises(FileFormatError, match=name):
            load_policy(tmp_path / name)


def test_non_finite_arrays_in_a_file_are_refused(tmp_path: Path) -> None:
    arrays = {"data": np.full((5, 4), np.nan), "limit": np.array(1.0)}
    write_archive(tmp_path / "nan.npz", "policy", 1, arrays, {"policy": "ilo-gmr"})
    with pytest.raises(FileFormatError, match="finite"):
        load_policy(tmp_path / "nan.npz")
    arrays = {"data": np.zeros((5, 4)), "limit": np.array(np.inf)}
    write_archive(tmp_path / "inf.npz", "policy", 1, arrays, {"policy": "ilo-gmr"})
    with pytest.raises(FileFormatError, match="limit: expected finite"):
        load_policy(tmp_path / "inf.npz")


OPTIONS = [
    ("path-following", "pull", 10.0, 15.0),
    ("path-following", "near", 0.2, 0.096),
    ("knn", "neighbours", 20, 50),
    ("ilo-gmr", "neighbours", 20, 50),
    ("gmr", "components", (2, 3), (1, 2, 3, 4, 6, 8, 10, 12, 16)),
    ("dmp", "frequency", 6.0, 10.0),
]


@pytest.mark.parametrize(("kind", "name", "value", "default"), OPTIONS)
def test_an_option_counts_and_outlives_a_file(
    kind: str, name: str, value: Any, default: Any, policies: dict[str, Policy], shown: Compose, tmp_path: Path
) -> None:
    paths, times, _ = shown("triangle up")
    as_ever, other = (make_policy(paths, times, kind, **{name: v}) for v in (default, value))
    hands = HANDS / 2
    np.testing.assert_array_equal(drive(as_ever, hands, 20), drive(policies[kind], hands, 20))
    assert not np.allclose(drive(other, hands, 20), drive(policies[kind], hands, 20))
    other.save(tmp_path / "policy.npz")
    again = load_policy(tmp_path / "policy.npz")
    np.testing.assert_array_equal(drive(again, hands, 20), drive(other, hands, 20))
    assert repr(again) == repr(other)


def test_the_table_of_kinds_names_their_options() -> None:
    rows = [line for line in (policies_module.__doc__ or "").splitlines() if line.split(" ")[0] in POLICY_KINDS]
    for kind, row in zip(POLICY_KINDS, rows, strict=True):
        assert row.endswith(" " + ", ".join(name for k, name, *_ in OPTIONS if k == kind))


def test_an_unknown_option_is_refused_with_the_known_ones(shown: Compose) -> None:
    paths, times, _ = shown("circle", 1)
    with pytest.raises(UnknownNameError, match="Unknown option of policy kind 'knn' 'neighbors'; known are neighbours"):
        make_policy(paths, times, "knn", neighbors=20)


@pytest.mark.parametrize(
    ("kind", "options", "message"),
    [
        ("knn", {"neighbours": 0}, "policy: neighbours: expected a whole number, 1 or more, found 0"),
        ("ilo-gmr", {"neighbours": 2.5}, "policy: neighbours: expected a whole number, 1 or more, found 2.5"),
        ("gmr", {"components": (0, 10_000)}, "components: expected a number from 1 to .*, a tenth of the points"),
        ("gmr", {"components": "many"}, "components: expected numbers"),
        ("dmp", {"frequency": 50.0}, "frequency: expected between 0 and 50 rad/s"),
        ("dmp", {"frequency": np.nan}, "frequency: expected"),
        ("path-following", {"pull": -1.0}, "pull, near: expected above 0"),
        ("path-following", {"pull": "strong"}, r"policy: pull: expected numbers of shape \(\)"),
        ("path-following", {"near": [0.1, 0.2]}, r"policy: near: expected numbers of shape \(\)"),
        ("path-following", {"near": 0.4}, "pull, near: expected above 0, .* near below 0.32 half sizes"),
    ],
)
def test_an_option_without_sense_is_refused(kind: str, options: Any, message: str, shown: Compose) -> None:
    paths, times, _ = shown("circle", 1)
    with pytest.raises(InvalidInputError, match=message):
        make_policy(paths, times, kind, **options)
