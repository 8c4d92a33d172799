"""Distribution of the tests over processes (pytest-xdist), and the marker of the browser tests."""

from __future__ import annotations

import os
import signal
import threading
from pathlib import Path
from typing import Any

import pytest

WORKERS = 2  # of `-n auto`, at most: more would take processor time from the browser and from simulation in real time
BROWSER = "tests/studio/"
REAL_TIME = (BROWSER, "tests/signimit_envs/studio/")  # stay in one process: one studio and one browser at a time

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN and threading.current_thread() is threading.main_thread():
    # A job in the background of a shell ignores interrupts, and so would every program that a test starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark every browser test as slow."""
    for item in items:
        if item.nodeid.startswith(BROWSER):
            item.add_marker(pytest.mark.slow)


@pytest.hookimpl(optionalhook=True)  # pytest-xdist may be missing
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """Return the number of processes of ``-n auto``: none beside this one for named files, which start sooner so."""
    if all(Path(argument.partition("::")[0]).is_file() for argument in config.args):
        return 0
    return min(WORKERS, os.cpu_count() or 1)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give each file to one process, as its tests share fixtures, whatever ``--dist`` says; real-time files to one."""
    from xdist.scheduler import LoadScopeScheduling

    class LoadFileScheduling(LoadScopeScheduling):  # type: ignore[misc]
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.partition("::")[0]
            return "real time" if file.startswith(REAL_TIME) else file

    return LoadFileScheduling(config, log)
