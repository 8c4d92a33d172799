"""A window with MuJoCo's interactive viewer, where there is a display."""

from __future__ import annotations

import functools
import os
import subprocess
import sys
from typing import Any

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
    """Window of MuJoCo's interactive viewer. A copy opens a window of its own when it first shows something."""

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

    def show(self, data: mujoco.MjData) -> None:
        """Bring the window up to date, opening it at the first call.

        Raises:
            RenderingError: If no window can be opened.
        """
        if self._viewer is None:
            self._viewer = self._open(data)
        self._viewer.sync()

    def _open(self, data: mujoco.MjData) -> Any:
        missing = _missing_window()  # a copy may have come to another machine
        if missing is not None:
            raise missing
        try:
            import mujoco.viewer

            return mujoco.viewer.launch_passive(self._model, data, show_left_ui=False, show_right_ui=False)
        except (ImportError, RuntimeError, mujoco.FatalError) as error:  # on macOS, not run by mjpython
            raise RenderingError(f"no window could be opened ({error})", _REMEDY) from error

    def close(self) -> None:
        """Close the window; may be called again."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy needs: not the window."""
        return {**self.__dict__, "_viewer": None}
