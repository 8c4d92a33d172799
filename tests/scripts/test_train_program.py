"""The program that trains says in one sentence what it cannot do."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).parents[2] / "scripts" / "train.py"


@pytest.mark.parametrize(
    ("option", "message"),
    [("--steps=0", "train: steps: expected 1 or more, found 0."), ("--objects=9", "train: objects: expected 2 to 6")],
)
def test_what_cannot_be_trained_is_refused_and_leaves_nothing(option: str, message: str, tmp_path: Path) -> None:
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed")
    command = [sys.executable, str(PROGRAM), option, "--out", str(tmp_path / "out")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.startswith(message)
    assert done.stderr.count("\n") == 1
    assert os.listdir(tmp_path) == []
