"""Rendering with OpenGL: choice of a backend, pictures as arrays, and a window where there is a display."""

from __future__ import annotations

import functools
import os
import subprocess
import sys
import weakref
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError
from signimit_envs.exceptions import RenderingError

INSTALL = "On Debian or Ubuntu: apt-get install -y libosmesa6 (or libegl1 libgl1-mesa-dri)."
_PROBE = (  # program that ends well where a backend works
    "import mujoco\n"
    "renderer = mujoco.Renderer(mujoco.MjModel.from_xml_string('<mujoco/>'), 16, 16)\n"
    "renderer.update_scene(mujoco.MjData(renderer.model))\n"
    "renderer.render(); renderer.close()"
)
_PROBE_SECONDS = 60  # then the backend counts as broken


def has_display() -> bool:
    """Return whether a window can be opened: on Linux only where a display is set."""
    return sys.platform != "linux" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def choose_backend() -> str:
    """Choose the OpenGL backend: the user's MUJOCO_GL, else the first of glfw, egl and osmesa that works here.

    Returns:
        Name of the backend; empty where MuJoCo's own choice is right (macOS, Windows).

    Raises:
        RenderingError: If none of them works.
    """
    chosen: str = os.environ.get("MUJOCO_GL", "").lower().strip()
    if chosen or not sys.platform.startswith("linux"):
        return chosen
    backend = _first_working_backend()
    if not backend:
        raise RenderingError("no OpenGL library was found", INSTALL)
    return backend


@functools.cache
def _first_working_backend() -> str:
    """Try each backend in a process of its own, as a failed one spoils OpenGL for its process; empty if none works.

    That takes seconds, so it is done once in a process, also if it fails.
    """
    already = os.environ.get("PYOPENGL_PLATFORM", "").lower()  # PyOpenGL cannot change its platform once imported
    for backend in (*(("glfw",) if has_display() else ()), "egl", "osmesa"):
        if already in ("", "glx", backend) and _works(backend):
            return str(backend)
    return ""


def _works(backend: str) -> bool:
    """Return whether a backend renders a picture in a process of its own."""
    environment = {**os.environ, "MUJOCO_GL": backend}
    command = [sys.executable, "-c", _PROBE]
    try:
        done = subprocess.run(command, env=environment, capture_output=True, timeout=_PROBE_SECONDS, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


def _use_backend(backend: str) -> None:
    """Make MuJoCo's renderers use a backend that was not named in MUJOCO_GL.

    Setting MUJOCO_GL would come too late, MuJoCo reads it as it is imported; its own switch is a private one.
    """
    if os.environ.get("MUJOCO_GL") or not backend:
        return
    from mujoco.rendering.classic import gl_context

    if backend == "egl":
        from mujoco.egl import GLContext
    elif backend == "osmesa":
        from mujoco.osmesa import GLContext
    else:
        from mujoco.glfw import GLContext
    gl_context.GLContext = GLContext


class OffscreenView:
    """Offscreen renderer: pictures of a model as arrays. OpenGL is looked for at the first picture, not before."""

    def __init__(self, model: mujoco.MjModel, width: int = 480, height: int = 480) -> None:
        """Draw a model in pictures of a size, pixels.

        Raises:
            InvalidInputError: If a side is less than 1, or more than the model allows (1280).
        """
        limits = (int(model.vis.global_.offwidth), int(model.vis.global_.offheight))
        if not (0 < width <= limits[0] and 0 < height <= limits[1]):
            raise InvalidInputError(
                "size of frames", f"1 to {limits[0]} by 1 to {limits[1]} pixels", f"{width} by {height}"
            )
        self._model, self._width, self._height = model, width, height
        self._renderer: mujoco.Renderer | None = None
        self._free: Callable[[], object] | None = None

    def frame(
        self,
        data: mujoco.MjData,
        camera: str = "perspective",
        decorate: Callable[[mujoco.MjvScene], None] | None = None,
    ) -> NDArray[np.uint8]:
        """Draw one frame.

        Args:
            data: State of the model.
            camera: ``"perspective"`` or ``"top"``.
            decorate: Adds geometry to the scene before it is drawn, e.g. a trail.

        Returns:
            Shape (height, width, 3), red, green, blue.

        Raises:
            RenderingError: If there is no OpenGL.
        """
        renderer = self._renderer or self._open()
        renderer.update_scene(data, camera)
        if decorate is not None:
            decorate(renderer.scene)
        return np.array(renderer.render())

    def _open(self) -> mujoco.Renderer:
        backend = choose_backend()
        _use_backend(backend)
        try:
            self._renderer = mujoco.Renderer(self._model, self._height, self._width)
        except (mujoco.FatalError, ImportError, RuntimeError, AttributeError) as error:
            raise RenderingError(f"OpenGL through {backend or 'the system'} failed ({error})", INSTALL) from error
        # Also freed when the view is not closed: a renderer that outlives the interpreter prints an error.
        self._free = weakref.finalize(self, self._renderer.close)
        return self._renderer

    def close(self) -> None:
        """Free the OpenGL context; may be called again."""
        if self._free is not None:
            self._free()
        self._renderer = self._free = None


def renderer_name() -> str:
    """Return the name of OpenGL's renderer, e.g. ``"llvmpipe (LLVM 15)"``.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    view = OffscreenView(mujoco.MjModel.from_xml_string("<mujoco/>"), 16, 16)
    view._open()
    from OpenGL import GL

    try:
        return bytes(GL.glGetString(GL.GL_RENDERER)).decode()
    finally:
        view.close()


class WindowView:
    """Window of MuJoCo's interactive viewer."""

    def __init__(self, model: mujoco.MjModel) -> None:
        """Show a model; the window opens at the first `show`.

        Raises:
            RenderingError: If there is no display. The viewer itself would end the process.
        """
        if not has_display():
            raise RenderingError("there is no display for render_mode='human'", "Use render_mode='rgb_array'.")
        self._model = model
        self._viewer: Any = None

    def show(self, data: mujoco.MjData) -> None:
        """Bring the window up to date, opening it at the first call."""
        if self._viewer is None:
            import mujoco.viewer

            self._viewer = mujoco.viewer.launch_passive(self._model, data, show_left_ui=False, show_right_ui=False)
        self._viewer.sync()

    def close(self) -> None:
        """Close the window; may be called again."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None
