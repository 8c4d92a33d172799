"""The program that trains says in one sentence what it cannot do."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest


@pytest.mark.parametrize(
    ("option", "message"),
    [("--steps=0", "train: steps: expected 1 or more, found 0."), ("--objects=9", "train: objects: expected 2 to 6")],
)
def test_what_cannot_be_trained_is_refused_and_leaves_nothing(
    run: Any, option: str, message: str, tmp_path: Path
) -> None:
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed")
    assert run.refusal("train", option, "--out", tmp_path / "out").startswith(message)
    assert os.listdir(tmp_path) == []
