"""Files of named arrays: ``.npz`` without pickles, written whole or not at all, with a format version."""

from __future__ import annotations

import json
import math
import os
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.display import one_line
from signimit.exceptions import FileFormatError
from signimit.io.safe_files import replaced_file

MAX_BYTES = 2 * 2**30  # an archive that unpacks to more is taken for hostile
MAX_ARRAYS = 1000  # so is one with more entries
MAX_RATIO = 1100  # of an entry's size to its compressed size; deflate reaches 1032
_HEADER = "signimit"
_LAST_CHARACTER, _SURROGATES = 0x10FFFF, 0xD800 >> 11  # code points beyond and among which there are no characters


@one_line
class Archive(NamedTuple):
    """What a file holds: arrays by name, and a small JSON object."""

    arrays: dict[str, NDArray[Any]]
    meta: dict[str, Any]


def write_archive(
    path: str | os.PathLike[str],
    kind: str,
    version: int,
    arrays: Mapping[str, NDArray[Any]],
    meta: Mapping[str, Any] | None = None,
) -> None:
    """Write arrays beside ``path``, then rename: a reader sees the old file or the new one.

    The same arrays give the same bytes (zip entries carry a fixed date).

    Args:
        path: File to make or replace; missing folders are not made.
        kind: What the file is, checked by `read_archive`.
        version: Version of that kind's layout.
        arrays: Arrays by name; object arrays are refused by numpy.
        meta: Anything JSON can say.

    Raises:
        OSError: If the file cannot be written; what was there before is then untouched.
    """
    header = json.dumps({"kind": kind, "version": version, "meta": dict(meta or {})}, sort_keys=True)
    entries = {_HEADER: np.array(header), **arrays}
    with replaced_file(path) as file, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in entries.items():
            info = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
            info.compress_type = zipfile.ZIP_DEFLATED
            with archive.open(info, "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(array), allow_pickle=False)


def read_archive(path: str | os.PathLike[str], kind: str, version: int) -> Archive:
    """Read what `write_archive` wrote.

    Args:
        path: File to read.
        kind: The kind the caller wants.
        version: Newest layout the caller understands.

    Raises:
        OSError: If there is no such file, or it may not be read.
        FileFormatError: If it is truncated, foreign, of another kind or newer than ``version``.
    """
    where = os.fspath(path)
    wanted = f"a signimit {kind} file of version <= {version}"
    try:
        with zipfile.ZipFile(where) as archive:
            _refuse_bombs(archive, where)
            arrays = {Path(name).stem: _member(archive, name, where) for name in archive.namelist()}
        header = json.loads(str(arrays.pop(_HEADER)[()]))
        found, number, meta = header["kind"], header["version"], header["meta"]
        if not isinstance(number, int) or not isinstance(meta, dict):
            raise TypeError("header")
        json.dumps(header, ensure_ascii=False).encode()  # JSON can name characters that no text may have
    except (FileNotFoundError, IsADirectoryError, PermissionError, FileFormatError):
        raise
    except Exception as error:  # zip, deflate, numpy's header, JSON: each fails on hostile bytes in ways of its own
        raise FileFormatError(where, wanted, f"something unreadable ({type(error).__name__})") from error
    if found != kind or not 1 <= number <= version:
        raise FileFormatError(where, wanted, f"{found} version {number}")
    return Archive(arrays, meta)


def _refuse_bombs(archive: zipfile.ZipFile, where: str) -> None:
    entries = archive.infolist()
    if len(entries) > MAX_ARRAYS:
        raise FileFormatError(where, f"at most {MAX_ARRAYS} arrays", f"{len(entries)}")
    total = sum(info.file_size for info in entries)
    if total > MAX_BYTES:
        raise FileFormatError(where, f"at most {MAX_BYTES} bytes unpacked", f"{total}")
    for info in entries:  # what an entry says of its size is believed only as far as its bytes can tell so much
        if info.file_size > MAX_RATIO * (info.compress_size + 1):
            raise FileFormatError(f"{where}: {info.filename}", "an entry of its own size", f"{info.file_size} bytes")


def _member(archive: zipfile.ZipFile, name: str, where: str) -> NDArray[Any]:
    """Read one array, having checked that its header does not promise more than the file holds."""
    info = archive.getinfo(name)
    with archive.open(info) as member:
        major, _ = np.lib.format.read_magic(member)
        read = np.lib.format.read_array_header_1_0 if major == 1 else np.lib.format.read_array_header_2_0
        shape, _, dtype = read(member)
        promised = math.prod(max(1, length) for length in shape) * dtype.itemsize  # (10**12, 0) is a bomb, too
        if dtype.hasobject or not dtype.itemsize or promised > info.file_size:
            raise FileFormatError(
                f"{where}: {name}", f"at most {info.file_size} bytes of plain numbers", f"{dtype} {shape}"
            )
    with archive.open(info) as member:
        array: NDArray[Any] = np.lib.format.read_array(member, allow_pickle=False)
    if dtype.kind == "U":
        points = np.ascontiguousarray(array).view(np.dtype(np.uint32).newbyteorder(dtype.byteorder))
        if ((points > _LAST_CHARACTER) | (points >> 11 == _SURROGATES)).any():
            raise FileFormatError(f"{where}: {name}", "text in Unicode", "characters that there are not")
    return array
