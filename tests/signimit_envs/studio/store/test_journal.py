"""What was acknowledged is on the disk, whatever happens to the process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit import FileFormatError
from signimit_envs.studio.store.journal import append_line, mend, read_lines

WRITER = """
import sys
from pathlib import Path
from signimit_envs.studio.store.journal import append_line
for number in range(100000):
    append_line(Path(sys.argv[1]), {"number": number, "filler": "x" * 5000})
    print(number, flush=True)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system has no kill -9")
def test_kill_minus_nine_loses_at_most_the_line_being_written(tmp_path: Path) -> None:
    journal = tmp_path / "journal.jsonl"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", WRITER, str(journal)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as writer:
        assert writer.stdout is not None
        for _ in range(40):
            acknowledged = int(writer.stdout.readline())
        writer.kill()
        acknowledged = max([acknowledged, *(int(line) for line in writer.stdout.read().split())])
    mend(journal)
    numbers = [line["number"] for line in read_lines(journal)]
    assert numbers == list(range(len(numbers)))
    assert acknowledged < len(numbers) <= acknowledged + 2
    append_line(journal, {"number": len(numbers)})
    assert [line["number"] for line in read_lines(journal)][-1] == len(numbers)


LINES = st.lists(st.dictionaries(st.sampled_from("ab"), st.text('x\n"{', max_size=200)), min_size=1, max_size=4)


@settings(deadline=None, max_examples=20)
@given(LINES, st.data())
def test_wherever_a_journal_breaks_off_all_whole_lines_are_read(
    lines: list[dict[str, str]], data: st.DataObject
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        journal = Path(folder) / "journal"
        ends = [0]
        for line in lines:
            append_line(journal, line)
            ends.append(journal.stat().st_size)
        cut = data.draw(st.integers(0, ends[-1]))
        os.truncate(journal, cut)
        whole = sum(end <= cut for end in ends[1:])
        assert list(read_lines(journal)) == lines[:whole]
        mend(journal)
        assert journal.stat().st_size == ends[whole]


def test_a_long_line_without_an_end_is_cut_off_too(tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    append_line(journal, {"a": 1})
    with open(journal, "ab") as file:
        file.write(b'{"b": "' + b"x" * 300_000)
    mend(journal)
    assert list(read_lines(journal)) == [{"a": 1}]


def test_numbers_that_json_cannot_say_are_refused_and_leave_nothing(tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    append_line(journal, {"a": 1})
    with pytest.raises(ValueError, match="JSON"):
        append_line(journal, {"a": float("nan")})
    assert list(read_lines(journal)) == [{"a": 1}]


def test_a_full_disk_does_not_spoil_what_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = tmp_path / "journal"
    append_line(journal, {"a": 1})

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OSError, match="No space left"):
            append_line(journal, {"a": 2})
    append_line(journal, {"a": 3})
    assert list(read_lines(journal)) == [{"a": 1}, {"a": 3}]


@pytest.mark.parametrize("line", [b"[1]\n", b"nonsense\n", b"\xff\xfe\n", b"[" * 100_000 + b"\n"])
def test_a_line_of_something_else_is_named(line: bytes, tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    journal.write_bytes(b'{"a": 1}\n' + line)
    with pytest.raises(FileFormatError, match="line 2: expected a JSON object"):
        list(read_lines(journal))
