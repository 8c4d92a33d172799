"""Compiled and plain distances agree, and nothing is imported before it pays."""

import math
import subprocess
import sys

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import acceleration, group_movements, learn, policy_distances
from signimit.benchmark.studies.scaling import compose_many
from signimit.learners.joint.drawing_distance import Drawing, compare_drawings
from signimit.learners.joint.sign_distance import sign_distances, sign_features
from signimit.similarity import maximum_similarities

Array = NDArray[np.float64]


def loops(count: int, seed: int) -> tuple[list[Array], Array]:
    """Noisy circles and squares of different lengths about different objects."""
    rng = np.random.default_rng(seed)
    paths = []
    for t in range(count):
        angles = np.linspace(0, 4 * np.pi, int(rng.integers(20, 60)))
        circle = 0.1 * np.column_stack([np.cos(angles), np.sin(angles) * (-1) ** t])
        paths.append(circle + rng.normal(0, 0.002, circle.shape) + rng.uniform(-0.2, 0.2, 2))
    return paths, rng.uniform(-0.2, 0.2, (count, 3, 2))


def traces(count: int, seed: int, frames: int) -> tuple[list[Drawing], Array]:
    rng = np.random.default_rng(seed)
    places, manner, centres = (
        rng.normal(size=(count, 64, 2)),
        rng.normal(size=(count, 64, 3)),
        rng.normal(size=(count, 2)),
    )
    made = [Drawing(places[t], manner[t], 1.0 + t, centres[t]) for t in range(count)]
    return made, rng.normal(size=(count, frames, 2))


@pytest.fixture
def always(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(acceleration, "WORTHWHILE", 0)


@pytest.mark.parametrize("shift", [0.0, 50.0])
def test_compiled_policy_distances_are_the_plain_ones(monkeypatch: pytest.MonkeyPatch, shift: float) -> None:
    paths, objects = loops(7, 0)
    paths, objects = [path + shift for path in paths], objects + shift
    plain = policy_distances(paths, objects)
    monkeypatch.setattr(acceleration, "WORTHWHILE", 0)
    compiled = policy_distances(paths, objects)
    np.testing.assert_allclose(compiled, plain, rtol=1e-9, atol=1e-12)
    ours, theirs = (group_movements(maximum_similarities(d), rng=1).labels for d in (compiled, plain))
    np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize(("count", "frames"), [(1, 1), (2, 4), (7, 3)])
def test_compiled_drawing_distances_are_the_plain_ones(
    monkeypatch: pytest.MonkeyPatch, count: int, frames: int
) -> None:
    drawings, objects = traces(count, 0, frames)
    plain = compare_drawings(drawings, objects)
    monkeypatch.setattr(acceleration, "WORTHWHILE", 0)
    compiled = compare_drawings(drawings, objects)
    others = ~np.eye(count, dtype=bool)
    np.testing.assert_allclose(compiled[others], plain[others], rtol=1e-4)
    np.testing.assert_allclose(compiled, plain, atol=2e-3)
    np.testing.assert_array_equal(compiled, compiled.transpose(1, 0, 3, 2))


@pytest.mark.parametrize("count", [1, 2, 16, 17, 35])
def test_compiled_sign_distances_are_the_plain_ones(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    rng = np.random.default_rng(count)
    features = sign_features([rng.normal(size=(9, 2)).cumsum(axis=0) for _ in range(count)])
    plain = sign_distances(features)
    monkeypatch.setattr(acceleration, "WORTHWHILE", 0)
    compiled = sign_distances(features)
    np.testing.assert_allclose(compiled, plain, rtol=1e-4)
    np.testing.assert_array_equal(compiled, compiled.T)


def test_compiled_and_plain_distances_are_understood_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    demonstrations = compose_many(18, 4)
    plain = learn(demonstrations)
    monkeypatch.setattr(acceleration, "WORTHWHILE", 0)
    compiled = learn(demonstrations)
    np.testing.assert_array_equal(compiled.labels, plain.labels)
    np.testing.assert_array_equal(compiled.focus, plain.focus)
    assert compiled.word_order == plain.word_order
    for name, tolerance in (("focus_probability", 1e-3), ("sign_distances", 1e-4)):
        np.testing.assert_allclose(compiled.diagnostics[name], plain.diagnostics[name], atol=tolerance)


@pytest.mark.usefixtures("always")
def test_compiled_distances_are_the_same_bytes_again_however_many_work_at_them(monkeypatch: pytest.MonkeyPatch) -> None:
    paths, objects = loops(5, 1)
    first = policy_distances(paths, objects)
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0, 1, 2}, raising=False)
    assert policy_distances(paths, objects).tobytes() == first.tobytes()


@pytest.mark.usefixtures("always")
def test_of_two_points_at_one_place_the_first_is_the_nearest() -> None:
    there_back_and_up = np.array([[0.0, 0.0], [0.1, 0.0], [0.0, 0.0], [0.0, 0.1]])
    distance = policy_distances([there_back_and_up] * 2, np.zeros((2, 1, 2)))[0, 1, 0, 0]
    assert distance == pytest.approx((np.pi / 2) ** 2 / 3)


def test_without_numba_no_twin_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    twin = "signimit.similarity_numba"
    assert acceleration.find_twin(twin, 1e9) is not None
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.delitem(sys.modules, twin)
    assert acceleration.find_twin(twin, 1e9) is None


def test_only_the_size_decides_and_small_sets_stay_with_numpy() -> None:
    assert acceleration.find_twin("math", 0.99 * acceleration.WORTHWHILE) is None
    assert acceleration.find_twin("math", acceleration.WORTHWHILE) is math


def test_importing_signimit_does_not_import_numba() -> None:
    code = "import sys, signimit; sys.exit('numba' in sys.modules)"
    assert subprocess.run([sys.executable, "-W", "ignore", "-c", code], check=False).returncode == 0
