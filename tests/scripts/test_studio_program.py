"""The program refuses what would be dangerous, and says its address otherwise."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).parents[2] / "scripts" / "studio.py"
pytest.importorskip("tyro", reason="the programs need signimit[scripts]")


def _command(*arguments: str) -> list[str]:
    return [sys.executable, str(PROGRAM), "--no-open", *arguments]


def test_others_are_let_in_only_by_who_knows(tmp_path: Path) -> None:
    done = subprocess.run(
        _command("--host", "0.0.0.0", "--folder", str(tmp_path)), capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert done.stderr.startswith("studio: --host: expected 127.0.0.1, or --i-know beside it")
    assert "Traceback" not in done.stderr


@pytest.mark.skipif(os.name != "posix", reason="interrupts are sent otherwise here")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_says_its_address_and_ends_when_it_is_told_to(number: int, tmp_path: Path) -> None:
    pytest.importorskip("fastapi", reason="the studio needs signimit[studio]")
    command = _command("--folder", str(tmp_path))
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as studio:
        assert studio.stdout is not None
        assert studio.stdout.readline().startswith("The studio is at http://127.0.0.1:")
        studio.send_signal(number)
        _, complaints = studio.communicate(timeout=60)
    assert "Traceback" not in complaints
