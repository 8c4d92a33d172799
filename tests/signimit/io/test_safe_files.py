"""Files and folders are there whole or not at all; of a file that grows, every acknowledged line is on the disk."""

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

from signimit import FileFormatError, InvalidInputError
from signimit.io.safe_files import append_record, read_records, replaced_file, whole_files, whole_folder


def test_the_old_file_stays_until_the_new_one_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(b"old")
    with replaced_file(path) as file:
        file.write(b"new")
        assert path.read_bytes() == b"old"
    assert path.read_bytes() == b"new"
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_nothing_is_left_of_a_failed_file(tmp_path: Path) -> None:
    def fail() -> None:
        with replaced_file(tmp_path / "a.txt") as file:
            file.write(b"half")
            raise RuntimeError("power cut")

    with pytest.raises(RuntimeError, match="power cut"):
        fail()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["nowhere/a.txt", "folder"])
def test_a_place_where_no_file_can_be_is_named_as_the_caller_named_it(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError, match="directory") as error, replaced_file(tmp_path / name):
        pass
    assert error.value.filename == str(tmp_path / name)
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_files_are_there_after_the_last_one_is_written(tmp_path: Path) -> None:
    out = tmp_path / "a" / "b"
    with whole_files(out) as folder:
        (folder / "x.txt").write_text("new")
        assert not out.exists()
    assert (out / "x.txt").read_text() == "new"
    assert [p.name for p in out.parent.iterdir()] == ["b"]


def test_files_of_the_same_name_are_replaced_and_others_stay(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "x.txt").write_text("old")
    (tmp_path / "out" / "y.txt").write_text("other")
    with whole_files(tmp_path / "out") as folder:
        (folder / "x.txt").write_text("new")
    assert (tmp_path / "out" / "x.txt").read_text() == "new"
    assert (tmp_path / "out" / "y.txt").read_text() == "other"


def test_nothing_is_left_when_writing_fails(tmp_path: Path) -> None:
    def write() -> None:
        with whole_files(tmp_path / "out") as folder:
            (folder / "x.txt").write_text("half")
            raise RuntimeError("stop")

    with pytest.raises(RuntimeError, match="stop"):
        write()
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_the_way_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine")
    with pytest.raises(InvalidInputError, match="expected a folder"), whole_files(tmp_path / "out"):
        pass
    assert (tmp_path / "out").read_text() == "mine"


def test_no_folder_is_left_when_writing_deep_down_fails(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="stop"), whole_files(tmp_path / "a" / "b"):
        raise RuntimeError("stop")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_made_is_named_as_the_caller_named_it(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("mine")
    with pytest.raises(OSError, match="Not a directory") as error, whole_files(tmp_path / "a" / "b"):
        pass
    assert error.value.filename == str(tmp_path / "a" / "b")


def filled(target: Path, text: str, overwrite: bool = False) -> None:
    with whole_folder(target, "marker.txt", overwrite) as draft:
        (draft / "marker.txt").write_text(text)
        (draft / "deep").mkdir()
        (draft / "deep" / "file").write_text(text)


def test_a_folder_appears_with_everything_in_it_and_nothing_beside_it(tmp_path: Path) -> None:
    filled(tmp_path / "new" / "set", "one")
    assert (tmp_path / "new" / "set" / "deep" / "file").read_text() == "one"
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["set"]


def test_what_breaks_off_leaves_nothing_and_loses_nothing(tmp_path: Path) -> None:
    filled(tmp_path / "set", "one")

    def break_off(target: Path) -> None:
        with whole_folder(target, "marker.txt", overwrite=True) as draft:
            (draft / "marker.txt").write_text("two")
            raise KeyboardInterrupt

    for name in ("set", "other"):
        with pytest.raises(KeyboardInterrupt):
            break_off(tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == ["set"]
    assert (tmp_path / "set" / "marker.txt").read_text() == "one"


def test_a_data_set_is_replaced_only_on_request_and_then_entirely(tmp_path: Path) -> None:
    filled(tmp_path / "set", "one")
    (tmp_path / "set" / "old file").write_text("")
    with pytest.raises(InvalidInputError, match=r"no data set of that name yet \(overwrite replaces it\), found one"):
        filled(tmp_path / "set", "two")
    filled(tmp_path / "set", "two", overwrite=True)
    assert sorted(path.name for path in (tmp_path / "set").iterdir()) == ["deep", "marker.txt"]
    assert [path.name for path in tmp_path.iterdir()] == ["set"]


@pytest.mark.parametrize("kind", ["file", "folder", "link"])
def test_what_is_no_such_data_set_is_never_replaced(tmp_path: Path, kind: str) -> None:
    target = tmp_path / "mine"
    if kind == "file":
        target.write_text("precious")
    elif kind == "folder":
        target.mkdir()
        (target / "precious").write_text("")
    else:
        target.symlink_to(tmp_path / "nowhere")
    with pytest.raises(InvalidInputError, match="expected nothing of that name yet, found something"):
        filled(target, "one", overwrite=True)
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]


WRITER = """
import sys
from pathlib import Path
from signimit.io.safe_files import append_record
for number in range(100000):
    append_record(Path(sys.argv[1]), {"number": number, "filler": "x" * 5000})
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
    numbers = [line["number"] for line in read_records(journal)]
    assert numbers == list(range(len(numbers)))
    assert acknowledged < len(numbers) <= acknowledged + 2
    append_record(journal, {"number": len(numbers)})
    assert [line["number"] for line in read_records(journal)][-1] == len(numbers)


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
            append_record(journal, line)
            ends.append(journal.stat().st_size)
        cut = data.draw(st.integers(0, ends[-1]))
        os.truncate(journal, cut)
        whole = sum(end <= cut for end in ends[1:])
        assert read_records(journal) == lines[:whole]
        append_record(journal, lines[0])
        assert read_records(journal) == [*lines[:whole], lines[0]]


def test_a_long_line_without_an_end_gives_way_to_the_next(tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    append_record(journal, {"a": 1})
    with open(journal, "ab") as file:
        file.write(b'{"b": "' + b"x" * 300_000)
    assert read_records(journal) == [{"a": 1}]
    append_record(journal, {"a": 2})
    assert read_records(journal) == [{"a": 1}, {"a": 2}]


def test_numbers_that_json_cannot_say_are_refused_and_leave_nothing(tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    append_record(journal, {"a": 1})
    with pytest.raises(ValueError, match="JSON"):
        append_record(journal, {"a": float("nan")})
    assert read_records(journal) == [{"a": 1}]


def test_a_full_disk_does_not_spoil_what_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = tmp_path / "journal"
    append_record(journal, {"a": 1})

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OSError, match="No space left"):
            append_record(journal, {"a": 2})
    append_record(journal, {"a": 3})
    assert read_records(journal) == [{"a": 1}, {"a": 3}]


def test_what_a_full_disk_did_not_take_of_a_line_is_not_written_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Room for a part of a line: a buffered file would write the rest of it when it is closed, behind the cut."""
    resource = pytest.importorskip("resource")
    journal = tmp_path / "journal"
    append_record(journal, {"a": 1})
    before, most = journal.read_bytes(), resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) + 5, most[1]))
    try:
        with pytest.raises(OSError, match="File too large") as error:
            append_record(journal, {"a": "x" * 1000})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, most)
    assert error.value.filename == str(journal)
    assert journal.read_bytes() == before


def test_a_full_disk_is_told_with_the_name_that_the_caller_gave(tmp_path: Path) -> None:
    def fill() -> None:
        with replaced_file(tmp_path / "a.txt"):
            raise OSError(28, "No space left on device")  # as a write says it, without a name

    with pytest.raises(OSError, match="No space left") as error:
        fill()
    assert error.value.filename == str(tmp_path / "a.txt")


def test_an_error_about_another_file_keeps_its_name(tmp_path: Path) -> None:
    def read() -> None:
        with replaced_file(tmp_path / "a.txt"):
            (tmp_path / "other.txt").read_bytes()

    with pytest.raises(FileNotFoundError) as error:
        read()
    assert error.value.filename == str(tmp_path / "other.txt")


@pytest.mark.skipif(sys.platform not in ("linux", "darwin"), reason="folders are replaced by two renames there")
def test_a_data_set_is_never_missing_while_it_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two folders change names at once: whoever is killed between two renames would leave none."""
    filled(tmp_path / "set", "one")
    renames: list[object] = []
    monkeypatch.setattr(os, "rename", lambda *names: renames.append(names))
    filled(tmp_path / "set", "two", overwrite=True)
    assert (tmp_path / "set" / "marker.txt").read_text() == "two"
    assert [path.name for path in tmp_path.iterdir()] == ["set"]
    assert renames == []


def test_where_folders_cannot_be_exchanged_they_are_renamed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit.io.safe_files._exchanged", lambda *folders: False)
    filled(tmp_path / "set", "one")
    filled(tmp_path / "set", "two", overwrite=True)
    assert (tmp_path / "set" / "marker.txt").read_text() == "two"
    assert [path.name for path in tmp_path.iterdir()] == ["set"]


@pytest.mark.parametrize("line", [b"[1]\n", b"nonsense\n", b"\xff\xfe\n", b"[" * 100_000 + b"\n"])
def test_a_line_of_something_else_is_named(line: bytes, tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    journal.write_bytes(b'{"a": 1}\n' + line)
    with pytest.raises(FileFormatError, match="line 2: expected a JSON object"):
        read_records(journal)
