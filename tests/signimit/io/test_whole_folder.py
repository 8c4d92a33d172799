"""A folder is there whole or not at all, and only a data set of the same kind is ever replaced."""

from __future__ import annotations

from pathlib import Path

import pytest

import signimit as si
from signimit.io.whole_folder import whole_folder


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
    with pytest.raises(
        si.InvalidInputError, match=r"no data set of that name yet \(overwrite replaces it\), found one"
    ):
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
    with pytest.raises(si.InvalidInputError, match="expected nothing of that name yet, found something"):
        filled(target, "one", overwrite=True)
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
