"""The studio stands a siege, and the siege would see if it did not."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from signimit_envs.studio.siege.requests import Attack, HostileRequests, Target
from signimit_envs.studio.siege.siege import besiege, fault_of
from signimit_envs.studio.siege.sockets import HostileSockets
from signimit_envs.studio.siege.watched import SECRET, WatchedStudio

ADDRESS = "http://127.0.0.1:8000/secret-token/"
TOUCH = """
import os, shutil, sys, tempfile
from pathlib import Path
from signimit_envs.studio.siege.touched import watch_files

room, elsewhere = map(Path, sys.argv[1:])
for folder in ("studio", "temporary"):
    (room / folder).mkdir()
told = []
watch_files(room, [room / "studio", room / "temporary"], told.append)
Path(room / "studio" / "a").write_text("")
with tempfile.TemporaryDirectory(dir=room / "temporary") as folder:
    Path(folder, "b").write_text("")
Path(sys.executable).stat()
open(os.__file__).close()
assert not told, told
(room / "studio" / ".." / "secret.txt").read_text()
os.listdir(room)
(elsewhere / "made").mkdir()
(elsewhere / "new").write_text("")
os.rename(elsewhere / "new", room / "studio" / "old")
os.remove(room / "touched.txt")
print(*told, sep="\\n")
"""


@pytest.fixture
def target(page: Any, address: str) -> Target:
    """A target that is not there."""
    description = page.browser.get("openapi.json").json()
    return Target(
        ADDRESS, description, "20200101-000000-00000000", {"strokes.csv": b"stroke,label"}, "/secret.txt", 10_000
    )


def test_attacks_are_the_same_every_time_and_of_every_kind(target: Target) -> None:
    requests, sockets = HostileRequests(target, 3), HostileSockets(ADDRESS, 3)
    made = [requests.attack(number) for number in range(300)] + [sockets.attack(number) for number in range(100)]
    again, others = HostileRequests(target, 3), HostileRequests(target, 4)
    assert [again.attack(number) for number in range(20)] == made[:20]
    assert [others.attack(number) for number in range(20)] != made[:20]
    kinds = Counter(attack.kind for attack in made)
    assert set(kinds) == {
        *("route", "headers", "path", "token", "body", "file", "protocol", "chunks", "slow"),
        *("messages", "odd_messages", "sizes", "parts", "controls", "bytes", "flood", "handshake"),
    }
    assert sum(attack.frames for attack in made) > 10_000


def test_attackers_reach_every_route(target: Target) -> None:
    requests = HostileRequests(target, 0)
    lines = [line for number in range(1500) for part in requests.attack(number).parts for line in part.split(b"\r\n")]
    for path, operations in target.description["paths"].items():
        if path.endswith((".mp4", ".jpg", "{suffix}", "similarities")):
            continue  # take the server a second, and are rare
        first = f"/secret-token{path}".replace("{session_id}", target.session).partition("{")[0]
        last = path.rpartition("/")[2].partition("{")[0]
        for method in operations:
            start = f"{method.upper()} {first}".encode()
            assert any(line.startswith(start) and last.encode() in line for line in lines), (method, path)


@pytest.mark.slow
def test_the_studio_stands_a_siege(tmp_path: Path) -> None:
    report = besiege(tmp_path / "room", requests=150, visits=12, seed=0)
    assert report.faults == []
    assert {200, 400, 403, 404, 422} <= set(report.statuses)
    assert report.frames > 1000
    assert 0 < report.before <= report.highest


@pytest.mark.parametrize(
    ("answer", "fault"),
    [
        (b"HTTP/1.1 200 OK\r\n\r\n{}", None),
        (b"HTTP/1.1 404 Not Found\r\n\r\n{}", None),
        (b"HTTP/1.1 500 Internal Server Error\r\n\r\n", "answered with [500]: "),
        (b"HTTP/1.1 200 OK\r\n\r\n{}HTTP/1.1 503 Service Unavailable\r\n\r\n", "answered with [200, 503]: "),
        (b"HTTP/1.1 200 OK\r\n\r\n" + SECRET.encode(), "told what is in a file outside its folder"),
        (b"HTTP/1.1 408 Request Timeout\r\n\r\n", "a whole request was taken for a part of one"),
        (b"", "no answer"),
    ],
)
def test_a_wrong_answer_is_a_fault(answer: bytes, fault: str | None) -> None:
    found = fault_of(Attack("route", (b"GET / HTTP/1.1\r\n\r\n",)), answer)
    assert found == fault or (found or "").startswith(fault or "-")


def test_half_a_request_needs_no_answer() -> None:
    assert fault_of(Attack("slow", (b"GET /",), whole=False), b"") is None


def test_files_that_are_touched_outside_are_told(tmp_path: Path) -> None:
    room, elsewhere = tmp_path / "room", tmp_path / "elsewhere"
    for folder in (room, elsewhere):
        folder.mkdir()
    for file in ("secret.txt", "touched.txt"):
        (room / file).write_text("")
    done = subprocess.run(
        [sys.executable, "-c", TOUCH, str(room), str(elsewhere)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        f"open {room}/secret.txt",
        f"os.listdir {room}",
        f"os.mkdir {elsewhere}/made",
        f"open {elsewhere}/new",
        f"os.rename {elsewhere}/new",
        f"os.remove {room}/touched.txt",
    ]


def test_an_exception_in_the_log_is_told_with_what_was_about_it(tmp_path: Path) -> None:
    studio = WatchedStudio(ADDRESS, 0, tmp_path, tmp_path / "log.txt", tmp_path / "secret.txt")
    studio.log.write_text(
        "refused with 422: signs: Field required; no Exception\nWARNING:  Invalid HTTP request received.\n"
    )
    assert studio.troubles() == []
    failed = ["before", "Traceback (most recent call last):", '  File "a.py", line 1', "ValueError: x"]
    studio.log.write_text("\n".join([*failed, *failed]))
    assert studio.troubles() == ["2 x Traceback (most recent call last):", "2 x ValueError: x", *failed, *failed]


def test_what_is_left_of_temporary_files_is_told(tmp_path: Path) -> None:
    (tmp_path / "temporary" / "film").mkdir(parents=True)
    (tmp_path / "touched.txt").write_text("open /etc/passwd\n")
    studio = WatchedStudio(ADDRESS, 0, tmp_path, tmp_path / "log.txt", tmp_path / "secret.txt")
    assert studio.touched() == ["open /etc/passwd", f"left {tmp_path}/temporary/film"]
