"""Measurements see what a page would see."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from signimit_envs.studio.load import measure_speed, resident_memory


@pytest.mark.slow
def test_every_wait_and_every_frame_is_counted(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.web.guard.Bucket.take", lambda self: True)
    monkeypatch.setattr("signimit_envs.studio.load._SETTLE", 0.0)
    speed = measure_speed(address, sessions=1, answers=1, seconds=0.2)
    assert (len(speed.update), len(speed.motion)) == (12, 1)
    assert min(speed.update + speed.motion) > 0
    assert {pages: len(rates) for pages, rates in speed.frames.items()} == {1: 1, 2: 2}
    assert speed.real_time > 0


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="this system does not tell how large a process is")
def test_the_memory_of_a_process_is_told_in_mebibytes() -> None:
    before = resident_memory(os.getpid())
    block = bytearray(os.urandom(64 * 2**20))
    after = resident_memory(os.getpid())
    assert 40 < after.now - before.now < 100
    del block
    assert resident_memory(os.getpid()).highest >= after.highest >= after.now - 1
