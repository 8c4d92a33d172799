"""The doctor finds what works and names the line that mends the rest."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from signimit_envs import RenderingError
from signimit_envs.cli import doctor, main
from signimit_envs.cli.doctor import CHECKS


@pytest.fixture
def no_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise RenderingError("no OpenGL library was found", "apt-get install -y libosmesa6")

    monkeypatch.setattr(doctor, "choose_backend", fail)


@pytest.mark.usefixtures("no_frames")
def test_without_opengl_the_line_that_mends_it_is_told_and_the_rest_works() -> None:
    findings = {finding.what: finding for check in CHECKS for finding in check()}
    assert not findings["opengl"].works
    assert findings["opengl"].remedy == "apt-get install -y libosmesa6"
    assert "frames" not in findings
    for what in ("python", "packages", "physics", "video"):
        assert findings[what].works, findings[what]
    assert "mujoco" in findings["packages"].detail


@pytest.mark.usefixtures("no_frames")
def test_missing_packages_are_told_with_what_installs_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "installed_version", lambda package: None if package in ("mink", "numba") else "1.0")
    findings = {finding.what: finding for check in CHECKS for finding in check()}
    assert not findings["packages"].works
    assert findings["packages"].remedy == "pip install signimit"
    assert findings["fast"].works
    assert findings["fast"].remedy == "pip install 'signimit[fast]'"


@pytest.mark.usefixtures("no_frames")
def test_the_command_names_what_is_missing_and_what_to_type(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["doctor"])
    said = capsys.readouterr().out
    assert stop.value.code == 1
    assert "MISSING  opengl      no OpenGL library was found\n" in said
    assert "                     apt-get install -y libosmesa6\n" in said
    assert "ok       physics" in said


def test_the_doctor_explains_why_nothing_can_be_imported() -> None:
    """MuJoCo refuses to be imported where MUJOCO_GL names what it does not know or cannot load."""
    environment = {**os.environ, "MUJOCO_GL": "slate", "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-m", "signimit", "doctor"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "MUJOCO_GL=slate" in done.stderr
    assert "unset MUJOCO_GL" in done.stderr
    assert "Traceback" not in done.stderr
