"""The program refuses what would be dangerous, and says its address otherwise."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from signimit_envs.studio.shelf import Shelf

PROGRAM = Path(__file__).parents[2] / "scripts" / "studio.py"
PIPES = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
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


@pytest.mark.skipif(sys.platform == "win32", reason="interrupts are sent otherwise here")
def test_it_says_its_address_and_ends_when_it_is_told_to(tmp_path: Path) -> None:
    pytest.importorskip("fastapi", reason="the studio needs signimit[studio]")
    with subprocess.Popen(_command("--folder", str(tmp_path)), **PIPES) as studio:  # type: ignore[call-overload]
        assert studio.stdout.readline().startswith("The studio is at http://127.0.0.1:")
        studio.send_signal(signal.SIGINT)
        _, complaints = studio.communicate(timeout=60)
    assert "Traceback" not in complaints


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system has no kill -9")
def test_what_was_shown_is_there_after_a_kill_minus_nine(tmp_path: Path) -> None:
    pytest.importorskip("fastapi", reason="the studio needs signimit[studio]")
    httpx = pytest.importorskip("httpx")
    stroke = {"points": [[0, 0], [0.1, 0.1], [0.2, 0]], "times": [0, 0.1, 0.2]}
    body = {"revision": 0, "signs": [stroke, stroke], "hand": stroke}
    with subprocess.Popen(_command("--folder", str(tmp_path)), **PIPES) as studio:  # type: ignore[call-overload]
        address = studio.stdout.readline().split()[-1]
        session = httpx.post(f"{address}api/sessions", json={}, trust_env=False).json()["id"]
        where = f"{address}api/sessions/{session}/demonstrations"
        assert httpx.post(where, json=body, timeout=60, trust_env=False).status_code == 200
        studio.kill()
    shelf = Shelf(tmp_path)
    assert [one.hand.points.tolist() for one in shelf.read(session).shown] == [stroke["points"]]
    shelf.close()


def test_the_load_program_prints_what_pages_wait_for() -> None:
    pytest.importorskip("websockets", reason="the studio needs signimit[studio]")
    program = PROGRAM.with_name("studio_load.py")
    command = [sys.executable, str(program), "--sessions", "1", "--answers", "1", "--seconds", "0.2"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    assert [line.partition(":")[0] for line in said] == [
        "update after a demonstration",
        "request to first motion seen",
        "frames/s at 640x480, pages 1",
        "frames/s at 640x480, pages 2",
        "simulated time over time, two pages",
    ]
