"""The program refuses what would be dangerous, and says its address otherwise."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from signimit_envs.studio.web.serving import StudioPlan, running_studio

PIPES = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
pytest.importorskip("tyro", reason="the programs need signimit[scripts]")


def test_others_are_let_in_only_by_who_knows(run: Any, tmp_path: Path) -> None:
    said = run.refusal("studio", "--no-open", "--host", "0.0.0.0", "--folder", tmp_path)
    assert said.startswith("studio: --host: expected 127.0.0.1, or --i-know beside it")


@pytest.mark.slow
def test_an_interrupt_ends_it_quietly_and_what_was_drawn_is_there_when_it_is_opened_again(tmp_path: Path) -> None:
    pytest.importorskip("fastapi", reason="the studio needs signimit[studio]")
    httpx = pytest.importorskip("httpx")
    stroke = {"points": [[0, 0], [0.1, 0.1], [0.2, 0]], "times": [0, 0.1, 0.2]}
    body = {"revision": 0, "signs": [stroke, stroke], "hand": stroke}
    draft = {"revision": 1, "drawn": {"sign 1": [stroke]}}
    command = [sys.executable, "-m", "signimit", "studio", "--no-open", "--folder", str(tmp_path)]
    with subprocess.Popen(command, **PIPES) as studio:  # type: ignore[call-overload]
        address = studio.stdout.readline().split()[-1]
        session = httpx.post(f"{address}api/sessions", json={}, trust_env=False).json()["id"]
        where = f"{address}api/sessions/{session}/demonstrations"
        assert address.startswith("http://127.0.0.1:")
        assert httpx.post(where, json=body, timeout=60, trust_env=False).status_code == 200
        where = f"{address}api/sessions/{session}/draft"
        assert httpx.put(where, json=draft, timeout=60, trust_env=False).status_code == 200
        studio.send_signal(signal.SIGINT)
        _, complaints = studio.communicate(timeout=60)
    assert "Traceback" not in complaints
    with running_studio(StudioPlan(folder=tmp_path)) as address:
        kept = httpx.get(f"{address}api/sessions/{session}/demonstrations/0", timeout=60, trust_env=False).json()
        assert kept["hand"] == stroke
        again = httpx.get(f"{address}api/sessions/{session}", timeout=60, trust_env=False).json()
        assert again["draft"] == {"number": None, "drawn": {"sign 1": [stroke]}}
