"""The study of clumsiness writes its table, its facts and its figure, or nothing."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.teaching.people import synthetic_library
from signimit.teaching.people.choosing import CLUMSY

for package in ("tyro", "tqdm", "matplotlib"):
    pytest.importorskip(package)


@pytest.fixture
def library(tmp_path: Path) -> Path:
    synthetic_library(("circle", "star"), writers=4, samples=1, rng=np.random.default_rng(5)).save(tmp_path / "p.npz")
    return tmp_path / "p.npz"


def test_built_in_people_are_compared_with_those_of_a_library(run: Any, library: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    few = ("--shapes", "circle", "star", "--spreads", "1", "3", "--people", "5")
    said = run("study", "clumsiness", library, *few, "--out", out)
    assert (out / "clumsiness.md").read_text().strip() in said
    facts = json.loads((out / "clumsiness.json").read_text())
    assert facts["drawings"] == {"circle": 4, "star": 4}
    assert facts["nearest spread"] == 1.0  # these are built-in people, too
    assert facts["the package's"] == CLUMSY
    assert (out / "clumsiness.png").read_bytes().startswith(b"\x89PNG")


def test_the_usual_spread_is_always_among_them(run: Any, library: Path, tmp_path: Path) -> None:
    said = run.refusal("study", "clumsiness", library, "--spreads", "2", "--out", tmp_path / "out")
    assert "--spreads: expected numbers of zero or more, 1 among them, found (2.0,)." in said
    assert not (tmp_path / "out").exists()
