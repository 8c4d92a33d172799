"""Pictures where there is OpenGL, one clear sentence where there is none."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import signimit
from signimit_envs import RenderingError
from signimit_envs.arm.scene import compile_scene
from signimit_envs.video import rendering
from signimit_envs.video.rendering import OffscreenView, WindowView, choose_backend

WITHOUT_OPENGL = """
import gymnasium as gym
env = gym.make("signimit_envs:signimit/TabletopHand-v0", render_mode="rgb_array")
env.reset(seed=0)
for _ in range(5):
    env.step(env.action_space.sample())
try:
    env.render()
except Exception as error:
    print(type(error).__name__, error)
env.close()
"""


@pytest.fixture(scope="module")
def view() -> Iterator[OffscreenView]:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))
    offscreen = OffscreenView(compile_scene(), 192, 128)
    yield offscreen
    offscreen.close()


@pytest.fixture(scope="module")
def data() -> mujoco.MjData:
    model = compile_scene()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return data


def test_without_opengl_everything_works_but_pictures() -> None:
    """In a process of its own where the backends find no library: physics steps, and rendering says what to type."""
    environment = {k: v for k, v in os.environ.items() if k not in ("MUJOCO_GL", "DISPLAY", "WAYLAND_DISPLAY")}
    environment |= {"PYTHONPATH": os.pathsep.join(p for p in sys.path if p), "PYOPENGL_PLATFORM": "none of them"}
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT_OPENGL], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("RenderingError Cannot render: no OpenGL library works (PYOPENGL_PLATFORM=none")
    assert "unset PYOPENGL_PLATFORM" in done.stdout or "apt-get install" in done.stdout  # that where none is there


@pytest.fixture
def probed(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[tuple[str, tuple[str, ...]]]]:
    """Backends that were probed, each with the variables that were unset for it, on a Linux without displays."""
    for name in (*rendering._STEERING, "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    rendering._first_working_backend.cache_clear()
    yield []
    rendering._first_working_backend.cache_clear()


Probed = list[tuple[str, tuple[str, ...]]]


@pytest.mark.parametrize(("working", "tried"), [("egl", ["egl"]), ("osmesa", ["egl", "osmesa"])])
def test_no_backend_that_fails_is_chosen(
    working: str, tried: list[str], probed: Probed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def probe(backend: str, without: tuple[str, ...] = ()) -> str:
        probed.append((backend, without))
        return "" if backend == working else "Error: broken"

    monkeypatch.setattr(rendering, "_probe", probe)
    assert choose_backend() == working
    assert [backend for backend, _ in probed] == tried


def test_the_users_choice_is_respected(probed: Probed, monkeypatch: pytest.MonkeyPatch) -> None:
    def probe(backend: str, without: tuple[str, ...] = ()) -> str:
        probed.append((backend, without))
        return ""

    monkeypatch.setattr(rendering, "_probe", probe)
    monkeypatch.setenv("MUJOCO_GL", "OSMesa ")
    assert choose_backend() == "osmesa"
    assert probed == [("osmesa", ())]


def test_where_nothing_works_each_reason_is_told_and_nothing_is_tried_twice(
    probed: Probed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(backend: str, without: tuple[str, ...] = ()) -> str:
        probed.append((backend, without))
        return f"ImportError: no {backend}"

    monkeypatch.setattr(rendering, "_probe", fails)
    expected = r"no OpenGL library works \(egl: ImportError: no egl; osmesa: ImportError: no osmesa\)\. .*apt-get"
    for _ in range(2):
        with pytest.raises(RenderingError, match=expected):
            choose_backend()
    assert [backend for backend, _ in probed] == ["egl", "osmesa"]


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
    def probe(backend: str, without: tuple[str, ...] = ()) -> str:
        probed.append((backend, without))
        return "" if backend == "egl" and set(guilty) <= set(without) else "RuntimeError: its own reason"

    monkeypatch.setattr(rendering, "_probe", probe)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    with pytest.raises(RenderingError) as caught:
        choose_backend()
    assert caught.value.remedy == f"Without {' and '.join(guilty)} it works: unset {' '.join(guilty)}"
    untried = {"MUJOCO_GL=disable turns OpenGL off", "no OpenGL library works (PYOPENGL_PLATFORM=none allows none)"}
    assert "RuntimeError: its own reason" in caught.value.reason or caught.value.reason in untried


def test_a_probe_repeats_the_last_thing_that_was_said(monkeypatch: pytest.MonkeyPatch) -> None:
    said = rendering._probe("slate")
    assert said == "RuntimeError: invalid value for environment variable MUJOCO_GL: slate"
    monkeypatch.setattr(rendering, "_PROBE", "import os; os._exit(3)")
    assert rendering._probe("egl") == "the process ended with code 3"
    monkeypatch.setattr(rendering, "_PROBE", "import time; time.sleep(9)")
    monkeypatch.setattr(rendering, "_PROBE_SECONDS", 0.1)
    assert rendering._probe("egl") == "no picture within 0.1 s"


@pytest.mark.parametrize("value", ["slate", "osmesa", "disable"])
def test_physics_starts_whatever_mujoco_gl_says(value: str) -> None:
    program = (
        "import os, gymnasium as gym\n"
        "env = gym.make('signimit_envs:signimit/TabletopHand-v0')\n"
        "env.reset(seed=0); env.step(env.action_space.sample())\n"
        "import mujoco\n"
        "print(os.environ['MUJOCO_GL'], os.environ.get('PYOPENGL_PLATFORM') in (None, 'osmesa'))"
    )
    environment = {k: v for k, v in os.environ.items() if k != "PYOPENGL_PLATFORM"}
    environment |= {"MUJOCO_GL": value, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == (f"{value} True\n", "")


def test_mujocos_private_switch_is_where_it_is_expected() -> None:
    from mujoco.rendering.classic import gl_context, renderer

    assert hasattr(gl_context, "GLContext")
    assert renderer.gl_context is gl_context
    assert renderer.Renderer is mujoco.Renderer


def test_frames_are_fresh_arrays_that_show_something(view: OffscreenView, data: mujoco.MjData) -> None:
    first, second = view.frame(data, "top"), view.frame(data, "perspective")
    assert first.shape == (128, 192, 3)
    assert first.dtype == np.uint8
    assert not np.shares_memory(first, second)
    assert min(first.std(), second.std()) > 10
    assert np.abs(first.astype(int) - second).max() > 50


def test_all_three_objects_are_seen_from_above_in_their_colours(view: OffscreenView, data: mujoco.MjData) -> None:
    image = view.frame(data, "top").astype(int)
    for channel in range(3):
        others = [c for c in range(3) if c != channel]
        assert (image[..., channel] > 1.25 * image[..., others].max(axis=-1)).sum() > 5


def test_decorations_are_drawn(view: OffscreenView, data: mujoco.MjData) -> None:
    def add_ball(scene: mujoco.MjvScene) -> None:
        scene.ngeom += 1
        mujoco.mjv_initGeom(
            scene.geoms[scene.ngeom - 1],
            mujoco.mjtGeom.mjGEOM_SPHERE,
            np.full(3, 0.1),
            np.zeros(3),
            np.eye(3).ravel(),
            np.array([1, 0, 1, 1], np.float32),
        )

    plain, decorated = view.frame(data, "top"), view.frame(data, "top", add_ball)
    assert (plain != decorated).any()
    assert (view.frame(data, "top") == plain).all()


def test_closing_a_view_twice_is_allowed_and_it_opens_again(view: OffscreenView, data: mujoco.MjData) -> None:
    plain = view.frame(data)
    view.close()
    view.close()
    np.testing.assert_array_equal(view.frame(data), plain)


@pytest.mark.slow
@pytest.mark.usefixtures("view")
def test_an_environment_that_nobody_closes_leaves_quietly() -> None:
    program = (
        "import gymnasium as gym\n"
        "env = gym.make('signimit_envs:signimit/Tabletop-v0', render_mode='rgb_array', size=(32, 32))\n"
        "env.reset(seed=0); print(env.render().shape)"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "(32, 32, 3)\n", "")


def test_the_environment_renders_what_it_was_asked_to(view: OffscreenView) -> None:
    env = gym.make("signimit/Tabletop-v0", render_mode="rgb_array", size=(64, 48), camera="top")
    env.reset(seed=0)
    frame = env.render()
    assert isinstance(frame, np.ndarray)
    assert frame.shape == (48, 64, 3)
    env.close()


def test_a_window_without_a_display_is_refused_before_it_ends_the_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(signimit.SignimitError, match="no display for render_mode='human'"):
        WindowView(compile_scene())
