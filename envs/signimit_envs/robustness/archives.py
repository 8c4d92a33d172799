"""Mutation of archives of arrays (``.npz``): other types, shapes and numbers, lying headers, bombs."""

from __future__ import annotations

import io
import json
import warnings
import zipfile
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit_envs.robustness.mutation import Rng, mutate_bytes, mutate_value, pick

Members = dict[str, bytes]
"""The raw ``.npy`` content of each member of an archive, by its name."""

_HEADER = "signimit.npy"
_VALUES = (
    *(np.nan, np.inf, -np.inf, 0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, 49.0, 1e3, 1e6, 1e9, 1e12, 1e18, 1e50, 1e99, 1e100),
    *(1e101, 1e150, 1e200, 1e300, -1e300, 1.7e308, -1.7e308, 1e-3, 1e-9, 1e-12, 1e-50, 1e-100, 1e-200, 1e-308, 5e-324),
    *(2.0**31, 2.0**53, 2.0**63, -(2.0**63)),
)
_TYPES: tuple[Any, ...] = (
    *("?", "b", "B", "h", "i", "I", "q", "Q", "e", "f", "d", ">f8", ">i8", "g", "F", "D", "U5", "U40", "S5", "S40"),
    *("M8[s]", "m8[D]", "O", "V8", [("x", "f8"), ("y", "f8")]),
)
_CODE_POINTS = (0, 1, 10, 0x22, 0x7F, 0x85, 0xD800, 0xDFFF, 0xFEFF, 0xFFFF, 0x1F590, 0x10FFFF, 0x110000, 0xFFFFFFFF)
_SIZES = (0, 1, 2, 3, 7, 10**6, 10**9, 10**12, 10**18, 2**63, 2**64, 10**30, -1, -(2**63))


@lru_cache(maxsize=64)
def unpack(archive: bytes) -> Members:
    """Return the members of a valid archive; do not change them."""
    with zipfile.ZipFile(io.BytesIO(archive)) as file:
        return {name: file.read(name) for name in file.namelist()}


def pack(members: Members, rng: Rng) -> bytes:
    """Return an archive; one in eight is compressed, as it is slow."""
    method = zipfile.ZIP_STORED if rng.integers(8) else zipfile.ZIP_DEFLATED
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as file:
        for name, content in members.items():
            file.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), content, method)
    return buffer.getvalue()


def mutate_archive(archive: bytes, rng: Rng) -> bytes:
    """Change one or two members of an archive of arrays, its header, or its bytes."""
    if not rng.integers(10):
        return mutate_bytes(archive, rng)
    members = dict(unpack(archive))
    for _ in range(1 if rng.integers(4) else 2):
        _mutate_member(members, rng)
    packed = pack(members, rng)
    return packed if rng.integers(40) else _false_sizes(packed, rng)


def _mutate_member(members: Members, rng: Rng) -> None:
    """Change, remove, rename, exchange or add a member."""
    name = pick(rng, list(members))
    match int(rng.integers(14)):
        case 0:
            del members[name]
            if not members:
                members["x.npy"] = b""
        case 1:
            members[pick(rng, (*members, "scale.npy", "../x.npy", "x", "é.npy", "a/b/points.npy"))] = members.pop(name)
        case 2:
            members[name] = members[pick(rng, list(members))]
        case 3:
            members[name] = mutate_bytes(members[name], rng)
        case 4:
            members[name] = _lying_header(members[name], rng)
        case 5 if not rng.integers(20):
            members |= {f"x{number}.npy": members[name] for number in range(1200)}
        case _ if name == _HEADER:
            members[name] = _mutate_header(members[name], rng)
        case _:
            members[name] = _write(mutate_array(_read(members[name]), rng))


def _mutate_header(raw: bytes, rng: Rng) -> bytes:
    """Change the JSON that says what the archive is."""
    header = json.loads(str(_read(raw)[()]))
    text = json.dumps(mutate_value(header, rng))
    return _write(np.array(text if rng.integers(8) else text + "}"))


def mutate_array(array: NDArray[Any], rng: Rng) -> NDArray[Any]:
    """Return an array of another type or shape, or with other values, if there can be one."""
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            match int(rng.integers(8)):
                case 0:
                    return np.asarray(array.astype(pick(rng, _TYPES)))
                case 1 | 2:
                    return _other_shape(array, rng)
                case 3 if array.dtype.kind in "fc":
                    return np.asarray(
                        array * 10.0 ** pick(rng, (int(rng.integers(-320, 309)), int(rng.integers(-9, 10))))
                    )
                case 6 if array.dtype.kind in "fc":
                    return np.asarray(array * rng.uniform(0.5, 2.0, array.shape))
                case 4 if array.dtype.kind in "fiu":
                    return np.asarray(array + pick(rng, (1, -1, 10, 1000, -1000)))
                case _:
                    return _other_values(array, rng)
        except (ValueError, TypeError, OverflowError):  # a type or shape that it cannot have
            return array[:0] if array.ndim else array


def _other_shape(array: NDArray[Any], rng: Rng) -> NDArray[Any]:
    rows = len(array) if array.ndim else 1
    cut = int(rng.integers(rows + 1))
    shapes: tuple[Callable[[], Any], ...] = (
        lambda: array[:cut],
        lambda: array[cut:],
        lambda: np.delete(array, min(cut, rows - 1), axis=0),
        lambda: np.concatenate([array, array[:1]]),
        lambda: np.repeat(array, int(rng.integers(2, 20)), axis=0),
        lambda: array[::-1],
        lambda: array.T,
        lambda: array.ravel(),
        lambda: array[None],
        lambda: array[..., None],
        lambda: array[..., :1],
        lambda: np.stack([array, array]),
        lambda: array.ravel()[0],
        lambda: array[:0],
        lambda: np.asfortranarray(array),
    )
    return np.asarray(pick(rng, shapes)())


def _other_values(array: NDArray[Any], rng: Rng) -> NDArray[Any]:
    """Overwrite one, some or all elements."""
    changed = np.array(array, order="C")
    flat = changed.reshape(-1)
    if not flat.size:
        return changed
    if flat.dtype.kind == "U":
        flat = flat.view(np.uint32)
    if not rng.integers(3):
        where: Any = slice(None)
    elif rng.integers(2) and changed.ndim > 1:
        columns = changed.shape[-1]
        where = slice(int(rng.integers(columns)), None, columns)
    else:
        where = rng.integers(flat.size, size=int(rng.integers(1, 4)))
    if array.dtype.kind == "U":
        flat[where] = pick(rng, _CODE_POINTS)
    elif array.dtype.kind in "iu":
        limits = np.iinfo(array.dtype)
        flat[where] = pick(rng, (limits.min, limits.max, 0, 1, -1, 2, 3, 1000, len(flat), len(flat) - 1))
    else:
        flat[where] = pick(rng, (*_VALUES, *flat[:1].tolist()))
    return changed


def _lying_header(raw: bytes, rng: Rng) -> bytes:
    """Let the header of an array promise another shape, type, order or version than there is."""
    shape = tuple(pick(rng, _SIZES) for _ in range(int(rng.integers(0, 4))))
    descr = pick(rng, ("<f8", "<i8", "|O", "<U1", "<U1000000000", "|V0", "|S0", "<f16", "x", "<c16", "|b1", ">M8[ns]"))
    order = pick(rng, ("False", "True", "None"))
    text = f"{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n"
    version = pick(rng, (b"\x01\x00", b"\x01\x00", b"\x02\x00", b"\x03\x00", b"\x09\x00"))
    size = len(text).to_bytes(2 if version[0] == 1 else 4, "little")
    return b"\x93NUMPY" + version + size + text.encode() + raw[128:]


def _false_sizes(packed: bytes, rng: Rng) -> bytes:
    """Let the directory of an archive promise other sizes than its members have."""
    changed = bytearray(packed)
    at = packed.find(b"PK\x01\x02")
    while at >= 0:
        if rng.integers(2):
            size = pick(rng, (0, 1, 2**20, 2**31 - 1, 2**32 - 2))
            field = at + pick(rng, (20, 24))  # compressed, uncompressed
            changed[field : field + 4] = size.to_bytes(4, "little")
        at = packed.find(b"PK\x01\x02", at + 4)
    return bytes(changed)


def _read(raw: bytes) -> NDArray[Any]:
    array: NDArray[Any] = np.lib.format.read_array(io.BytesIO(raw), allow_pickle=False)
    if not array.nbytes:
        raise ValueError("nothing to change, which takes for ever with 10**12 rows of nothing")
    return array


def _write(array: NDArray[Any]) -> bytes:
    buffer = io.BytesIO()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # of types that older numpy cannot read
        np.lib.format.write_array(buffer, np.asarray(array), allow_pickle=True)
    return buffer.getvalue()
