"""MuJoCo's own log, kept out of the user's folder while warnings are watched otherwise."""

from __future__ import annotations

from threading import Lock
from types import TracebackType
from typing import ClassVar

import mujoco


class QuietLog:
    """Context in which MuJoCo neither prints warnings nor writes MUJOCO_LOG.TXT.

    MuJoCo has one setting for the whole process. The first that enters keeps the usual one and the last that leaves
    brings it back, so that simulations in several threads do not take each other's silence for it. To enter and leave
    costs about as much as a physics step: it is for many at once, and `signimit_envs.arm.arm` does without.
    """

    _lock: ClassVar[Lock] = Lock()
    _inside: ClassVar[int] = 0
    _usual: ClassVar[mujoco.MjLogConfig]

    def __enter__(self) -> None:
        """Silence MuJoCo."""
        with self._lock:
            if not QuietLog._inside:
                QuietLog._usual, silent = mujoco.MjLogConfig.get(), mujoco.MjLogConfig.get()
                silent.logto_file = silent.logto_console = False
                silent.set()
            QuietLog._inside += 1

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Let MuJoCo log as before, once nobody is inside."""
        with self._lock:
            QuietLog._inside -= 1
            if not QuietLog._inside:
                QuietLog._usual.set()
