"""Writers are killed, and have no room or no rights: nothing that was saved is lost, nothing is read half."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from signimit.io.safe_files import replaced_file
from signimit_envs.robustness import killing
from signimit_envs.robustness.killing import WRITERS, Writer, kill_writer
from signimit_envs.robustness.no_room import try_without_room

KILLS = 2  # of each writer; `python -m signimit fuzz kill` does it 200 times
EXTRAS = {"minari": ("minari", "h5py"), "lerobot": ("pyarrow",), "inkml": ("defusedxml",)}
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")


def need_extras(name: str) -> None:
    """Skip where the packages of a format are not installed."""
    for package in EXTRAS.get(name, ()):
        pytest.importorskip(package)


@pytest.mark.parametrize("name", WRITERS)
def test_what_was_reported_as_saved_outlives_the_writer(name: str) -> None:
    need_extras(name)
    outcome = kill_writer(name, KILLS, seed=1)
    assert outcome.losses == ()
    assert outcome.saved >= KILLS


@pytest.mark.parametrize("name", WRITERS)
def test_without_room_or_rights_there_is_one_sentence_and_the_old_version(name: str) -> None:
    need_extras(name)
    trials = list(try_without_room(name))
    assert [trial for trial in trials if not trial.good] == []
    assert len(trials) >= 2


def _write_carelessly(folder: Path, version: int) -> None:
    with open(folder / "number", "w") as file:
        for _ in range(2000):
            file.write(f"{version}\n")
            file.flush()


def _write_carefully(folder: Path, version: int) -> None:
    with replaced_file(folder / "number") as file:
        file.write(f"{version}\n".encode() * 2000)


def _version(folder: Path) -> int:
    lines = (folder / "number").read_text().splitlines()
    if len(lines) != 2000 or len(set(lines)) != 1:
        raise ValueError("half a file")
    return int(lines[0])


@pytest.mark.parametrize(("write", "careful"), [(_write_carelessly, False), (_write_carefully, True)])
def test_a_writer_that_loses_something_is_noticed(
    write: Callable[[Path, int], None], careful: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(killing, "WRITERS", {"number": Writer(write, _version)})
    assert (kill_writer("number", 6, seed=2).losses == ()) is careful
