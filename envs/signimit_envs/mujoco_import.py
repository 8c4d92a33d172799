"""The first import of MuJoCo, which outlives a MUJOCO_GL that names what is not there.

MuJoCo loads the OpenGL backend that MUJOCO_GL names as it is imported, and cannot be imported where that fails. Physics
needs no OpenGL: then it is imported as if nothing was named, and the variable is judged at the first picture
(`signimit_envs.video.backend.choose_backend`).
"""

from __future__ import annotations

import importlib
import os

_VARIABLES = ("MUJOCO_GL", "PYOPENGL_PLATFORM")  # MuJoCo sets the second as it tries the first


def _import_mujoco() -> None:
    before = {name: os.environ[name] for name in _VARIABLES if name in os.environ}
    try:
        importlib.import_module("mujoco")
    except (AttributeError, ImportError, OSError, RuntimeError):
        for name in _VARIABLES:
            os.environ.pop(name, None)
        try:
            importlib.import_module("mujoco")
        finally:
            os.environ.update(before)


_import_mujoco()
