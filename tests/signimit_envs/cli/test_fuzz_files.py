"""The command line of the fuzzer: what it counts, what it says, and how it ends."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from signimit.exceptions import MissingDependencyError
from signimit_envs.cli import main
from signimit_envs.robustness.loaders import LOADERS, Loader

pytest.importorskip("tyro", reason="commands need signimit[scripts]")
POLICIES = "signimit.policies.load_policy"


def test_every_file_is_counted(capsys: pytest.CaptureFixture[str]) -> None:
    main(["fuzz", "files", "--files", "7", "--loader", "load_policy", "csv_demonstrations", "--workers", "1"])
    lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    assert lines[0] == ["loader", "files", "read and used", "refused", "faults"]
    for _, files, read, refused, faults in lines[2:]:
        assert int(files) == int(read) + int(refused) + int(faults)
    assert [line[0] for line in lines[2:]] == [POLICIES, next(name for name in LOADERS if "csv_dem" in name), "all"]
    assert lines[-1][1] == "14"


def _sample(folder: Path) -> Iterator[Path]:
    (folder / "number.csv").write_text("17")
    yield folder / "number.csv"


def test_faults_are_printed_and_end_the_command_with_1(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setitem(LOADERS, "a.loader", Loader(_sample, lambda path: int(path.read_bytes()), repr))
    with pytest.raises(SystemExit) as stop:
        main(["fuzz", "files", "--files", "20", "--loader", "a.loader", "--keep", str(tmp_path)])
    assert stop.value.code == 1
    assert "a.loader, file " in capsys.readouterr().out
    assert any(tmp_path.iterdir())


def test_a_loader_without_its_package_is_left_out_and_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def lacking(path: Path) -> None:
        raise MissingDependencyError("a", "b", "This")

    monkeypatch.setitem(LOADERS, "load_policy.too", Loader(_sample, lacking, repr))
    main(["fuzz", "files", "--files", "3", "--loader", "load_policy"])
    said = capsys.readouterr()
    assert "note: load_policy.too is left out. This needs a" in said.err
    assert "load_policy.too" not in said.out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["files", "--loader", "nothing"], "Unknown loader 'nothing'; known are signimit."),
        (["files", "--files", "0"], "files, workers: expected at least 1 of each, found 0, 2."),
        (["kill", "--writer", "nothing"], "Unknown writer 'nothing'; known are model"),
        (["no-room", "--writer", "nothing"], "Unknown writer 'nothing'; known are model"),
    ],
)
def test_what_there_is_not_is_refused(arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["fuzz", *arguments])
    assert stop.value.code == 2
    assert sentence in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_writers_are_killed_and_have_no_room(capsys: pytest.CaptureFixture[str]) -> None:
    main(["fuzz", "kill", "--times", "2", "--writer", "strokes"])
    assert "strokes: killed 2 times" in capsys.readouterr().out
    main(["fuzz", "no-room", "--writer", "strokes"])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) >= 2
    assert all(line.startswith("ok     strokes, ") for line in lines)
