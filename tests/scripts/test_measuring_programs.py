"""The doctor and the speed program print what they find."""

from __future__ import annotations

import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from signimit_envs import RenderingError
from signimit_envs.cli import doctor as diagnosis
from signimit_envs.timing import measurements

SCRIPTS = Path(__file__).parents[2] / "scripts"


def run(name: str, *arguments: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [str(SCRIPTS / name), *arguments])
    runpy.run_path(str(SCRIPTS / name), run_name="__main__")


def test_the_doctor_names_what_is_missing_and_what_to_type(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail() -> str:
        raise RenderingError("no OpenGL library was found", "apt-get install -y libosmesa6")

    monkeypatch.setattr(diagnosis, "choose_backend", fail)
    with pytest.raises(SystemExit) as stop:
        run("doctor.py", monkeypatch=monkeypatch)
    said = capsys.readouterr().out
    assert stop.value.code == 1
    assert "MISSING  opengl      no OpenGL library was found\n" in said
    assert "                     apt-get install -y libosmesa6\n" in said
    assert "ok       physics" in said


def test_the_doctor_explains_why_nothing_can_be_imported() -> None:
    """MuJoCo refuses to be imported where MUJOCO_GL names what it does not know or cannot load."""
    environment = {**os.environ, "MUJOCO_GL": "slate", "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run(
        [sys.executable, str(SCRIPTS / "doctor.py")], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "MUJOCO_GL=slate" in done.stderr
    assert "unset MUJOCO_GL" in done.stderr
    assert "Traceback" not in done.stderr


def test_the_speed_program_prints_ratios(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tyro")
    monkeypatch.setattr(measurements, "STEPS", 5)
    run("speed.py", "env", "--repetitions", "1", monkeypatch=monkeypatch)
    said = capsys.readouterr().out
    assert "signimit/Tabletop-v0" in said
    assert "signimit/TabletopHand-v0" in said
    assert said.count("ratio") == 2
