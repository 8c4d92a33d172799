"""The studio as a process: its address, its end, what is missing, and a session that plays itself."""

from __future__ import annotations

import asyncio
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from signimit import InvalidInputError
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit_envs.studio.demo import play_session
from signimit_envs.studio.store.history import History
from signimit_envs.studio.studio import Studio
from signimit_envs.studio.web.serving import StudioPlan, running_studio

httpx = pytest.importorskip("httpx")
WITHOUT = """
import sys
from pathlib import Path
from signimit_envs.studio.web.serving import StudioPlan, running_studio
for package in ("uvicorn", "websockets", "fastapi"):
    known, sys.modules[package] = sys.modules.get(package), None
    try:
        with running_studio(StudioPlan(folder=Path(sys.argv[1]))):
            pass
    except ImportError as error:
        print(error)
    del sys.modules[package]
    if known is not None:
        sys.modules[package] = known
"""


def test_a_session_goes_on_when_the_studio_is_opened_again_with_another_long_token(tmp_path: Path) -> None:
    with running_studio(StudioPlan(folder=tmp_path, seed=1)) as address:
        made = httpx.post(f"{address}api/sessions", json={}, trust_env=False).json()
    with running_studio(StudioPlan(folder=tmp_path, seed=1)) as again:
        tokens = {where.rstrip("/").rpartition("/")[2] for where in (address, again)}
        assert len(tokens) == 2
        assert min(map(len, tokens)) >= 32
        assert httpx.get(f"{again}api/sessions/{made['id']}", trust_env=False).json() == made


def test_the_studio_listens_on_this_machine_only(address: str) -> None:
    assert address.startswith("http://127.0.0.1:")
    port = int(address.split(":")[2].partition("/")[0])
    with pytest.raises(OSError, match=r".*"), socket.create_connection(("127.0.0.2", port), 1):
        pass


def test_a_port_that_is_taken_is_said(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with (
            pytest.raises(InvalidInputError, match=r"address: expected one of this machine's, with a free port"),
            running_studio(StudioPlan(folder=tmp_path, port=port)),
        ):
            pass


@pytest.mark.slow
def test_a_missing_package_is_named_with_what_to_type(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", WITHOUT, str(tmp_path)]
    said = subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout
    assert said.splitlines() == [
        f"The studio needs {package}: {sys.executable} -m pip install 'signimit[studio]'."
        for package in ("uvicorn", "websockets", "fastapi")
    ]


@pytest.mark.slow
def test_a_session_can_play_itself(tmp_path: Path) -> None:
    async def play() -> History:
        studio = Studio(tmp_path)
        studio.start()
        try:
            await play_session(studio, 7, pace=0.02)
            assert studio.demo is not None
            return (await studio.open(studio.demo)).history
        finally:
            await asyncio.to_thread(studio.close)

    played = asyncio.run(play())
    assert len(played.shown) == 12
    assert [given.asked.request for given in played.answers] == sorted(PAPER_LANGUAGE.held_back)
    for given in played.answers:
        assert given.asked.request is not None
        assert given.asked.focus == given.asked.request.focus
        assert given.good is not None
