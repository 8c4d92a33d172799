"""Choice of the OpenGL backend: which one draws a picture on this machine."""

from __future__ import annotations

import functools
import os
import subprocess
import sys

from signimit_envs.exceptions import RenderingError
from signimit_envs.video.window import has_display

INSTALL = "On Debian or Ubuntu: apt-get install -y libosmesa6 (or libegl1 libgl1-mesa-dri)."
_PROBE = (  # program that ends well where a backend works
    "import mujoco\n"
    "renderer = mujoco.Renderer(mujoco.MjModel.from_xml_string('<mujoco/>'), 16, 16)\n"
    "renderer.update_scene(mujoco.MjData(renderer.model))\n"
    "renderer.render(); renderer.close()"
)
_PROBE_SECONDS = 60  # then the backend counts as broken
_BACKENDS = ("glfw", "egl", "osmesa")  # on Linux, the best first; glfw needs a display
_OFF = ("disable", "disabled", "off", "false", "0")  # values of MUJOCO_GL by which MuJoCo renders nothing
_STEERING = (  # variables by which OpenGL may be steered to where there is none
    "MUJOCO_GL",
    "MUJOCO_EGL_DEVICE_ID",
    "PYOPENGL_PLATFORM",
    "EGL_PLATFORM",
    "__EGL_VENDOR_LIBRARY_FILENAMES",
    "__EGL_VENDOR_LIBRARY_DIRS",
    "LIBGL_DRIVERS_PATH",
    "MESA_LOADER_DRIVER_OVERRIDE",
    "GALLIUM_DRIVER",
    "LD_LIBRARY_PATH",
)


def choose_backend() -> str:
    """Choose the OpenGL backend: the user's MUJOCO_GL, else the first of glfw, egl and osmesa that works here.

    Returns:
        Name of the backend; empty where MuJoCo's own choice is right (macOS, Windows).

    Raises:
        RenderingError: If none of them works, or that which the user named does not.
    """
    chosen: str = os.environ.get("MUJOCO_GL", "").lower().strip()
    if not sys.platform.startswith("linux"):
        return chosen
    backend, reason, remedy = _first_working_backend(chosen)
    if not backend:
        raise RenderingError(reason, remedy)
    return backend


@functools.cache
def _first_working_backend(chosen: str) -> tuple[str, str, str]:
    """Try each backend in a process of its own, as a failed one spoils OpenGL for its process, or ends it.

    That takes seconds, so it is done once in a process, also if it fails.

    Args:
        chosen: Name of the only backend to try; empty for any that can be.

    Returns:
        Name of the first that works; or an empty name, why none does, and what to do about it.
    """
    if chosen in _OFF:
        return "", f"MUJOCO_GL={chosen} turns OpenGL off", _find_remedy()
    already = os.environ.get("PYOPENGL_PLATFORM", "").lower()  # PyOpenGL cannot change its platform once imported
    usable = [backend for backend in _BACKENDS if already in ("", "glx", backend)]
    reasons = []
    for backend in (chosen,) if chosen else usable:
        if chosen or backend != "glfw" or has_display():
            failure = _probe(backend)
            if not failure:
                return backend, "", ""
            reasons.append(f"{backend}: {failure}")
    if chosen:
        reason = f"MUJOCO_GL={chosen}, and that fails ({reasons[0].partition(': ')[2]})"
    else:
        reason = f"no OpenGL library works ({'; '.join(reasons) or f'PYOPENGL_PLATFORM={already} allows none'})"
    return "", reason, _find_remedy()


def _probe(backend: str, without: tuple[str, ...] = ()) -> str:
    """Draw a picture in a process of its own.

    Args:
        backend: Value of MUJOCO_GL there.
        without: Environment variables that are not set there.

    Returns:
        Why that failed, in the words of what failed; empty if it did not.
    """
    environment = {name: value for name, value in os.environ.items() if name not in without}
    command = [sys.executable, "-c", _PROBE]
    try:
        done = subprocess.run(
            command,
            env=environment | {"MUJOCO_GL": backend},
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_PROBE_SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"no picture within {_PROBE_SECONDS} s"
    except OSError as error:
        return str(error)
    said = [line.strip() for line in done.stderr.splitlines() if line.strip()]
    return "" if done.returncode == 0 else said[-1] if said else f"the process ended with code {done.returncode}"


def _find_remedy() -> str:
    """Say what mends OpenGL: to unset variables, if pictures are drawn without them, else to install a library."""
    present = tuple(name for name in _STEERING if name in os.environ)
    for names in dict.fromkeys((*((name,) for name in present), present)):
        kept = os.environ.get("MUJOCO_GL", "") if "MUJOCO_GL" not in names else ""
        tried = (kept,) if kept else [backend for backend in _BACKENDS if backend != "glfw" or has_display()]
        if names and not all(_probe(backend, names) for backend in tried):
            return f"Without {' and '.join(names)} it works: unset {' '.join(names)}"
    return INSTALL


def use_backend(backend: str) -> None:
    """Make MuJoCo's renderers use a backend.

    Setting MUJOCO_GL would come too late, MuJoCo reads it as it is imported; its own switch is a private one.
    """
    if not backend or not sys.platform.startswith("linux"):
        return
    from mujoco.rendering.classic import gl_context

    if backend == "egl":
        from mujoco.egl import GLContext
    elif backend == "osmesa":
        from mujoco.osmesa import GLContext
    else:
        from mujoco.glfw import GLContext
    gl_context.GLContext = GLContext
