"""The study of drawing weights, from libraries of people, and constants measured without the people left out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.learners.joint.drawing_dissimilarity import DRAWINGS, FEATURES
from signimit.strokes import StrokeLibrary
from signimit.teaching.people import synthetic_library

for package in ("tyro", "tqdm"):
    pytest.importorskip(package)


@pytest.fixture
def libraries(tmp_path: Path) -> tuple[Path, Path]:
    """Two people who draw three things several times, and players who draw one thing each."""
    rng = np.random.default_rng(5)
    synthetic_library(("circle", "star", "zigzag"), writers=2, samples=4, rng=rng).save(tmp_path / "people.npz")
    drawn = synthetic_library(("square", "star", "zigzag"), writers=3, samples=1, rng=rng)
    players = tuple(f"player {i}" for i in range(len(drawn)))
    StrokeLibrary(drawn.strokes, drawn.labels, players, "players").save(tmp_path / "players.npz")
    return tmp_path / "people.npz", tmp_path / "players.npz"


def test_weights_are_printed_beside_the_packages_and_written(
    run: Any, libraries: tuple[Path, Path], tmp_path: Path
) -> None:
    said = run("study", "drawing-weights", *libraries, "--without", "star", "--out", tmp_path / "out")
    facts = json.loads((tmp_path / "out" / "drawing_weights.json").read_text())
    weights = facts["weights, nats a unit"]
    assert list(weights) == [*FEATURES, "offset"]
    for name, shipped in zip(weights, (*DRAWINGS.weights, DRAWINGS.offset), strict=True):
        assert f"| {name} | {weights[name]} | {shipped} |" in said
    assert "study drawing-weights" in facts["command"]
    areas = (tmp_path / "out" / "areas.md").read_text().strip()
    assert areas in said
    assert [line.split(" | ")[:2] for line in areas.splitlines()[2:]] == [
        ["| synthetic synthetic 1", "120"], ["| synthetic synthetic 2", "120"], ["| players strangers", "15"],
    ]  # fmt: skip


def test_one_person_alone_is_left_out_of_nothing(run: Any, tmp_path: Path) -> None:
    alone = synthetic_library(("star", "zigzag"), samples=3, rng=np.random.default_rng(0))
    alone.save(tmp_path / "alone.npz")
    said = run("study", "drawing-weights", tmp_path / "alone.npz", "--out", tmp_path / "out")
    assert "| area under the curve | pairs | fitted | the package's |" in said


def test_a_label_that_nobody_drew_is_told(run: Any, libraries: tuple[Path, Path], tmp_path: Path) -> None:
    said = run.refusal("study", "drawing-weights", *libraries, "--without", "cube", "--out", tmp_path / "out")
    assert "'cube'" in said
    assert "circle, square, star" in said
    assert not (tmp_path / "out").exists()
