"""The doctor finds what works and names the line that mends the rest."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable

import pytest

from signimit.exceptions import install_command
from signimit_envs import RenderingError
from signimit_envs.cli import doctor, main
from signimit_envs.cli.doctor import CHECKS, Finding, run_check
from signimit_envs.video import mp4


@pytest.fixture
def no_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise RenderingError("no OpenGL library was found", "apt-get install -y libosmesa6")

    monkeypatch.setattr(doctor, "choose_backend", fail)


@pytest.mark.usefixtures("no_frames")
def test_without_opengl_the_line_that_mends_it_is_told_and_the_rest_works() -> None:
    findings = {finding.what: finding for check in CHECKS.values() for finding in check()}
    assert not findings["opengl"].works
    assert findings["opengl"].remedy == "apt-get install -y libosmesa6"
    assert "frames" not in findings
    for what in ("python", "packages", "physics", "video"):
        assert findings[what].works, findings[what]
    assert "mujoco" in findings["packages"].detail


@pytest.mark.usefixtures("no_frames")
def test_missing_packages_are_told_with_what_installs_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "installed_version", lambda package: None if package in ("mink", "numba") else "1.0")
    findings = {finding.what: finding for check in CHECKS.values() for finding in check()}
    assert not findings["packages"].works
    assert findings["packages"].remedy == install_command("signimit")
    assert findings["fast"].works
    assert findings["fast"].remedy == install_command("signimit[fast]")


@pytest.mark.usefixtures("no_frames")
def test_the_command_names_what_is_missing_and_what_to_type(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["doctor"])
    said = capsys.readouterr().out
    assert stop.value.code == 1
    assert "MISSING  opengl      no OpenGL library was found\n" in said
    assert "                     apt-get install -y libosmesa6\n" in said
    assert "ok       physics" in said


def diagnose(check: Callable[[], list[Finding]]) -> Finding:
    mp4.ffmpeg_version.cache_clear()
    (finding,) = run_check("anything", check)
    mp4.ffmpeg_version.cache_clear()
    return finding


@pytest.mark.parametrize("program", ["/nonexistent", "/", sys.executable + "/beyond", "/bin/true", "/bin/false"])
def test_where_a_variable_names_no_ffmpeg_the_doctor_says_so_and_does_not_raise(
    program: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", program)
    finding = diagnose(doctor.check_video)
    assert (finding.what, finding.works) == ("video", False)
    assert finding.detail.startswith("ffmpeg does not run (")
    assert finding.remedy == f"IMAGEIO_FFMPEG_EXE={program} is no ffmpeg: unset IMAGEIO_FFMPEG_EXE"


def test_without_ffmpeg_the_doctor_says_what_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> str:
        raise RuntimeError("No ffmpeg exe could be found.\nInstall it")

    monkeypatch.delenv("IMAGEIO_FFMPEG_EXE", raising=False)
    monkeypatch.setattr("imageio_ffmpeg.get_ffmpeg_version", missing)
    finding = diagnose(doctor.check_video)
    assert finding.detail == "ffmpeg does not run (No ffmpeg exe could be found.)"
    assert finding.remedy == f"Type: {install_command('imageio[ffmpeg]')}"


def test_whatever_a_check_raises_is_what_was_found() -> None:
    def broken() -> list[Finding]:
        raise ZeroDivisionError("no\nphysics")

    assert diagnose(broken) == Finding("anything", False, "ZeroDivisionError: no physics")


def test_the_doctor_works_where_mujoco_cannot_be_imported_with_the_variable_and_tells_its_reason() -> None:
    """MuJoCo refuses to be imported where MUJOCO_GL names what it does not know or cannot load."""
    environment = {**os.environ, "MUJOCO_GL": "slate", "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-m", "signimit", "doctor"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (1, "")
    assert "MISSING  opengl      MUJOCO_GL=slate, and that fails (RuntimeError: invalid value for" in done.stdout
    assert "ok       physics" in done.stdout
