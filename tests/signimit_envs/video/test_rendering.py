"""Pictures where there is OpenGL, one clear sentence where there is none."""

from __future__ import annotations

import copy
import ctypes
import gc
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from functools import partial

import gymnasium as gym
import mujoco
import numpy as np
import pytest

from signimit_envs import RenderingError
from signimit_envs.arm.scene import compile_scene
from signimit_envs.video.backend import choose_backend
from signimit_envs.video.rendering import OffscreenView

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


def in_another_thread(work: Callable[[], object]) -> Exception | None:
    """Return what was raised."""
    raised: list[Exception] = []

    def run() -> None:
        try:
            work()
        except Exception as error:
            raised.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return raised[0] if raised else None


def assert_one_line(error: Exception | None) -> str:
    assert isinstance(error, RenderingError)
    assert "\n" not in str(error)
    return str(error)


@pytest.mark.usefixtures("view")
def test_a_picture_in_another_thread_is_refused_and_one_of_a_copy_is_drawn() -> None:
    env = gym.make("signimit/TabletopHand-v0", obs_type="pixels", size=(32, 32))
    env.reset(seed=0)
    said = assert_one_line(in_another_thread(lambda: env.step(np.zeros(2))))
    assert "drawn in the thread 'MainThread'" in said
    assert "copy.deepcopy" in said
    twin = copy.deepcopy(env)

    def draw_and_close() -> None:
        twin.step(np.zeros(2))
        twin.close()

    assert in_another_thread(draw_and_close) is None
    env.step(np.zeros(2))
    assert in_another_thread(env.close) is None
    env.reset(seed=0)  # opens another renderer
    env.close()


@pytest.mark.usefixtures("view")
def test_a_view_of_a_thread_that_is_over_is_closed_quietly(data: mujoco.MjData) -> None:
    views = [OffscreenView(compile_scene(), 32, 32) for _ in range(2)]
    for view in views:
        assert in_another_thread(partial(view.frame, data)) is None
    views[0].close()
    assert views[0].frame(data).shape == (32, 32, 3)
    views[0].close()
    del view, views
    gc.collect()  # an error here would be a warning, and warnings are errors


def test_whatever_opengl_raises_is_told_in_one_sentence(
    view: OffscreenView, data: mujoco.MjData, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Unlucky(mujoco.Renderer):  # type: ignore[misc]
        def render(self, **options: object) -> object:
            raise ctypes.ArgumentError("bad\ncontext" * 99)

    plain = view.frame(data)
    view.close()
    monkeypatch.setattr(mujoco, "Renderer", Unlucky)
    for _ in range(2):
        with pytest.raises(RenderingError, match="OpenGL failed") as failed:
            view.frame(data)
        assert len(assert_one_line(failed.value)) < 300
    monkeypatch.setattr(mujoco, "Renderer", lambda *size: 1 / 0)
    view.close()
    with pytest.raises(RenderingError, match="failed \\(division by zero\\)"):
        view.frame(data)
    monkeypatch.undo()
    np.testing.assert_array_equal(view.frame(data), plain)


@pytest.mark.usefixtures("view")
@pytest.mark.skipif(not hasattr(os, "register_at_fork"), reason="this system does not fork")
@pytest.mark.parametrize("drawn_by", ["env", "MuJoCo"])
def test_forked_workers_say_that_they_have_to_be_spawned(drawn_by: str) -> None:
    """In a process of its own: without the sentence it would hang for ever."""
    program = (
        "import gymnasium as gym, mujoco, signimit_envs\n"
        "from signimit_envs.video import backend\n"
        "env = gym.make('signimit/Tabletop-v0', render_mode='rgb_array', size=(32, 32))\n"
        "env.reset(seed=0)\n"
        "if DRAWN_BY == 'env':\n"
        "    env.render(); env.close()\n"
        "else:\n"
        "    backend.use_backend(backend.choose_backend())\n"
        "    mujoco.Renderer(env.unwrapped.model, 32, 32).close()\n"
        "many = gym.make_vec('signimit/Tabletop-v0', 2, 'async', obs_type='pixels', size=(32, 32))\n"
        "try:\n"
        "    many.reset(seed=0)\n"
        "except signimit_envs.RenderingError as error:\n"
        "    print(error)\n"
    ).replace("DRAWN_BY", repr(drawn_by))
    if drawn_by == "MuJoCo" and choose_backend() != "egl":
        pytest.skip("only of EGL it is known that MuJoCo has drawn")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True, timeout=60
    )
    assert "forked off one that had drawn with OpenGL" in done.stdout
    assert 'context="spawn"' in done.stdout
    assert done.stdout.count("\n") == 1


def test_an_error_of_rendering_survives_the_way_from_another_process() -> None:
    error = RenderingError("no light", "Switch it on.")
    twin = pickle.loads(pickle.dumps(error))
    assert (str(twin), twin.reason, twin.remedy) == (str(error), "no light", "Switch it on.")
    assert str(error) == "Cannot render: no light. Switch it on."
