"""Rendering with OpenGL: pictures as arrays."""

from __future__ import annotations

import os
import sys
import threading
import weakref
from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError
from signimit_envs.exceptions import RenderingError
from signimit_envs.video.backend import choose_backend, use_backend

_FORKED = "this process was forked off one that had drawn with OpenGL, and would wait for a picture for ever"
_SPAWN = 'Start processes with context="spawn", e.g. make_vec(..., vector_kwargs={"context": "spawn"}).'
_kept: list[_Owned] = []  # renderers that were closed outside of their threads


class _Owned(NamedTuple):
    """A renderer, and the thread and process that opened it: OpenGL serves it in no other.

    Attributes:
        renderer: The renderer.
        thread: The thread.
        process: Number of the process.
    """

    renderer: mujoco.Renderer
    thread: threading.Thread
    process: int

    def free(self) -> None:
        """Free the OpenGL context, or keep it until its own thread opens the next one.

        Freed in another thread, EGL raises an error, and OSMesa ends the process at the next picture.
        """
        if (self.thread, self.process) == (threading.current_thread(), os.getpid()):
            self.renderer.close()
        else:
            _kept.append(self)


class OffscreenView:
    """Offscreen renderer: pictures of a model as arrays. OpenGL is looked for at the first picture, not before.

    All pictures of a view are drawn in one thread. Copies and pickles have no renderer, and open one at their first
    picture, in whatever thread and process that is.
    """

    _drawn: ClassVar[bool] = False  # whether this process, or the one that it was forked from, opened a renderer
    _forked: ClassVar[bool] = False  # whether it was forked after that

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
        self._owned: _Owned | None = None
        self._free: Callable[[], object] | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy needs: not the renderer."""
        return {**self.__dict__, "_owned": None, "_free": None}

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
            RenderingError: If there is no OpenGL, or not in this thread or process.
        """
        renderer = self._renderer()
        renderer.update_scene(data, camera)
        if decorate is not None:
            decorate(renderer.scene)
        try:
            return np.array(renderer.render())
        except Exception as error:  # PyOpenGL's, MuJoCo's or ctypes': whatever an OpenGL library does
            raise RenderingError(
                f"OpenGL failed ({_one_line(error)})", "Close the environment, and try again."
            ) from error

    def _renderer(self) -> mujoco.Renderer:
        """Return the renderer, opened if there is none yet."""
        if OffscreenView._forked:  # to ask OpenGL for a picture now would take for ever
            raise RenderingError(_FORKED, _SPAWN)
        if self._owned is None:
            self._owned = self._open()
            # Also freed when the view is not closed: a renderer that outlives the interpreter prints an error.
            self._free = weakref.finalize(self, self._owned.free)
        elif self._owned.thread is not threading.current_thread():
            reason = (
                f"pictures of this view are drawn in the thread {self._owned.thread.name!r}, and OpenGL serves no other"
            )
            raise RenderingError(reason, "Draw in that thread, or draw a copy (copy.deepcopy) in this one.")
        return self._owned.renderer

    def _open(self) -> _Owned:
        thread, backend = threading.current_thread(), choose_backend()
        for owned in [owned for owned in _kept if owned.thread is thread]:
            _kept.remove(owned)
            owned.free()
        try:
            use_backend(backend)
            OffscreenView._drawn = True
            renderer = mujoco.Renderer(self._model, self._height, self._width)
        except Exception as error:
            reason = f"OpenGL through {backend or 'the system'} failed ({_one_line(error)})"
            raise RenderingError(reason, "python -m signimit doctor says what works here.") from error
        return _Owned(renderer, thread, os.getpid())

    def close(self) -> None:
        """Free the OpenGL context; may be called again, and in any thread."""
        if self._free is not None:
            self._free()
        self._owned = self._free = None

    @classmethod
    def note_fork(cls) -> None:
        """Remember in a forked process that OpenGL was in use before, by this module or by MuJoCo's own means."""
        egl = sys.modules.get("mujoco.egl")
        cls._forked = cls._drawn or getattr(egl, "EGL_DISPLAY", None) is not None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=OffscreenView.note_fork)


def _one_line(error: Exception) -> str:
    """Return what an error says, on one line of 200 characters at most."""
    return " ".join(str(error).split())[:200]


def renderer_name() -> str:
    """Return the name of OpenGL's renderer, e.g. ``"llvmpipe (LLVM 15)"``.

    Raises:
        RenderingError: If there is no OpenGL.
    """
    view = OffscreenView(mujoco.MjModel.from_xml_string("<mujoco/>"), 16, 16)
    view._renderer()
    from OpenGL import GL

    try:
        return bytes(GL.glGetString(GL.GL_RENDERER)).decode()
    finally:
        view.close()
