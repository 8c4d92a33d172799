"""Processes of a study stop with the user, and only what waits for them says so."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from signimit.benchmark.workers import SessionProcesses

SLEEPING = """
import sys, time
from pathlib import Path
from signimit.benchmark.workers import SessionProcesses

def wait(number):
    Path(sys.argv[1], str(number)).touch()
    time.sleep(60)

if __name__ == "__main__":
    try:
        with SessionProcesses(2) as pool:
            print("ready", flush=True)
            list(pool.map(wait, range(9)))
    except KeyboardInterrupt:
        print("stopped")
"""
_seen: list[int] = []


def see(number: int) -> None:
    _seen.append(number)


def last_seen(more: int) -> int:
    return _seen[-1] + more


def test_workers_begin_with_what_they_are_given_and_results_come_back() -> None:
    with SessionProcesses(2, see, 5) as pool:
        assert list(pool.map(last_seen, range(4))) == [5, 6, 7, 8]
        assert pool.submit(last_seen, more=1).result() == 6


@pytest.mark.slow
@pytest.mark.parametrize("begun", [False, True], ids=["while they are imported", "while they work"])
def test_an_interrupt_of_all_ends_them_at_once_without_a_traceback(begun: bool, tmp_path: Path) -> None:
    """As Ctrl-C in a terminal does, which reaches every process."""
    (tmp_path / "program.py").write_text(SLEEPING)
    (tmp_path / "tasks").mkdir()
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, str(tmp_path / "program.py"), str(tmp_path / "tasks")]
    with subprocess.Popen(
        command,
        env=environment,
        text=True,
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as program:
        assert program.stdout is not None
        assert program.stdout.readline() == "ready\n"
        while begun and len(list((tmp_path / "tasks").iterdir())) < 2:
            time.sleep(0.02)
        os.killpg(program.pid, signal.SIGINT)
        said, errors = program.communicate(timeout=40)
    assert (said, errors, program.returncode) == ("stopped\n", "", 0)
    assert len(list((tmp_path / "tasks").iterdir())) == 2 * begun
