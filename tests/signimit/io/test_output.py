"""Folders of results appear whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from signimit.exceptions import InvalidInputError
from signimit.io.output import whole_files


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
