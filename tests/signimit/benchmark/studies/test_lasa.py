"""The LASA handwriting set, from a file of its format that the test makes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from signimit.benchmark.studies.lasa import find_lasa, load_lasa, reproduce, reproduction_error, swept_area
from signimit.exceptions import FileFormatError, MissingDependencyError
from signimit.policies import make_policy


def write_shape(path: Path, count: int = 7) -> None:
    """Write a shape as the set does: a cell of structs with pos (2, T) in mm, t (1, T), vel, acc."""
    rng, demos = np.random.default_rng(0), np.empty((1, count), dtype=object)
    times = np.linspace(0, 3, 200)[None]
    for i in range(count):
        ease = 1 - (10 * (times / 3) ** 3 - 15 * (times / 3) ** 4 + 6 * (times / 3) ** 5)
        start = np.array([[-40.0], [30.0]]) + rng.normal(0, 1, (2, 1))
        pos = start * ease + np.array([[0.0], [15.0]]) * np.sin(np.pi * ease)
        demos[0, i] = {"pos": pos, "t": times, "vel": pos * 0, "acc": pos * 0, "dt": times[0, 1]}
    savemat(path, {"demos": demos, "dt": times[0, 1]})


def test_a_shape_is_read_in_metres_and_seconds(tmp_path: Path) -> None:
    write_shape(tmp_path / "Curve.mat")
    shape = load_lasa(tmp_path / "Curve.mat")
    assert (shape.name, len(shape.paths)) == ("Curve", 7)
    assert shape.paths[0].shape == (200, 2)
    assert np.abs(shape.paths[0][0]).max() < 0.05
    assert shape.times[0][-1] == 3


def test_the_default_policy_reproduces_a_shape_and_stays_at_its_goal(tmp_path: Path) -> None:
    write_shape(tmp_path / "Curve.mat")
    (shape,) = find_lasa(tmp_path)
    policy = make_policy(shape.paths, shape.times)
    for path, times in zip(shape.paths, shape.times, strict=True):
        error = reproduction_error(reproduce(policy, path, times), path)
        assert error.goal_gap < 1.0
        assert error.dtw < 3.0 * 1000
        assert error.swept_area < 200


def test_the_area_between_parallel_lines_is_a_rectangle() -> None:
    line = np.column_stack([np.linspace(0, 10, 50), np.zeros(50)])
    assert swept_area(line, line + np.array([0.0, 2.0])) == pytest.approx(20)
    assert swept_area(line, line) == 0


def test_damaged_files_and_empty_folders_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"\.mat files"):
        next(find_lasa(tmp_path))
    (tmp_path / "Bad.mat").write_bytes(b"not matlab" * 30)
    with pytest.raises(FileFormatError, match="LASA"):
        load_lasa(tmp_path / "Bad.mat")
    savemat(tmp_path / "Other.mat", {"x": np.eye(2)})
    with pytest.raises(FileFormatError, match="LASA"):
        load_lasa(tmp_path / "Other.mat")
    with pytest.raises(FileNotFoundError):
        load_lasa(tmp_path / "None.mat")


def test_without_the_extra_the_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr("signimit.benchmark.studies.lasa.importlib.import_module", missing)
    with pytest.raises(MissingDependencyError, match="lasa"):
        next(find_lasa())
