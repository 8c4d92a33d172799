"""Policy files: what a file says is checked as what a caller says, so that every policy that loads can be called."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.policies import POLICY_KINDS, KNearestPolicy, Policy, load_policy, make_policy

Change = Callable[[dict[str, Any]], dict[str, Any]]
HANDS = np.random.default_rng(1).uniform(-0.5, 0.5, (5, 2))


@pytest.fixture(scope="module")
def learned(shown: Callable[..., Any]) -> dict[str, Policy]:
    circle = shown("circle")
    return {kind: make_policy(circle.paths, circle.times, kind) for kind in POLICY_KINDS}


def changed(path: Path, policy: Policy, version: int = 2, **values: Any) -> Path:
    """Write a policy's file with other values for some of its arrays."""
    policy.save(path)
    arrays, meta = read_archive(path, "policy", 2)
    write_archive(path, "policy", version, {**arrays, **{name: np.asarray(v) for name, v in values.items()}}, meta)
    return path


LIES: list[tuple[str, dict[str, Any], str]] = [
    ("knn", {"speed": "0.230"}, "speed: expected numbers of shape (), found <U5 values"),
    ("knn", {"speed": np.inf}, "speed: expected finite numbers, found inf"),
    ("knn", {"speed": -0.1}, "speed: expected 0 or more, found -0.1"),
    ("knn", {"speed": 1e200}, "speed: expected numbers within 1e+13"),
    ("knn", {"points": np.full((9, 2), 1e298), "directions": np.ones((9, 2))}, "points: expected"),
    ("knn", {"points": np.full((9, 2), 1001.0), "directions": np.ones((9, 2))}, "points: expected numbers within 1000"),
    ("knn", {"points": np.ones((9, 2)), "directions": np.full((9, 2), 7.0)}, "directions: expected numbers within 1"),
    ("knn", {"points": np.ones((9, 2)), "directions": np.ones((8, 2))}, "directions: expected numbers of shape (9, 2)"),
    ("knn", {"points": np.ones((9, 2), "c16")}, "points: expected numbers of shape (n, n), found complex128 values"),
    ("knn", {"neighbours": 0.5}, "neighbours: expected a whole number"),
    ("path-following", {"half_size": 1e-300}, "half_size: expected at least 1e-12 m"),
    ("path-following", {"closed": 0.5}, "closed: expected 0 or 1, found 0.5"),
    ("path-following", {"reach_speed": 0.0}, "reach_speed: expected a speed above 0"),
    ("path-following", {"course": np.ones((1, 2))}, "course: expected at least 2 nodes"),
    ("path-following", {"near": 1e-200}, "near"),
    ("dmp", {"frequency": "9"}, "frequency: expected numbers"),
    ("dmp", {"weights": np.full((40, 2), 1e90)}, "weights: expected numbers within 1e+13"),
    ("dmp", {"course": np.full((7, 2), 1e9)}, "course: expected numbers within 1000"),
    ("gmr", {"weights": np.zeros(1)}, "means: expected numbers of shape (1, 4)"),
    ("ilo-gmr", {"data": np.full((9, 4), 1e12)}, "data: expected numbers within 1000"),
    ("ilo-gmr", {"limit": -1.0}, "limit: expected a speed above 0"),
]


@pytest.mark.parametrize(("kind", "values", "sentence"), LIES)
def test_a_file_that_no_policy_computes_with_is_refused(
    kind: str, values: dict[str, Any], sentence: str, learned: dict[str, Policy], tmp_path: Path
) -> None:
    path = changed(tmp_path / "policy.npz", learned[kind], **values)
    with pytest.raises(FileFormatError) as caught:
        load_policy(path)
    assert str(caught.value).startswith(str(path))
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    "covariance", [np.zeros((4, 4)), -np.eye(4), np.diag([1.0, 1e-200, 1.0, 1.0]), np.triu(np.ones((4, 4)))]
)
def test_a_mixture_without_densities_is_refused(covariance: Any, learned: dict[str, Policy], tmp_path: Path) -> None:
    mixture = {"weights": np.ones(1), "means": np.zeros((1, 4)), "covariances": covariance[None]}
    with pytest.raises(FileFormatError, match="covariances: expected symmetric, positive definite"):
        load_policy(changed(tmp_path / "policy.npz", learned["gmr"], **mixture))


@pytest.mark.parametrize("scale", ["0.1", np.ones(2), np.nan, 0.0])
def test_a_size_of_version_1_is_checked_too(scale: Any, learned: dict[str, Policy], tmp_path: Path) -> None:
    path = changed(tmp_path / "policy.npz", learned["path-following"], version=1, scale=scale)
    with pytest.raises(FileFormatError, match=r"scale|half_size"):
        load_policy(path)


def test_a_file_and_a_caller_are_told_the_same(tmp_path: Path, learned: dict[str, Policy]) -> None:
    with pytest.raises(InvalidInputError) as told:
        KNearestPolicy(np.ones((3, 2)), np.ones((3, 2)), -1.0)
    path = changed(tmp_path / "policy.npz", learned["knn"], speed=-1.0)
    with pytest.raises(FileFormatError) as read:
        load_policy(path)
    assert str(read.value) == f"{path}: {told.value}"


@pytest.mark.parametrize("kind", POLICY_KINDS)
@pytest.mark.parametrize("size", [1e-9, 1e-3, 400.0])
def test_whatever_can_be_learned_can_be_saved_and_called(kind: str, size: float, tmp_path: Path) -> None:
    """The checks of files refuse nothing that demonstrations of the strangest size lead to."""
    phase = np.linspace(0, 4 * np.pi, 60)
    paths = [size * np.column_stack([np.cos(phase), np.sin(phase)]) * (1 + 0.01 * k) for k in range(2)]
    policy = make_policy(paths, [phase, phase], kind)
    policy.save(tmp_path / "policy.npz")
    velocity = load_policy(tmp_path / "policy.npz")(HANDS)
    np.testing.assert_array_equal(velocity, policy(HANDS))
    assert np.isfinite(velocity).all()
