"""MuJoCo's own log, kept out of the user's folder while the environment watches the warnings itself."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco


@contextmanager
def quiet_log() -> Iterator[None]:
    """Neither print MuJoCo's warnings nor write MUJOCO_LOG.TXT inside the block; afterwards all is as before."""
    before = mujoco.MjLogConfig.get()
    silent = mujoco.MjLogConfig.get()
    silent.logto_file = silent.logto_console = False
    silent.set()
    try:
        yield
    finally:
        before.set()
