"""A window with MuJoCo's interactive viewer, where there is a display."""

from __future__ import annotations

import atexit
import functools
import os
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import mujoco

from signimit_envs.exceptions import RenderingError

_REMEDY = "Use render_mode='rgb_array'."
_PROBE = """
import glfw
if not glfw.init():
    raise SystemExit(1)
glfw.window_hint(glfw.VISIBLE, False)
raise SystemExit(not glfw.create_window(16, 16, "", None, None))
"""
_PROBE_SECONDS = 20  # then the display counts as dead
_CLOSE_SECONDS = 5  # that a window is waited for as it closes


def has_display() -> bool:
    """Return whether a display is set; always on systems other than Linux. It may be dead: see `opens_windows`."""
    return sys.platform != "linux" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def opens_windows() -> bool:
    """Return whether a window can be opened; on Linux one is, unseen, in a process of its own.

    A display that is set and does not answer ends the process that asks it for a window, without an exception. The
    answer is kept for as long as the same display is set.
    """
    if sys.platform != "linux":
        return True
    return has_display() and _opens(os.environ.get("DISPLAY"), os.environ.get("WAYLAND_DISPLAY"))


@functools.cache
def _opens(display: str | None, wayland_display: str | None) -> bool:
    """Open a window on the display that the environment variables of this process name."""
    command = [sys.executable, "-c", _PROBE]
    try:
        done = subprocess.run(command, capture_output=True, timeout=_PROBE_SECONDS, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


def _missing_window() -> RenderingError | None:
    """Return why no window can be opened; None if one can."""
    if not has_display():
        return RenderingError("there is no display for render_mode='human'", _REMEDY)
    if not opens_windows():
        names = [f"{name}={os.environ[name]!r}" for name in ("DISPLAY", "WAYLAND_DISPLAY") if os.environ.get(name)]
        return RenderingError(f"{' and '.join(names)} opens no window for render_mode='human'", _REMEDY)
    return None


class WindowView:
    """Window of MuJoCo's interactive viewer, one at a time in a process.

    A copy has no window, and opens one when it first shows something.
    """

    _threads: ClassVar[Sequence[threading.Thread]] = ()  # those of the latest window

    def __init__(self, model: mujoco.MjModel) -> None:
        """Show a model; the window opens at the first `show`.

        Raises:
            RenderingError: If no window can be opened. The viewer itself would end the process.
        """
        missing = _missing_window()
        if missing is not None:
            raise missing
        self._model = model
        self._viewer: Any = None
        self._close: Callable[[], object] | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy needs: not the window."""
        return {**self.__dict__, "_viewer": None, "_close": None}

    def show(self, data: mujoco.MjData) -> None:
        """Bring the window up to date, opening it at the first call.

        Raises:
            RenderingError: If no window can be opened, or another one is open.
        """
        if self._viewer is None:
            self._open(data)
        self._viewer.sync()

    def _open(self, data: mujoco.MjData) -> None:
        missing = _missing_window()  # a copy may have come to another machine
        if missing is not None:
            raise missing
        if any(thread.is_alive() for thread in WindowView._threads):  # a second window would end the process
            raise RenderingError(
                "MuJoCo shows one window at a time, and another is open", "Close its environment first."
            )
        before = threading.enumerate()
        try:
            import mujoco.viewer

            viewer = mujoco.viewer.launch_passive(self._model, data, show_left_ui=False, show_right_ui=False)
        except (ImportError, RuntimeError, mujoco.FatalError) as error:  # on macOS, not run by mjpython
            raise RenderingError(f"no window could be opened ({error})", _REMEDY) from error
        WindowView._threads = [thread for thread in threading.enumerate() if thread not in before]
        self._viewer = viewer
        self._close = weakref.finalize(self, _close_viewer, viewer, WindowView._threads)
        # Before the viewer's own functions at exit, which end the process where its thread still draws.
        atexit.register(self._close)

    def close(self) -> None:
        """Close the window; may be called again."""
        if self._close is not None:
            self._close()
            atexit.unregister(self._close)
        self._viewer = self._close = None


def _close_viewer(viewer: Any, threads: Sequence[threading.Thread]) -> None:
    """Close a window, and wait until its threads are done with it."""
    viewer.close()
    for thread in threads:
        thread.join(_CLOSE_SECONDS)
