"""The doctor finds what works and names the line that mends the rest."""

from __future__ import annotations

import pytest

from signimit_envs import RenderingError
from signimit_envs.cli import doctor as diagnosis
from signimit_envs.cli.doctor import diagnose


@pytest.fixture
def no_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise RenderingError("no OpenGL library was found", "apt-get install -y libosmesa6")

    monkeypatch.setattr(diagnosis, "choose_backend", fail)


@pytest.mark.usefixtures("no_frames")
def test_without_opengl_the_line_that_mends_it_is_told_and_the_rest_works() -> None:
    findings = {finding.what: finding for finding in diagnose()}
    assert not findings["opengl"].works
    assert findings["opengl"].remedy == "apt-get install -y libosmesa6"
    assert "frames" not in findings
    for what in ("python", "packages", "physics", "video"):
        assert findings[what].works, findings[what]
    assert "mujoco" in findings["packages"].detail


@pytest.mark.usefixtures("no_frames")
def test_missing_packages_are_told_with_what_installs_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(diagnosis, "_version", lambda package: None if package in ("mink", "numba") else "1.0")
    findings = {finding.what: finding for finding in diagnose()}
    assert not findings["packages"].works
    assert findings["packages"].remedy == "pip install signimit"
    assert findings["fast"].works
    assert findings["fast"].remedy == "pip install 'signimit[fast]'"
