"""The backend that draws on this machine is found, and where none does, the remedy."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import mujoco
import pytest

from signimit_envs import RenderingError
from signimit_envs.video import backend
from signimit_envs.video.backend import choose_backend


@pytest.fixture
def probed(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[tuple[str, tuple[str, ...]]]]:
    """Backends that were probed, each with the variables that were unset for it, on a Linux without displays."""
    for name in (*backend._STEERING, "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    backend._first_working_backend.cache_clear()
    yield []
    backend._first_working_backend.cache_clear()


Probed = list[tuple[str, tuple[str, ...]]]


@pytest.mark.parametrize(("working", "tried"), [("egl", ["egl"]), ("osmesa", ["egl", "osmesa"])])
def test_no_backend_that_fails_is_chosen(
    working: str, tried: list[str], probed: Probed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def probe(name: str, without: tuple[str, ...] = ()) -> str:
        probed.append((name, without))
        return "" if name == working else "Error: broken"

    monkeypatch.setattr(backend, "_probe", probe)
    assert choose_backend() == working
    assert [name for name, _ in probed] == tried


def test_the_users_choice_is_respected(probed: Probed, monkeypatch: pytest.MonkeyPatch) -> None:
    def probe(name: str, without: tuple[str, ...] = ()) -> str:
        probed.append((name, without))
        return ""

    monkeypatch.setattr(backend, "_probe", probe)
    monkeypatch.setenv("MUJOCO_GL", "OSMesa ")
    assert choose_backend() == "osmesa"
    assert probed == [("osmesa", ())]


def test_where_nothing_works_each_reason_is_told_and_nothing_is_tried_twice(
    probed: Probed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(name: str, without: tuple[str, ...] = ()) -> str:
        probed.append((name, without))
        return f"ImportError: no {name}"

    monkeypatch.setattr(backend, "_probe", fails)
    expected = r"no OpenGL library works \(egl: ImportError: no egl; osmesa: ImportError: no osmesa\)\. .*apt-get"
    for _ in range(2):
        with pytest.raises(RenderingError, match=expected):
            choose_backend()
    assert [name for name, _ in probed] == ["egl", "osmesa"]


@pytest.mark.parametrize(
    ("variables", "guilty"),
    [
        ({"MUJOCO_GL": "slate"}, ("MUJOCO_GL",)),
        ({"MUJOCO_GL": "disable"}, ("MUJOCO_GL",)),
        ({"MUJOCO_EGL_DEVICE_ID": "7"}, ("MUJOCO_EGL_DEVICE_ID",)),
        ({"MUJOCO_GL": "egl", "MUJOCO_EGL_DEVICE_ID": "7"}, ("MUJOCO_EGL_DEVICE_ID",)),
        ({"PYOPENGL_PLATFORM": "none"}, ("PYOPENGL_PLATFORM",)),
        ({"MUJOCO_GL": "glfw", "EGL_PLATFORM": "none"}, ("MUJOCO_GL", "EGL_PLATFORM")),
    ],
)
def test_a_variable_without_which_pictures_are_drawn_is_the_remedy_not_apt(
    variables: dict[str, str], guilty: tuple[str, ...], probed: Probed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def probe(name: str, without: tuple[str, ...] = ()) -> str:
        probed.append((name, without))
        return "" if name == "egl" and set(guilty) <= set(without) else "RuntimeError: its own reason"

    monkeypatch.setattr(backend, "_probe", probe)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    with pytest.raises(RenderingError) as caught:
        choose_backend()
    assert caught.value.remedy == f"Without {' and '.join(guilty)} it works: unset {' '.join(guilty)}"
    untried = {"MUJOCO_GL=disable turns OpenGL off", "no OpenGL library works (PYOPENGL_PLATFORM=none allows none)"}
    assert "RuntimeError: its own reason" in caught.value.reason or caught.value.reason in untried


def test_a_probe_repeats_the_last_thing_that_was_said(monkeypatch: pytest.MonkeyPatch) -> None:
    said = backend._probe("slate")
    assert said == "RuntimeError: invalid value for environment variable MUJOCO_GL: slate"
    monkeypatch.setattr(backend, "_PROBE", "import os; os._exit(3)")
    assert backend._probe("egl") == "the process ended with code 3"
    monkeypatch.setattr(backend, "_PROBE", "import time; time.sleep(9)")
    monkeypatch.setattr(backend, "_PROBE_SECONDS", 0.1)
    assert backend._probe("egl") == "no picture within 0.1 s"


def test_mujocos_private_switch_is_where_it_is_expected() -> None:
    from mujoco.rendering.classic import gl_context, renderer

    assert hasattr(gl_context, "GLContext")
    assert renderer.gl_context is gl_context
    assert renderer.Renderer is mujoco.Renderer
