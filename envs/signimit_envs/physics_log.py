"""MuJoCo's own log, kept out of the user's folder while the environment watches the warnings itself."""

from __future__ import annotations

from types import TracebackType

import mujoco


class QuietLog:
    """Context in which MuJoCo neither prints warnings nor writes MUJOCO_LOG.TXT.

    It is entered in every control step, so both settings are read once, when it is made; after the block MuJoCo logs as
    it did then.
    """

    def __init__(self) -> None:
        """Read how MuJoCo logs."""
        self._usual, self._silent = mujoco.MjLogConfig.get(), mujoco.MjLogConfig.get()
        self._silent.logto_file = self._silent.logto_console = False

    def __enter__(self) -> None:
        """Silence MuJoCo."""
        self._silent.set()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Let MuJoCo log as before."""
        self._usual.set()
