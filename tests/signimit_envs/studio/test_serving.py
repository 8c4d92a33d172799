"""The studio as a process: its address, its end, what is missing, and a session that plays itself."""

from __future__ import annotations

import asyncio
import socket
import sys
from pathlib import Path

import pytest

from signimit import InvalidInputError, MissingDependencyError
from signimit.languages import PAPER_LANGUAGE
from signimit_envs.studio.demo import play_session
from signimit_envs.studio.serving import StudioPlan, running_studio
from signimit_envs.studio.studio import Studio

httpx = pytest.importorskip("httpx")


def test_a_session_goes_on_when_the_studio_is_opened_again(tmp_path: Path) -> None:
    with running_studio(StudioPlan(folder=tmp_path, seed=1)) as address:
        made = httpx.post(f"{address}api/sessions", json={}, trust_env=False).json()
    with running_studio(StudioPlan(folder=tmp_path, seed=1)) as again:
        assert again != address
        assert httpx.get(f"{again}api/sessions/{made['id']}", trust_env=False).json() == made


def test_the_token_is_long_and_new_every_time(tmp_path: Path) -> None:
    tokens = set()
    for _ in range(2):
        with running_studio(StudioPlan(folder=tmp_path)) as address:
            tokens.add(address.rstrip("/").rpartition("/")[2])
    assert len(tokens) == 2
    assert min(map(len, tokens)) >= 32


def test_the_studio_listens_on_this_machine_only(tmp_path: Path) -> None:
    with running_studio(StudioPlan(folder=tmp_path)) as address:
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


@pytest.mark.parametrize("package", ["uvicorn", "websockets", "fastapi"])
def test_a_missing_package_is_named_with_what_to_type(
    package: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    for module in [name for name in sys.modules if name.startswith("signimit_envs.studio.")]:
        if module.rpartition(".")[2] not in ("serving", "guard", "limits"):
            monkeypatch.delitem(sys.modules, module)
    with (
        pytest.raises(MissingDependencyError, match=rf"The studio needs {package}: pip install 'signimit\[studio\]'"),
        running_studio(StudioPlan(folder=tmp_path)),
    ):
        pass


def test_a_session_can_play_itself(tmp_path: Path) -> None:
    async def play() -> tuple[list[int], list[object]]:
        studio = Studio(tmp_path)
        studio.start()
        try:
            await play_session(studio, 7, pace=0.02)
            assert studio.demo is not None
            session = await studio.open(studio.demo)
            answers = session.history.answers
            return [len(session.history.shown)], [(a.asked.focus, a.asked.request, a.good) for a in answers]
        finally:
            await asyncio.to_thread(studio.close)

    count, answers = asyncio.run(play())
    assert count == [12]
    assert [(focus, request) for focus, request, _ in answers] == [  # type: ignore[misc]
        (request.focus, request) for request in sorted(PAPER_LANGUAGE.held_back)
    ]
    assert all(good is not None for _, _, good in answers)  # type: ignore[misc]
