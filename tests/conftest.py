"""Which tests stay together when processes share them out: those of a file, and all that keep an eye on the clock."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

WORKERS = 2  # of `-n auto`; a browser and a simulation in real time want a core beside each
BROWSER = "tests/studio/"
REAL_TIME = (BROWSER, "tests/signimit_envs/studio/")  # one studio and one browser at a time


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What needs a browser is slow."""
    for item in items:
        if item.nodeid.startswith(BROWSER):
            item.add_marker(pytest.mark.slow)


@pytest.hookimpl(optionalhook=True)  # pytest-xdist may be missing
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """Files that are named are run here: they would be done before workers have started."""
    if all(Path(argument.partition("::")[0]).is_file() for argument in config.args):
        return 0
    return min(WORKERS, os.cpu_count() or 1)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Whatever ``--dist`` says, the tests of a file share its fixtures, and real-time tests do not share a machine."""
    from xdist.scheduler import LoadScopeScheduling

    class LoadFileScheduling(LoadScopeScheduling):  # type: ignore[misc]
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.partition("::")[0]
            return "real time" if file.startswith(REAL_TIME) else file

    return LoadFileScheduling(config, log)
