"""Archives: whole or not at all, the same bytes for the same arrays, and no file can do harm."""

import io
import os
import pickle
import struct
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import FileFormatError
from signimit.io import archive
from signimit.io.archive import read_archive, write_archive

ARRAYS = {"x": np.arange(6.0).reshape(2, 3), "empty": np.zeros((0, 2)), "names": np.array(["ä", "bc"])}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "file.npz"


def written(path: Path, **arrays: NDArray[Any]) -> Path:
    write_archive(path, "thing", 2, arrays or ARRAYS, {"a": [1, "b"]})
    return path


def member(header: str, data: bytes = b"") -> bytes:
    """Return a .npy file with any header one likes."""
    text = header.encode() + b"\n"
    return b"\x93NUMPY\x02\x00" + struct.pack("<I", len(text)) + text + data


def array_of(descr: str, shape: str, data: bytes = b"") -> bytes:
    """Return a .npy file of any promised type and shape."""
    return member(f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}}}", data)


def replaced(path: Path, name: str, content: bytes, compression: int = zipfile.ZIP_DEFLATED) -> Path:
    """Put one member of one's own into a written archive."""
    with zipfile.ZipFile(written(path)) as source:
        members = {n: source.read(n) for n in source.namelist()} | {name: content}
    with zipfile.ZipFile(path, "w", compression) as target:
        for key, value in members.items():
            target.writestr(key, value)
    return path


def test_what_was_written_is_read(path: Path) -> None:
    arrays, meta = read_archive(written(path), "thing", 2)
    assert meta == {"a": [1, "b"]}
    assert list(arrays) == list(ARRAYS)
    for name, array in ARRAYS.items():
        assert arrays[name].dtype == array.dtype
        np.testing.assert_array_equal(arrays[name], array)


def test_numpy_reads_the_file_without_pickles(path: Path) -> None:
    with np.load(written(path), allow_pickle=False) as file:
        np.testing.assert_array_equal(file["x"], ARRAYS["x"])


def test_the_same_arrays_give_the_same_bytes(tmp_path: Path) -> None:
    assert written(tmp_path / "a.npz").read_bytes() == written(tmp_path / "b.npz").read_bytes()


def test_a_failed_write_leaves_the_old_file_and_nothing_else(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = written(path).read_bytes()

    def fail(*_: Any, **__: Any) -> None:
        raise KeyboardInterrupt

    with pytest.raises(ValueError, match="Object arrays"):
        written(path, x=np.array([object()]))
    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(KeyboardInterrupt):
        written(path, x=np.zeros(3))
    assert path.read_bytes() == before
    assert os.listdir(path.parent) == [path.name]


def test_a_written_file_has_the_rights_that_any_new_file_has(path: Path) -> None:
    path.with_name("other").write_bytes(b"")
    assert written(path).stat().st_mode == path.with_name("other").stat().st_mode


def test_a_missing_folder_or_file_is_the_systems_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        written(tmp_path / "nowhere" / "x.npz")
    with pytest.raises(FileNotFoundError):
        read_archive(tmp_path / "nothing.npz", "thing", 1)
    with pytest.raises(OSError, match="directory"):
        written(tmp_path)


@pytest.mark.parametrize(
    ("kind", "version", "sentence"),
    [
        ("other", 2, "expected a signimit other file of version <= 2, found thing version 2."),
        ("thing", 1, "expected a signimit thing file of version <= 1, found thing version 2."),
    ],
)
def test_another_kind_and_a_newer_version_are_told_apart(path: Path, kind: str, version: int, sentence: str) -> None:
    with pytest.raises(FileFormatError) as caught:
        read_archive(written(path), kind, version)
    assert str(caught.value) == f"{path}: {sentence}"


@pytest.mark.parametrize(
    "content",
    [b"", b"PK", b"nonsense " * 100, pickle.dumps({"x": 1}), b"PK\x05\x06" + bytes(18)],
    ids=["empty", "two bytes", "text", "pickle", "zip without members"],
)
def test_a_foreign_file_is_refused_in_one_sentence(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match="expected a signimit thing file of version <= 2, found something unread"):
        read_archive(path, "thing", 2)


def test_a_file_cut_off_anywhere_is_refused(path: Path) -> None:
    whole = written(path).read_bytes()
    for length in range(0, len(whole), 7):
        path.write_bytes(whole[:length])
        with pytest.raises(FileFormatError):
            read_archive(path, "thing", 2)


def test_a_damaged_file_is_read_right_or_refused(path: Path) -> None:
    whole, rng = written(path).read_bytes(), np.random.default_rng(0)
    for position in rng.integers(0, len(whole), 300):
        damaged = bytearray(whole)
        damaged[position] ^= int(rng.integers(1, 256))
        path.write_bytes(damaged)
        try:
            arrays, _ = read_archive(path, "thing", 2)
        except FileFormatError:
            continue
        assert all((arrays[n] == ARRAYS[n]).all() for n in arrays if n in ARRAYS)


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("x.npy", array_of("|O", "(1,)", b"x" * 80), "plain numbers"),
        ("x.npy", array_of("<f8", "(10**15,)"), "unreadable"),
        ("x.npy", array_of("<f8", "(1000000000000,)"), "plain numbers"),
        ("x.npy", array_of("<U0", "(1000000000000,)"), "plain numbers"),
        ("x.npy", array_of("<f8", "(-1,)", bytes(8)), "unreadable"),
        ("x.npy", array_of("<f8", "(4,)", bytes(8)), "unreadable"),
        ("x.npy", member("-" * 9000 + "1"), "unreadable"),
        ("x.npy", member("(" * 9000), "unreadable"),
        ("x.npy", member("__import__('os').getcwd()"), "unreadable"),
        ("x.npy", pickle.dumps([1]), "unreadable"),
        ("readme.txt", b"hello", "unreadable"),
        ("signimit.npy", array_of("|S3", "()", b"[1]"), "unreadable"),
    ],
)  # fmt: skip
def test_a_hostile_member_is_refused(path: Path, name: str, content: bytes, sentence: str) -> None:
    with pytest.raises(FileFormatError, match=sentence):
        read_archive(replaced(path, name, content), "thing", 2)


@pytest.mark.parametrize(
    "header",
    ["[]", "3", '{"kind": "thing"}', '{"kind": "thing", "version": "2", "meta": {}}', "[" * 5000, "not json",
     '{"kind": "thing", "version": 2, "meta": []}'],
)  # fmt: skip
def test_a_header_that_says_something_else_is_refused(path: Path, header: str) -> None:
    stream = io.BytesIO()
    np.save(stream, np.array(header))
    with pytest.raises(FileFormatError, match="unreadable"):
        read_archive(replaced(path, "signimit.npy", stream.getvalue()), "thing", 2)


def test_a_file_without_header_is_refused(path: Path) -> None:
    np.savez(path, x=np.zeros(3))
    with pytest.raises(FileFormatError, match="unreadable"):
        read_archive(path, "thing", 2)


def test_a_zip_bomb_is_refused_unread(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(archive, "MAX_BYTES", 10_000)
    with pytest.raises(FileFormatError, match=r"expected at most 10000 bytes unpacked, found [0-9]+\."):
        read_archive(written(path, x=np.zeros(10_000)), "thing", 2)


def test_a_crowd_of_members_is_refused_unread(path: Path) -> None:
    with zipfile.ZipFile(path, "w") as file:
        for i in range(archive.MAX_ARRAYS + 1):
            file.writestr(f"{i}.npy", b"")
    with pytest.raises(FileFormatError, match="expected at most 1000 arrays, found 1001"):
        read_archive(path, "thing", 2)


@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_damage_in_any_compression_is_refused(path: Path, compression: int) -> None:
    whole = replaced(path, "x.npy", array_of("<f8", "(9,)", bytes(72)),
                     compression).read_bytes()  # fmt: skip
    for position in range(30, len(whole) // 2, 5):
        path.write_bytes(whole[:position] + b"\xff" * 8 + whole[position + 8 :])
        try:
            read_archive(path, "thing", 2)
        except FileFormatError:
            continue


@pytest.mark.parametrize("point", [0x110000, 0xFFFFFFFF, 0xD800, 0xDFFF])
@pytest.mark.parametrize("order", ["<", ">"])
def test_text_of_characters_that_there_are_not_is_refused(path: Path, point: int, order: str) -> None:
    """Numpy would raise a SystemError when such an element is read; half a character could not be printed."""
    text = array_of(f"{order}U1", "(2,)", struct.pack(f"{order}II", 0x41, point))
    with pytest.raises(FileFormatError, match=r"names\.npy: expected text in Unicode"):
        read_archive(replaced(path, "names.npy", text), "thing", 2)


def test_meta_with_half_a_character_is_refused(path: Path) -> None:
    write_archive(path, "thing", 1, {}, {"a": "\ud800"})  # JSON writes it in ASCII
    with pytest.raises(FileFormatError, match="UnicodeEncodeError"):
        read_archive(path, "thing", 2)


@pytest.mark.parametrize("shape", ["(1000000000000, 0)", "(0, 1000000000000)", "(1000000000000,)"])
def test_a_shape_that_its_bytes_cannot_tell_is_refused(path: Path, shape: str) -> None:
    """Rows of nothing take no bytes; as a list they would take all there are."""
    with pytest.raises(FileFormatError, match="expected at most"):
        read_archive(replaced(path, "x.npy", array_of("|b1", shape)), "thing", 2)


@pytest.mark.parametrize("version", [0, -1])
def test_versions_begin_at_1(path: Path, version: int) -> None:
    write_archive(path, "thing", version, {})
    with pytest.raises(FileFormatError, match=f"found thing version {version}"):
        read_archive(path, "thing", 2)


def test_a_size_that_the_compressed_bytes_cannot_tell_is_refused(path: Path) -> None:
    """What the directory of an archive promises is allocated before it is read."""
    raw = bytearray(written(path).read_bytes())
    for at in range(len(raw)):
        if raw[at : at + 4] == b"PK\x01\x02":
            raw[at + 24 : at + 28] = struct.pack("<I", 2**27)
    path.write_bytes(raw)
    with pytest.raises(FileFormatError, match="expected an entry of its own size"):
        read_archive(path, "thing", 2)
