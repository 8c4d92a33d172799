"""MuJoCo's own log, kept out of the user's folder while the environment watches the warnings itself."""

from __future__ import annotations

from types import TracebackType

import mujoco


class QuietLog:
    """Context in which MuJoCo neither prints warnings nor writes MUJOCO_LOG.TXT; afterwards all is as before."""

    def __init__(self) -> None:
        """Prepare the silence: entered in every control step, so it costs a microsecond."""
        self._silent = mujoco.MjLogConfig.get()
        self._silent.logto_file = self._silent.logto_console = False
        self._before = self._silent

    def __enter__(self) -> None:
        """Remember how MuJoCo logs, and silence it."""
        self._before = mujoco.MjLogConfig.get()
        self._silent.set()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Let MuJoCo log as before."""
        self._before.set()
